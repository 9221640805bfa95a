/// Groups of an SVG drawing by their names. Inkscape has labels, Illustrator ids; what scripts
/// write often has classes. Each shape may have a name of its own, with a number: "wall-12". QCAD
/// writes the layer of each shape beside it.
#include "io/svg/svg_group.h"

#include "io/parts/document.h"

#include <string.h>

/// A name without the number at its end, so that what is numbered is one group.
static sli_word without_number(const char *name) {
    size_t length = strlen(name);
    while (length && strchr("0123456789-_. ", name[length - 1])) length--;
    return (sli_word){name, length};
}

const char *const sli_svg_layer_names[4] = {"layer", "data-layer", "label", "id"};

static sl_status group_of(sli_contents *contents, xmlNode *node, const char *attribute, bool whole,
                          uint32_t *group) {
    char *text = sli_xml_attribute(node, attribute);
    *group = 0;
    if (!text) return SL_OK;
    if (*text == '{') { // data of a program, which names its members
        sli_xml_free(text);
        return SL_OK;
    }
    const sli_word name = whole ? (sli_word){text, strlen(text)} : without_number(text);
    const sl_status status = sli_contents_group(contents, name, group);
    sli_xml_free(text);
    return status;
}

sl_status sli_svg_find_group(sli_contents *contents, xmlNode *node, uint32_t *group) {
    static const char *const names[] = {"label", "id", "class"};
    const bool is_group = sli_xml_is(node, "g");
    uint32_t named = 0, own;
    for (size_t i = 0; i < 2; i++) {
        SL_TRY(group_of(contents, node, sli_svg_layer_names[i], true, &own));
        if (own && (sli_contents_means(contents, own) || !sli_contents_means(contents, *group)))
            *group = own;
    }
    for (int i = 0; i < 3 && !sli_contents_means(contents, named); i++) {
        SL_TRY(group_of(contents, node, names[i], is_group && i < 2, &own));
        if (!named || sli_contents_means(contents, own)) named = own;
    }
    if (sli_contents_means(contents, named) ||
        (named && is_group && !sli_contents_means(contents, *group)))
        *group = named;
    return SL_OK;
}
