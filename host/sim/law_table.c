/* Constants by material. */
#include "sim/law_table.h"

#include "base/memory.h"
#include "scene/mixing.h"
#include "sim/constants.h"
#include "sim/units.h"

#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof(OzLawConstants) <= OZ_LAW_ROW * sizeof(double), "a row holds all constants");

void oz_law_table_fill(OzLawConstants table[OZ_LAW_TABLE_MOST], const OzScene *scene,
                       const int *wall_order, int walls)
{
    int kinds = oz_mixing_count(scene);
    for (int row = 0; kinds > 1 && row < kinds * (kinds + walls); row++) {
        OzContactValues values;
        if (row < kinds * kinds) {
            oz_mixing_grains(&values, scene, row / kinds, row % kinds);
        } else {
            oz_mixing_wall(&values, scene, wall_order[row / kinds - kinds], row % kinds);
        }
        table[row] = oz_constants_law(scene, &values);
    }
}

static OzStatus write_table(OzArrays *arrays, int member, const OzScene *scene,
                            const int *wall_order, const OzParameters *p)
{
    OzStatus status = OZ_OK;
    const OzSwitches *s = oz_rods_fields_switches(arrays);
    size_t rows = (size_t)s->materials * (size_t)(s->materials + s->walls);
    OzLawConstants *table = NULL;
    double *words = NULL;
    OZ_TRY(OZ_NEW(&table, OZ_LAW_TABLE_MOST));
    OZ_TRY(OZ_NEW(&words, rows * OZ_LAW_ROW));
    oz_law_table_fill(table, scene, wall_order, s->walls);
    for (size_t row = 0; row < rows; row++) {
        oz_units_law(&table[row], &p->units, s->law);
        memcpy(words + row * OZ_LAW_ROW, &table[row], sizeof table[row]);
    }
    OZ_TRY(oz_arrays_write_scalars(arrays, OZ_FIELD_law_table, member, words, rows * OZ_LAW_ROW));
done:
    free(table);
    free(words);
    return status;
}

OzStatus oz_law_table_write(OzArrays *arrays, int member, const OzMember *of, const int *wall_order,
                            const OzParameters *p)
{
    OzStatus status = OZ_OK;
    int slots = oz_rods_fields_sizes(arrays)->slots, *material = NULL;
    if (oz_rods_fields_switches(arrays)->materials == 1) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&material, slots));
    for (int64_t i = 0; i < of->grains->count; i++) {
        material[i] = oz_mixing_kind(of->scene, of->grains->population[i]);
    }
    OZ_TRY(oz_arrays_write(arrays, OZ_FIELD_material, member, material,
                           sizeof *material * (size_t)slots));
    OZ_TRY(write_table(arrays, member, of->scene, wall_order, p));
done:
    free(material);
    return status;
}
