/// From a map's file to its space, and the options for it. All commands that subdivide a map share
/// them.
#ifndef PIPELINE_H
#define PIPELINE_H

#include "inputs/inputs.h"

/// How a map is read, cleaned and subdivided.
typedef struct map_pipeline {
    const char *path; ///< the map's file
    input_options input;
    sl_bake_options bake;   ///< the method is the command's
    sl_point start;         ///< beside the map's own, where `start_text` is not NULL
    const char *start_text; ///< as it is given
    size_t stops;           ///< which walls count, as stops_table()
    const char *stops_text; ///< as it is given; NULL: those of `channel`
    uint32_t channel;       ///< as sl_map.channel
    options_given given;    ///< all options of the command, for commands to run next
    unsigned without;       ///< effects to leave out: bits of sl_effects()
    bool settles_doors;     ///< the command takes doors as they stand (sl_effects_settle_doors)

    // What the options of the subdivision say. pipeline_plan() puts it into `bake`.
    size_t subdivide;           ///< of sl_subdivisions()
    const char *subdivide_text; ///< NULL where it is not given
    unsigned kd_rules;          ///< bits
    const char *kd_rules_given, *kd_obscured_given;
} map_pipeline;

map_pipeline pipeline_default(void);

/// The command-line options that fill it, with those of its input.
option_table pipeline_option_table(map_pipeline *pipeline);
/// The option --without alone.
option_table pipeline_without_table(map_pipeline *pipeline);

/// Call it after the options are read and before anything else.
sl_status pipeline_plan(sl_context *context, const char *path, map_pipeline *pipeline);

/// After pipeline_plan(): doors that a drawing shows are kept as doors, as they say where rooms
/// end.
void pipeline_take_drawn_doors(sl_context *context, map_pipeline *pipeline);

/// Adds the start of --start to a map, drops the effects of --without and may settle doors.
sl_status pipeline_prepare(sl_context *context, const map_pipeline *pipeline, sl_map *map);

/// Reads the map, adds the start of --start and drops the effects of --without.
sl_status pipeline_read(sl_context *context, const map_pipeline *pipeline, sl_map *map);

/// Cleans a map and finds what is inside. `account` may be NULL.
sl_status pipeline_clean(sl_context *context, const map_pipeline *pipeline, sl_map *map,
                         sl_clean_account *account);

/// Reads the map as pipeline_read() does, and cleans it. `account` may be NULL.
sl_status pipeline_read_clean(sl_context *context, const map_pipeline *pipeline, sl_map *map,
                              sl_clean_account *account);

/// Subdivides a clean map. Checks the space if asked to, and always for a mesh.
sl_status pipeline_subdivide(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                             sl_space *space);

/// The space of a map, or of a baked file (by its name or its first bytes). Fails where the map has
/// effects other than `effects`, those that the command `user` supports; `reason`: why no others,
/// NULL for no need to say.
sl_status pipeline_read_space(sl_context *context, const map_pipeline *pipeline, const char *user,
                              unsigned effects, const char *reason, sl_baked *baked);

/// A word for the shell: in quotes if it is not made of plain characters. Cut to fit `size`, and
/// gives the length as that does.
size_t pipeline_shell_word(const char *word, char *text, size_t size);

/// A place for a start: the middle of the cell that has the roomiest place. Where that is not
/// known: of the largest cell that is not solid. In a picture the search may take seconds.
sl_status pipeline_likely_start(sl_context *context, const sl_map *map, const sl_space *space,
                                sl_point *start);

/// What to type next where an opening is in doubt (SL_INSIDE_OPENING).
typedef struct doubtful_opening {
    bool start; ///< a start: in a game a wide opening is seldom an entrance
    bool wide;  ///< the opening as an entrance. Else the width of the others: with that, a building
                ///< is inside, and none with the wide one
    double entrance;
} doubtful_opening;

sl_status pipeline_decide_opening(sl_context *context, const map_pipeline *pipeline,
                                  const sl_map *map, const sl_space *space, doubtful_opening *out);

/// The share of the area that is inside with a width of entrances; 0 where no part is inside by it.
sl_status pipeline_share_by_entrance(sl_context *context, const map_pipeline *pipeline,
                                     const sl_map *map, const sl_space *space, double width,
                                     double *share);

/// Refuses a map where no start says what is inside, and an opening is in doubt or walls enclose
/// next to nothing: most of a grid may be missing. `or_else`: what else than a start helps; "" for
/// nothing. Else as pipeline_note_inside().
sl_status pipeline_need_inside(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                               const sl_space *space, const char *or_else);

/// As pipeline_need_inside(), for what is proven of all that is inside: notes all rooms without
/// one. *doubtful: there was a note of doubt.
sl_status pipeline_prove_inside(sl_context *context, const map_pipeline *pipeline,
                                const sl_map *map, const sl_space *space, bool *doubtful);

/// Of a drawing: notes how many rooms have no opening, if these are many, and what to run next. Of
/// a game's map without a start: that parts which nothing joins all count as inside. Where rooms
/// have no opening, the map's roomiest place is taken from those that openings join.
sl_status pipeline_note_sealed(sl_context *context, const map_pipeline *pipeline, sl_map *map,
                               const sl_space *space);

/// Notes how much is inside if that is in doubt, and what to run next; then as above.
sl_status pipeline_note_inside(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                               const sl_space *space);

/// Gives the status of laying a grid over a space. Where the grid is refused as too large and
/// strays make the map large, the message names the first of them.
sl_status pipeline_name_stray(sl_context *context, const char *path, const sl_map *map,
                              const sl_space *space, sl_status status);

/// For --help: the names that the options take.
void pipeline_print_subdivisions(void);
void pipeline_print_effects(void);
/// Methods and solvers.
void pipeline_print_methods(void);

#endif
