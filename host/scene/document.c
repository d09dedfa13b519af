/* Builds the tree from libyaml's events. Its document tree would be less work, but hides aliases
 * and anchors, keeps no trace of a second document and has no limit on nesting. Knows nothing of
 * keys. */
#include "scene/document.h"

#include <stdlib.h>
#include <string.h>
#include <yaml.h>

enum {
    MOST_KEYS = 1000,       /* in one map; the search for duplicates is quadratic             */
    LARGEST_TEXT = 1 << 21, /* 10000 populations; the worst text makes a tree 60 times its size */
};

typedef struct Builder {
    yaml_parser_t parser;
    yaml_event_t event;
    const char *text;
    size_t length;
    const OzSource *source;
    OzFaults *faults;
} Builder;

static int line_of(yaml_mark_t mark)
{
    return (int)mark.line + 1;
}

/* Ends the reading with this one fault. */
#define STOP(builder, line, ...)                                                                   \
    (oz_faults_free((builder)->faults),                                                            \
     oz_faults_add((builder)->faults, (builder)->source, line, __VA_ARGS__), OZ_ERR_INPUT)

/* The reader's own errors (encoding, control characters) carry an offset and no mark. */
static int error_line(const Builder *builder)
{
    if (builder->parser.error != YAML_READER_ERROR) {
        return line_of(builder->parser.problem_mark);
    }
    int line = 1;
    for (size_t i = 0; i < builder->parser.problem_offset && i < builder->length; i++) {
        line += builder->text[i] == '\n';
    }
    return line;
}

static OzStatus advance(Builder *builder)
{
    yaml_event_delete(&builder->event);
    yaml_parser_t *parser = &builder->parser;
    if (yaml_parser_parse(parser, &builder->event)) {
        return OZ_OK;
    }
    if (parser->error == YAML_MEMORY_ERROR) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory while reading %s",
                              builder->source->name);
    }
    return STOP(builder, error_line(builder), "%s%s%s; expected valid YAML",
                parser->problem ? parser->problem : "unreadable", parser->context ? " " : "",
                parser->context ? parser->context : "");
}

/* Scenes are plain values: what makes YAML hard to read back is refused by its name. */
static bool refuse_ornaments(Builder *builder, int line, const yaml_char_t *anchor,
                             const yaml_char_t *tag)
{
    if (anchor) {
        oz_faults_add(builder->faults, builder->source, line,
                      "anchor &%.60s; expected a plain value, scenes have no anchors",
                      (const char *)anchor);
    }
    if (tag) {
        oz_faults_add(builder->faults, builder->source, line,
                      "tag %.60s; expected a plain value, scenes have no tags", (const char *)tag);
    }
    return anchor || tag;
}

static OzStatus build(Builder *builder, OzNode **node, int depth);

static OzStatus build_scalar(Builder *builder, OzNode **node)
{
    const yaml_event_t *event = &builder->event;
    const char *text = (const char *)event->data.scalar.value;
    int line = line_of(event->start_mark);
    OZ_PASS(oz_tree_create(node, OZ_NODE_SCALAR, builder->source, line, NULL, text));
    (*node)->quoted = event->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
    (*node)->refused =
        refuse_ornaments(builder, line, event->data.scalar.anchor, event->data.scalar.tag);
    if (strlen(text) != event->data.scalar.length) {
        oz_faults_add(builder->faults, builder->source, line,
                      "a text with a zero byte in it; expected printable text");
        (*node)->refused = true;
    }
    return OZ_OK;
}

static OzStatus build_alias(Builder *builder, OzNode **node)
{
    int line = line_of(builder->event.start_mark);
    oz_faults_add(builder->faults, builder->source, line,
                  "alias *%.60s; expected the value itself, scenes have no aliases",
                  (const char *)builder->event.data.alias.anchor);
    OzStatus status = oz_tree_create(node, OZ_NODE_SCALAR, builder->source, line, NULL, "");
    if (status == OZ_OK) {
        (*node)->refused = true;
    }
    return status;
}

static OzStatus build_list(Builder *builder, OzNode **list, int depth)
{
    int line = line_of(builder->event.start_mark);
    OZ_PASS(oz_tree_create(list, OZ_NODE_LIST, builder->source, line, NULL, NULL));
    (*list)->refused = refuse_ornaments(builder, line, builder->event.data.sequence_start.anchor,
                                        builder->event.data.sequence_start.tag);
    OZ_PASS(advance(builder));
    while (builder->event.type != YAML_SEQUENCE_END_EVENT) {
        OzNode *item = NULL;
        OZ_PASS(build(builder, &item, depth + 1));
        OZ_PASS(oz_tree_add(*list, item));
        OZ_PASS(advance(builder));
    }
    return OZ_OK;
}

/* Reads a key; *key stays NULL when it is none, with a fault added. */
static OzStatus build_key(Builder *builder, char **key, int depth)
{
    int line = line_of(builder->event.start_mark);
    OzNode *node = NULL;
    OzStatus status = build(builder, &node, depth);
    if (status == OZ_OK && node->kind != OZ_NODE_SCALAR) {
        oz_faults_add(builder->faults, builder->source, line,
                      "a key that is a list or a group; expected a name");
    } else if (status == OZ_OK && !node->refused && strcmp(node->text, "<<") == 0) {
        oz_faults_add(builder->faults, builder->source, line,
                      "merge key <<; expected the keys themselves, or `extends: other.yaml`");
    } else if (status == OZ_OK && !node->refused) {
        *key = node->text;
        node->text = NULL;
    }
    oz_tree_free(node);
    return status;
}

/* Adds an entry to the map, or drops it with a fault when its key is there already or was none. */
static OzStatus add_entry(Builder *builder, OzNode *map, OzNode *value)
{
    const OzNode *first = value->key ? oz_tree_child(map, value->key) : NULL;
    if (first) {
        oz_faults_add(builder->faults, builder->source, value->line,
                      "duplicate key %.60s, first on line %d; expected it once", value->key,
                      first->line);
    }
    if (first || !value->key) {
        oz_tree_free(value);
        return OZ_OK;
    }
    return oz_tree_add(map, value);
}

static OzStatus build_entry(Builder *builder, OzNode *map, int depth)
{
    OzStatus status = OZ_OK;
    char *key = NULL;
    OzNode *value = NULL;
    int line = line_of(builder->event.start_mark);
    if (map->count == MOST_KEYS) {
        status = STOP(builder, line, "more than %d keys in one group; expected fewer", MOST_KEYS);
        goto done;
    }
    OZ_TRY(build_key(builder, &key, depth + 1));
    OZ_TRY(advance(builder));
    OZ_TRY(build(builder, &value, depth + 1));
    value->key = key;
    value->line = line;
    key = NULL;
    OzNode *entry = value;
    value = NULL;
    OZ_TRY(add_entry(builder, map, entry));
done:
    free(key);
    oz_tree_free(value);
    return status;
}

static OzStatus build_map(Builder *builder, OzNode **map, int depth)
{
    int line = line_of(builder->event.start_mark);
    OZ_PASS(oz_tree_create(map, OZ_NODE_MAP, builder->source, line, NULL, NULL));
    (*map)->refused = refuse_ornaments(builder, line, builder->event.data.mapping_start.anchor,
                                       builder->event.data.mapping_start.tag);
    OZ_PASS(advance(builder));
    while (builder->event.type != YAML_MAPPING_END_EVENT) {
        OZ_PASS(build_entry(builder, *map, depth));
        OZ_PASS(advance(builder));
    }
    return OZ_OK;
}

/* Builds the value that begins with the current event and ends on its last one. On failure *node is
 * NULL or a part that is freed here. */
static OzStatus build(Builder *builder, OzNode **node, int depth)
{
    OzStatus status = OZ_OK;
    *node = NULL;
    if (depth > OZ_TREE_DEEPEST) {
        return STOP(builder, line_of(builder->event.start_mark),
                    "nested deeper than %d; expected at most that",
                    OZ_TREE_DEEPEST);
    }
    switch (builder->event.type) {
    case YAML_ALIAS_EVENT:
        status = build_alias(builder, node);
        break;
    case YAML_SEQUENCE_START_EVENT:
        status = build_list(builder, node, depth);
        break;
    case YAML_MAPPING_START_EVENT:
        status = build_map(builder, node, depth);
        break;
    default:
        status = build_scalar(builder, node);
        break;
    }
    if (status != OZ_OK) {
        oz_tree_free(*node);
        *node = NULL;
    }
    return status;
}

static OzStatus build_stream(Builder *builder, OzNode **root)
{
    OZ_PASS(advance(builder)); /* the stream's start */
    OZ_PASS(advance(builder));
    if (builder->event.type == YAML_STREAM_END_EVENT) {
        return OZ_OK;
    }
    OZ_PASS(advance(builder)); /* past the document's start */
    OZ_PASS(build(builder, root, 1));
    OZ_PASS(advance(builder)); /* the document's end */
    OZ_PASS(advance(builder));
    if (builder->event.type != YAML_STREAM_END_EVENT) {
        return STOP(builder, line_of(builder->event.start_mark),
                    "a second document begins here; expected one scene in a file");
    }
    return OZ_OK;
}

OzStatus oz_document_parse(OzNode **root, const char *text, size_t length, const OzSource *source,
                           OzFaults *faults)
{
    *root = NULL;
    Builder builder = {.text = text, .length = length, .source = source, .faults = faults};
    if (length > LARGEST_TEXT) {
        return STOP(&builder, 1, "the file has %zu bytes; expected at most %d", length,
                    LARGEST_TEXT);
    }
    if (!yaml_parser_initialize(&builder.parser)) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for the YAML reader");
    }
    yaml_parser_set_input_string(&builder.parser, (const unsigned char *)text, length);
    OzStatus status = build_stream(&builder, root);
    if (status != OZ_OK) {
        oz_tree_free(*root);
        *root = NULL;
    }
    yaml_event_delete(&builder.event);
    yaml_parser_delete(&builder.parser);
    return status;
}
