/// A DXF drawing as the reader sees it: pairs of a group code and a value, in sections.
#ifndef SL_IMPORT_DXF_H
#define SL_IMPORT_DXF_H

#include "io/pen.h"
#include "map/scan.h"
#include "sightline/io.h"
#include "sightline/support.h"

typedef struct sl_dxf_pair {
    int code;
    uint32_t line; ///< of the value
    sl_word value;
} sl_dxf_pair;

/// Pairs begin .. end - 1.
typedef struct sl_dxf_range {
    size_t begin, end;
} sl_dxf_range;

typedef struct sl_dxf_block {
    sl_word name;
    sl_dxf_range entities;
    sl_point base;
} sl_dxf_block;

typedef struct sl_dxf_layer {
    sl_word name;
    bool taken;
} sl_dxf_layer;

typedef struct sl_dxf {
    sl_context *context;
    const char *name;
    const sl_import_options *options;
    SL_ARRAY(sl_dxf_pair) pairs;
    SL_ARRAY(sl_dxf_block) blocks;
    SL_ARRAY(sl_dxf_layer) layers; ///< of the table, and those that only the option names
    sl_dxf_range entities;
    int unit; ///< $INSUNITS; 0 where the drawing does not tell
    sl_pen pen;
    size_t work; ///< entities and insertions gone through
    /// Entities drawn; those of other layers, kinds, of the paper or out of the plan's plane.
    size_t drawn, other_layers, other_kinds, on_paper, out_of_plane;
} sl_dxf;

static inline const sl_dxf_pair *sl_dxf_at(const sl_dxf *dxf, size_t i) {
    return &dxf->pairs.items[i];
}

/// From the pair `begin`, which starts an entity, to the next one that starts another.
sl_dxf_range sl_dxf_entity(const sl_dxf *dxf, size_t begin, size_t end);

/// The first value of a group in an entity; `value` stays as it is where there is none.
sl_status sl_dxf_number(sl_dxf *dxf, sl_dxf_range entity, int code, double *value);
sl_status sl_dxf_integer(sl_dxf *dxf, sl_dxf_range entity, int code, int *value);
sl_word sl_dxf_text(const sl_dxf *dxf, sl_dxf_range entity, int code);

/// Whether entities of the layer are taken. Names are the same in small letters and capitals.
bool sl_dxf_takes_layer(const sl_dxf *dxf, sl_word name);
const sl_dxf_block *sl_dxf_find_block(const sl_dxf *dxf, sl_word name);

/// Draws the entities of a range with the pen. `layer` is the one that things on layer "0" are on:
/// that of the insertion; of no length at the top.
sl_status sl_dxf_draw(sl_dxf *dxf, sl_dxf_range range, sl_word layer, unsigned depth);

#endif
