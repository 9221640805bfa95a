/// What the readers of virtual tabletops share: doors' names, and the marks of files of our own.
#include "io/tabletop/tabletop.h"

#include "map/source.h"

// --- names of doors, which only files of our own have

/// The name that a door of a file of our own has; NULL for none.
static const char *marked_name(const sli_json *door, bool flags) {
    const sli_json of_flags = sli_json_member(door, "flags");
    const sli_json own = sli_json_member(flags ? &of_flags : door, "sightline");
    const char *name = sli_json_text_of(&own, "name");
    return sli_name_usable(name, strlen(name)) ? name : NULL;
}

/// Whether a door has this name; NULL: any.
static bool is_marked(const sli_door_names *names, const char *name) {
    for (size_t i = 0; i < json_array_size(names->doors->value); i++) {
        const sli_json door = sli_json_item(names->doors, i);
        const char *own = marked_name(&door, names->flags);
        if (own && (!name || strcmp(own, name) == 0)) return true;
    }
    return false;
}

sli_door_names sli_door_names_of(const sli_json *doors, bool flags) {
    sli_door_names names = {.doors = doors, .flags = flags};
    names.checks = is_marked(&names, NULL);
    return names;
}

const char *sli_name_of_door(sli_door_names *names, const sli_json *door, char made[32]) {
    const char *own = marked_name(door, names->flags);
    if (own) return own;
    do snprintf(made, 32, "door%zu", ++names->number);
    while (names->checks && is_marked(names, made));
    return made;
}

sl_status sli_tabletop_own(const sli_json *own, double *top, const char **mark, sl_map *map) {
    const sli_json digits = sli_json_member(own, "digits");
    *mark = json_string_value(digits.value);
    const sli_json y0 = sli_json_member(own, "y0"), range = sli_json_member(own, "range");
    SL_TRY(sli_json_number_if(&y0, top));
    SL_TRY(sli_json_number_if(&range, &map->range));
    return range.value && !(map->range > 0) ? sli_json_fail(&range, "a range is greater than 0")
                                            : SL_OK;
}

sl_status sli_tabletop_check_layers(sl_context *context, const char *name, const char *list,
                                    const char *const *layers, size_t count) {
    sli_name_list there = {0};
    for (size_t i = 0; i < count; i++)
        sli_name_list_add(&there, (sli_word){layers[i], strlen(layers[i])});
    for (sli_word word; list && sli_layers_next(&list, &word);) {
        bool known = false;
        for (size_t i = 0; i < count; i++) known |= sli_word_is(word, layers[i]);
        if (!known) return sli_fail_layer(context, name, word, "file", &there);
    }
    return SL_OK;
}
