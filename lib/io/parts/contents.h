/// What a drawing's layers are taken for: by their names (meaning.h), and by the symbols that are
/// drawn on them (symbols.h). A reader draws all that is visible and says which layer each shape is
/// on; then one call keeps walls, makes windows of windows and doors of doors, and says so.
#ifndef SL_CONTENTS_H
#define SL_CONTENTS_H

#include "io/parts/drawn_looks.h"
#include "io/parts/meaning.h"
#include "io/parts/names.h"
#include "io/parts/roles.h"
#include "io/parts/shapes.h"
#include "sightline/import.h"
#include "sightline/io.h"

#include <string.h>

/// A layer, or a block or group that says by its name what is in it.
typedef struct sli_group {
    char *name;
    size_t length;
    sli_meaning means, guess; ///< the guess is by the name alone, without what the user says
    bool said;                ///< the user says what it means
    sli_meaning beside;       ///< windows or doors, where the name says walls as well
    size_t shapes, walls;
    size_t long_ones;                ///< of a layer of doors: walls that are longer than doors
    double long_length, length_left; ///< of these; of all of its walls that no symbol has
    double finest;                   ///< unit of its coordinates, as sli_pen has it
    bool taken;
    bool glazed;  ///< some of its lines are windows, though it is not taken
    size_t shown; ///< shapes of these lines
} sli_group;

/// Walls of a group, one behind another.
typedef struct sli_group_run {
    size_t first, end;
    uint32_t group;
    uint32_t look; ///< of the one shape, where looks are told
} sli_group_run;

/// Set the first five, zero the rest.
typedef struct sli_contents {
    sl_context *context;
    const char *file;                 ///< its name, for messages
    const sl_import_options *options; ///< as sli_drawing_options() gives them
    bool large;                       ///< small pieces that touch nothing are left out
    const char *roles;                ///< as sli_drawing_roles() gives them
    SL_ARRAY(sli_group) groups;       ///< the first one has no name: what no layer is said of
    SL_ARRAY(sli_group_run) runs;
    uint32_t *table; ///< groups by their names: numbers, 0 for none
    size_t table_size;
    uint32_t last;    ///< the group that was asked for before
    double finest;    ///< the pen's, before a shape
    size_t first;     ///< wall of a shape
    size_t left_out;  ///< shapes that are passed over
    sli_looks looks;  ///< how shapes look
    size_t doors;     ///< doors that are drawn open, once the choice is made
    double door;      ///< how wide these are, usually
    bool walls_named; ///< some layer is named as walls, once the choice is made
    bool has_looks;   ///< the reader tells them: `look` is that of the shape at hand
    uint32_t look;
    bool apart; ///< the shape at hand gets a run of its own
} sli_contents;

/// The options with layers "*" as all_layers, and without a "large" before the layers: `*large` is
/// set then.
static inline sl_import_options sli_drawing_options(const sl_import_options *options, bool *large) {
    const size_t length = strlen(SLI_LAYERS_LARGE);
    sl_import_options own = *options;
    const char *layers = own.layers;
    *large = layers && strncmp(layers, SLI_LAYERS_LARGE, length) == 0 &&
             (layers[length] == '\0' || layers[length] == ',');
    if (*large) own.layers = layers[length] ? layers + length + 1 : NULL;
    if (sli_roles_are(own.layers)) own.layers = NULL;
    if (own.layers && strcmp(own.layers, "*") == 0) {
        own.layers = NULL;
        own.all_layers = true;
    }
    return own;
}

/// The list of layers where it is one of roles; else NULL.
static inline const char *sli_drawing_roles(const sl_import_options *options) {
    return sli_roles_are(options->layers) ? options->layers : NULL;
}

void sli_contents_destroy(sli_contents *contents);

/// The number of the group of this name; letters and capitals are the same. 0 for a name of no
/// length, and where there are very many names.
sl_status sli_contents_group(sli_contents *contents, sli_word name, uint32_t *group);

/// What a group means.
static inline sli_meaning sli_contents_means(const sli_contents *contents, uint32_t group) {
    return group < contents->groups.count ? contents->groups.items[group].means : SLI_MEANS_NOTHING;
}

/// Whether the options say which layers are taken; all of them are walls then, but symbols and,
/// with the option doors, doors.
static inline bool sli_contents_said(const sli_contents *contents) {
    return contents->options->layers || contents->options->all_layers;
}
/// Whether shapes are to be told of: not where all layers are taken as they are.
bool sli_contents_asks(const sli_contents *contents);
/// To be called before and behind a shape that the pen draws.
void sli_contents_begin(sli_contents *contents, sli_pen *pen);
sl_status sli_contents_end(sli_contents *contents, sli_pen *pen, uint32_t group);
/// Moves the one shape of a run to another group.
void sli_contents_move(sli_contents *contents, size_t run, uint32_t group);

/// The walls from `first` on are cut to pieces: those of wall `first` + i end at wall ends[i] now,
/// those of wall `first` start at `first`.
void sli_contents_cut(sli_contents *contents, size_t first, const size_t *ends);

/// The groups and the looks that shapes of the map have, with how many, and what each is taken for;
/// destroyed by who asks, also if it fails. `metre` as below.
sl_status sli_contents_list(sli_contents *contents, sl_map *map, double metre,
                            sl_drawing_layers *out);
/// What a layer of this name is taken for by such a list; "ignore" where it is not in it.
const char *sli_contents_role(const sl_drawing_layers *list, sli_word name);

/// Chooses among the walls that were drawn, once all are. `metre` is a metre in the map's unit, 0
/// for unknown. Layers named as walls are walls; where there are none of three walls at least,
/// those whose names say nothing. Layers of windows stop steps and sound. Doors are gaps, or doors
/// with the option doors. Where that leaves fewer than three walls, or no name and no symbol says
/// anything, the map stays as it is.
sl_status sli_contents_choose(sli_contents *contents, double metre, sli_pen *pen);

#endif
