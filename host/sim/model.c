/* What follows from a model's row alone. */
#include "sim/model.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

OzStateKind oz_model_field_kind(const OzField *field, bool is_double)
{
    return is_double && field->widens ? OZ_STATE_DOUBLE : field->kind;
}

bool oz_model_field_sums(const OzField *field)
{
    return field->kind == OZ_STATE_DOUBLE && !field->widens;
}

bool oz_model_field_begins_empty(const OzField *field)
{
    return oz_model_field_sums(field) || strcmp(field->name, "push") == 0 ||
           strcmp(field->name, "servo") == 0;
}

size_t oz_model_field_bytes(const OzModel *model, int field, const void *switches,
                            const void *sizes)
{
    const OzSwitchesHead *head = switches;
    const OzField *row = &model->fields[field];
    const size_t words[] = {[OZ_WIDTH_ONE] = 1,
                            [OZ_WIDTH_LANES] = (size_t)head->lanes,
                            [OZ_WIDTH_PARAMETERS] = model->parameters_bytes / sizeof(double),
                            [OZ_WIDTH_CONTROL] = model->control_bytes / sizeof(int)};
    return model->field_items(field, switches, sizes) * words[row->width] *
           oz_state_kind_bytes(oz_model_field_kind(row, head->is_double));
}

/* The value of a row: switches are numbers, in the order of the rows, after the first one. */
static int value_of(const void *switches, int row)
{
    return ((const int *)switches)[1 + row];
}

void oz_model_options(const OzModel *model, const void *switches, char *text, size_t size)
{
    const OzSwitchesHead *head = switches;
    size_t used = 0;
    text[0] = '\0';
    for (int k = 0; k < model->switch_count && used < size; k++) {
        used += (size_t)snprintf(text + used, size - used, "-DOZ_%s=%d ", model->switches[k].name,
                                 value_of(switches, k));
    }
    if (head->is_double && used < size) {
        snprintf(text + used, size - used, "-DOZ_DOUBLE=1 ");
    }
}

void oz_model_print_switches(const OzModel *model, const void *switches, FILE *file)
{
    char options[1024];
    const char *separator = "";
    oz_model_options(model, switches, options, sizeof options);
    fprintf(file, "kernel switches    %s\n", options);
    fprintf(file, "left out           ");
    for (int k = 0; k < model->switch_count; k++) {
        if (model->switches[k].left_out && !value_of(switches, k)) {
            fprintf(file, "%s%s", separator, model->switches[k].left_out);
            separator = ", ";
        }
    }
    if (model->more_left_out) {
        model->more_left_out(switches, separator, file);
    }
    fprintf(file, "\n");
}

OzStatus oz_model_layout(OzModelLayout *layout, const OzModel *model, const OzMember *member,
                         const OzDevice *device, const void *running)
{
    *layout = (OzModelLayout){0};
    OZ_PASS(oz_memory_new(&layout->switches, model->switches_bytes, 1, "switches"));
    OZ_PASS(oz_memory_new(&layout->parameters, model->parameters_bytes, 1, "parameters"));
    OZ_PASS(oz_memory_new(&layout->sizes, model->sizes_bytes, 1, "sizes"));
    model->derive(layout->switches, member->scene, member->grains, device);
    OZ_PASS(model->fill(layout->parameters, member->scene, member->grains, running));
    return model->choose(layout->sizes, layout->parameters, member->scene, member->grains,
                         layout->switches);
}

void oz_model_layout_free(OzModelLayout *layout)
{
    free(layout->switches);
    free(layout->parameters);
    free(layout->sizes);
    *layout = (OzModelLayout){0};
}
