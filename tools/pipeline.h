/// The way from a map's file to its space, and the options that say how it is gone: shared by all
/// commands that subdivide a map.
#ifndef PIPELINE_H
#define PIPELINE_H

#include "inputs.h"
#include "options.h"
#include "sightline/cell_to_cell.h"

/// The options as they are given.
typedef struct sl_pipeline_texts {
    sl_input_texts input;
    const char *subdivide, *kd_rules, *kd_obscured, *start, *without;
    bool check;
} sl_pipeline_texts;

/// Those options, for a command's table of options.
#define SL_PIPELINE_OPTIONS(texts)                                                                 \
    {"subdivide",                                                                                  \
     0,                                                                                            \
     "kd|mesh|given",                                                                              \
     NULL,                                                                                         \
     &(texts).subdivide,                                                                           \
     "how to cut the map into cells (default: given where\nthe map brings cells, kd on axial "     \
     "maps, else mesh)"},                                                                          \
        {"kd-rules",                                                                               \
         0,                                                                                        \
         "RULE,...",                                                                               \
         NULL,                                                                                     \
         &(texts).kd_rules,                                                                        \
         "the rules kept, of spanning, obscured, cleaving,\n"                                      \
         "median (the default is all; none: none)"},                                               \
        {"kd-obscured",                                                                            \
         0,                                                                                        \
         "SHARE",                                                                                  \
         NULL,                                                                                     \
         &(texts).kd_obscured,                                                                     \
         "prefer lines of which walls cover this share, 0 to 1"},                                  \
        SL_INPUT_OPTIONS((texts).input),                                                           \
        {"start",        0,                                                                        \
         "X,Y",          NULL,                                                                     \
         &(texts).start, "a start beside the map's own: starts tell inside\nfrom outside"},        \
        {"without", 0, "EFFECT,...", NULL, &(texts).without, "leave out what the map calls for"},  \
    {                                                                                              \
        "check", 0, NULL, &(texts).check, NULL,                                                    \
            "check the whole graph of cells and portals (for a\nmesh: always)"                     \
    }

/// The options as they are meant.
typedef struct sl_pipeline {
    const char *input, *start;
    sl_input_texts texts;              ///< how the input is read
    const sl_subdivision *subdivision; ///< NULL where the map decides
    unsigned without;                  ///< bits of sl_effects()
    sl_subdivide_options options;
    bool check;
} sl_pipeline;

sl_status sl_pipeline_plan(sl_context *context, const char *input, const sl_pipeline_texts *texts,
                           sl_pipeline *out);

/// Reads the map, adds the start asked for and leaves out the effects named.
sl_status sl_pipeline_read(sl_context *context, const sl_pipeline *pipeline, sl_map *map);

/// The same, and cleans the map. `account` may be NULL.
sl_status sl_pipeline_read_clean(sl_context *context, const sl_pipeline *pipeline, sl_map *map,
                                 sl_clean_account *account);

/// The subdivision: the one asked for, or what the map's walls call for.
const sl_subdivision *sl_pipeline_subdivision(const sl_pipeline *pipeline, const sl_map *map);

/// Subdivides a map that is clean.
sl_status sl_pipeline_subdivide(sl_context *context, const sl_pipeline *pipeline, const sl_map *map,
                                sl_space *space);

/// Whether the space is to be checked: where that is asked for, and each mesh, for which it costs
/// little. What is baked is then never refused by those who read it.
bool sl_pipeline_checks(const sl_pipeline *pipeline, const sl_space *space);

/// Checks the space if it is to be.
sl_status sl_pipeline_check(sl_context *context, const sl_pipeline *pipeline,
                            const sl_space *space);

enum { SL_SOLVERS_MOST = 16 };

/// The names of all solvers; `solvers` holds copies of them for the table.
sl_name_table sl_pipeline_solver_names(sl_solver solvers[SL_SOLVERS_MOST]);

/// For --help: what the options choose from.
void sl_pipeline_print_subdivisions(void);
void sl_pipeline_print_effects(void);
/// Methods and solvers; the remarks stand behind the headings.
void sl_pipeline_print_methods(const char *on_methods, const char *on_solvers);

#endif
