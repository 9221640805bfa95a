/// The texts of a DXF drawing: TEXT, MTEXT, and ATTRIB, which stand behind the block that they
/// are of. They are kept for names of rooms (sl_map_source.texts).
///
/// MTEXT has its first 250 characters in group 1 and those before in groups 3, and signs of its
/// form among them (DXF Reference, MTEXT): \P ends a line, \f...; and others choose a font, {} are
/// around what it is for, and \S1/2; is a fraction.
#include "io/dxf/dxf.h"
#include "map/source.h"

#include <math.h>

bool sli_dxf_is_text(sli_word kind) {
    return sli_word_is(kind, "TEXT") || sli_word_is(kind, "MTEXT") || sli_word_is(kind, "ATTRIB");
}

/// Adds a word without the signs of its form; a line ends with '\n'.
static void add_plain(sli_word word, char *text, size_t *length) {
    const char *const end = word.at + word.length;
    for (const char *at = word.at; at < end; at++) {
        if (*at == '{' || *at == '}') continue;
        if (*at == '\\' && at + 1 < end && strchr("PpXn", at[1])) {
            at++;
            text[(*length)++] = '\n';
        } else if (*at == '\\' && at + 1 < end && strchr("ACcFfHQTWS", at[1])) {
            while (at < end && *at != ';') at++;
        } else if (*at == '\\' && at + 1 < end && strchr("LlOoKk", at[1])) {
            at++;
        } else if (*at == '\\' && at + 1 < end) {
            text[(*length)++] = *++at == '~' ? ' ' : *at;
        } else {
            text[(*length)++] = *at;
        }
    }
}

sl_status sli_dxf_take_text(sli_dxf *dxf, sli_dxf_range entity) {
    const bool form = sli_word_is(sli_dxf_at(dxf, entity.begin)->value, "MTEXT");
    const sli_affine affine = dxf->pen.affine;
    sl_point at = {0, 0};
    double height = 0;
    size_t room = 1, length = 0;
    if (sli_dxf_number(dxf, entity, 10, &at.x) != SL_OK ||
        sli_dxf_number(dxf, entity, 20, &at.y) != SL_OK ||
        sli_dxf_number(dxf, entity, 40, &height) != SL_OK)
        return SL_OK; // it names nothing
    for (size_t i = entity.begin; i < entity.end; i++) room += sli_dxf_at(dxf, i)->value.length;
    char *text = sl_alloc(dxf->context, room);
    if (!text) return SL_NO_MEMORY;
    for (size_t i = entity.begin; i < entity.end; i++) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, i);
        if (pair->code != 1 && !(form && pair->code == 3)) continue;
        if (form) {
            add_plain(pair->value, text, &length);
        } else {
            memcpy(text + length, pair->value.at, pair->value.length);
            length += pair->value.length;
        }
    }
    const double scale = sqrt(fabs(affine.xx * affine.yy - affine.xy * affine.yx));
    const sl_status status = sli_source_add_text(dxf->context, &dxf->pen.map->source, text, length,
                                                 sli_affine_apply(affine, at), height * scale);
    sl_free(dxf->context, text);
    return status;
}
