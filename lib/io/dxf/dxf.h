/// A DXF drawing while it is read: its pairs, layers and blocks (dxf_sections.c; dxf_binary.c makes
/// a text of a binary drawing, dxf_names.c has names in UTF-8), how much it gives (dxf_count.c),
/// and the pen that draws its entities (dxf_draw.c), as far as a clip shows them (dxf_clip.c).
/// dxf.c makes a map of it.
#ifndef SL_DXF_H
#define SL_DXF_H

#include "io/parts/bad_parts.h"
#include "io/parts/contents.h"
#include "io/parts/layers.h"
#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "map/scan.h"
#include "sightline/io.h"
#include "sightline/support.h"

/// A group code and its value.
typedef struct sli_dxf_pair {
    int code;
    uint32_t line; ///< of the value
    sli_word value;
} sli_dxf_pair;

/// Pairs begin .. end - 1.
typedef struct sli_dxf_range {
    size_t begin, end;
} sli_dxf_range;

typedef struct sli_dxf_block {
    sli_word name;
    sli_dxf_range entities;
    sl_point base;
} sli_dxf_block;

typedef struct sli_dxf_layer {
    sli_word name;
    bool on; ///< and not frozen
    bool taken;
    size_t entities;
} sli_dxf_layer;

/// Something of the section OBJECTS: its handle, and the pair that starts it.
typedef struct sli_dxf_object {
    sli_word handle;
    size_t begin;
} sli_dxf_object;

/// The polygon that an INSERT shows of its block, in the block's places. Without corners: all.
typedef struct sli_dxf_clip {
    sl_point *corners;
    size_t count;
} sli_dxf_clip;

/// Entities of a kind that is no wall, on a layer.
typedef struct sli_dxf_other {
    sli_word kind, layer;
    size_t count;
} sli_dxf_other;

/// So many of them are told apart.
enum { SLI_DXF_OTHERS = 6 };

typedef struct sli_dxf {
    sl_context *context;
    const char *name;
    const sl_import_options *options;
    SL_ARRAY(sli_dxf_pair) pairs;
    SL_ARRAY(sli_dxf_block) blocks;
    SL_ARRAY(sli_dxf_layer) layers; ///< of the table, and behind them those that entities name
    size_t table_layers;            ///< of the table
    sli_dxf_other others[SLI_DXF_OTHERS];
    size_t others_count;
    sli_dxf_range entities, objects;
    SL_ARRAY(sli_dxf_object) filters; ///< dictionaries and clips, by handle
    SL_ARRAY(char) text;              ///< of a binary drawing
    char *names;                      ///< that are not as in the file
    size_t unread_names;              ///< whose characters stand as their numbers
    int guessed_page;                 ///< where the drawing has no code page that is known; else 0
    int unit;                         ///< $INSUNITS; 0 where the drawing does not tell
    sli_pen pen;
    sli_contents contents;
    uint32_t block; ///< the innermost block about an entity whose name says what it is; 0 for none
    size_t work;    ///< entities and insertions gone through
    sl_bits *walls; ///< the pairs that start an entity that was drawn
    sli_faults faults;      ///< entities passed over
    const sli_fault *fault; ///< that the entity being drawn has; NULL for none
    uint32_t fault_line;    ///< of the file
    /// Entities drawn; those of other layers, further kinds, of the paper or out of the plane.
    size_t drawn, other_layers, other_kinds, on_paper, out_of_plane;
} sli_dxf;

static inline const sli_dxf_pair *sli_dxf_at(const sli_dxf *dxf, size_t i) {
    return &dxf->pairs.items[i];
}

/// Whether two names are the same: letters and capitals are one.
bool sli_dxf_same_name(sli_word a, sli_word b);

/// From the pair `begin`, which starts an entity, to the next one that starts another.
sli_dxf_range sli_dxf_entity(const sli_dxf *dxf, size_t begin, size_t end);

/// The first pair of a group in an entity; NULL for none.
const sli_dxf_pair *sli_dxf_find(const sli_dxf *dxf, sli_dxf_range entity, int code);
/// Says what is wrong with the entity being drawn, and where: SL_BAD_INPUT. The entity is then
/// passed over. Reading values says so too, with a message, as outside of entities it fails.
sl_status sli_dxf_fault(sli_dxf *dxf, const sli_fault *kind, uint32_t line);
/// The value of a pair.
sl_status sli_dxf_read_number(sli_dxf *dxf, const sli_dxf_pair *pair, double *value);

/// The first value of a group in an entity; `value` stays as it is where there is none.
sl_status sli_dxf_number(sli_dxf *dxf, sli_dxf_range entity, int code, double *value);
sl_status sli_dxf_integer(sli_dxf *dxf, sli_dxf_range entity, int code, int *value);
/// The same; of no length where there is none.
sli_word sli_dxf_text(const sli_dxf *dxf, sli_dxf_range entity, int code);

/// Counts an entity for its layer, and says whether those of the layer are taken. Names are the
/// same in small letters and capitals.
sl_status sli_dxf_take_layer(sli_dxf *dxf, sli_word name, bool *taken);

/// Whether a layer is on and not frozen.
bool sli_dxf_layer_is_on(const sli_dxf *dxf, sli_word name);

/// NULL for none of this name.
const sli_dxf_block *sli_dxf_find_block(const sli_dxf *dxf, sli_word name);

/// Reads pairs and sections. dxf->entities are those to draw.
sl_status sli_dxf_read(sli_dxf *dxf, const char *text, size_t size);

/// Whether these are the first bytes of a binary drawing.
bool sli_dxf_is_binary(const char *bytes, size_t size);
/// Writes a binary drawing to dxf->text as it would be as a text.
sl_status sli_dxf_from_binary(sli_dxf *dxf, const char *bytes, size_t size);

/// Has all values in UTF-8, by the drawing's code page. Needs the pairs alone.
sl_status sli_dxf_decode_names(sli_dxf *dxf);
/// Notes a code page that was guessed, and names that could not be read.
void sli_dxf_note_names(const sli_dxf *dxf);

/// Finds the clips among dxf->objects.
sl_status sli_dxf_find_clips(sli_dxf *dxf);
/// The clip of an INSERT; sl_free of its corners is the caller's.
sl_status sli_dxf_read_clip(sli_dxf *dxf, sli_dxf_range insert, sli_dxf_clip *clip);
/// Cuts the map's walls from `first` on to what the clip shows. `affine` leads from the block's
/// places to the map's.
sl_status sli_dxf_cut(sli_dxf *dxf, const sli_dxf_clip *clip, sli_affine affine, size_t first);

/// SL_BAD_INPUT where dxf->entities, with all that they insert, give more than the limits; asked
/// before they are drawn.
sl_status sli_dxf_check_amount(sli_dxf *dxf);

/// Draws the entities of a range with the pen. `layer` is the one that things on layer "0" are on:
/// that of the insertion; of no length at the top.
sl_status sli_dxf_draw(sli_dxf *dxf, sli_dxf_range range, sli_word layer, unsigned depth);

/// Whether an entity of this kind is a text.
bool sli_dxf_is_text(sli_word kind);
/// Keeps a text of the drawing at its place; one with a number that is none is passed over.
sl_status sli_dxf_take_text(sli_dxf *dxf, sli_dxf_range entity);

// --- writing (dxf_write.c)

/// The header with the unit (sli_unit_number; 0: none), and the begin of the table of layers.
void sli_dxf_put_head(FILE *stream, int unit);
/// A layer of the table.
void sli_dxf_put_layer(FILE *stream, const char *name, int colour);
/// Between the table of layers and the entities.
void sli_dxf_put_middle(FILE *stream);
/// Behind the entities.
void sli_dxf_put_end(FILE *stream);

#endif
