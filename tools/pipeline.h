/// The way from a map's file to its space, and the options that say how it is gone: shared by all
/// commands that subdivide a map.
#ifndef PIPELINE_H
#define PIPELINE_H

#include "inputs.h"

/// What is done to a map, from its file to its space.
typedef struct map_pipeline {
    const char *path; ///< the map's file
    input_options input;
    sl_bake_options bake;   ///< the method is the command's
    sl_point start;         ///< beside the map's own, where `start_text` is not NULL
    const char *start_text; ///< as it is given
    unsigned without;       ///< effects to leave out: bits of sl_effects()

    // What the options of the subdivision come to; pipeline_plan() sees to them.
    size_t subdivide;           ///< of sl_subdivisions()
    const char *subdivide_text; ///< NULL where it is not given
    unsigned kd_rules;          ///< bits
    const char *kd_rules_given, *kd_obscured_given;
} map_pipeline;

map_pipeline pipeline_default(void);

/// The options of the command line that fill it, those of its input among them.
option_table pipeline_option_table(map_pipeline *pipeline);
/// Of them --without alone.
option_table pipeline_without_table(map_pipeline *pipeline);

/// To be called when the options have been read, before the rest.
sl_status pipeline_plan(sl_context *context, const char *path, map_pipeline *pipeline);

/// Reads the map, adds the start asked for and leaves out the effects named.
sl_status pipeline_read(sl_context *context, const map_pipeline *pipeline, sl_map *map);

/// The same, and cleans the map. `account` may be NULL.
sl_status pipeline_read_clean(sl_context *context, const map_pipeline *pipeline, sl_map *map,
                              sl_clean_account *account);

/// Subdivides a clean map, and checks the space if it is to be.
sl_status pipeline_subdivide(sl_context *context, const map_pipeline *pipeline, const sl_map *map,
                             sl_space *space);

/// The space of a map, or of a baked file, whose name ends in .slv. Fails where the map has other
/// effects than `effects`, which `user` knows.
sl_status pipeline_read_space(sl_context *context, const map_pipeline *pipeline, const char *user,
                              unsigned effects, sl_baked *baked);

/// For --help: what the options choose from.
void pipeline_print_subdivisions(void);
void pipeline_print_effects(void);
/// Methods and solvers; the remarks stand behind the headings.
void pipeline_print_methods(const char *on_methods, const char *on_solvers);

#endif
