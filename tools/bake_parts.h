/// Bakes that are not done in one go: within a time limit, stopped by Ctrl-C, gone on with, one
/// shard of several, from an older bake of the same map, or by several processes.
#ifndef BAKE_PARTS_H
#define BAKE_PARTS_H

#include "console.h"
#include "options.h"
#include "sightline/bake.h"

/// The options as they are given.
typedef struct sl_bake_part_texts {
    const char *time_limit, *shard, *resume, *previous;
    bool keep_partial;
} sl_bake_part_texts;

/// Those options, for the command's table of options.
#define SL_BAKE_PART_OPTIONS(texts)                                                                \
    {"time-limit",                                                                                 \
     0,                                                                                            \
     "SECONDS",                                                                                    \
     NULL,                                                                                         \
     &(texts).time_limit,                                                                          \
     "look no longer than that, from the start on, and\nwrite what there is: a partial set, in "   \
     "which all\nthat is not decided counts as seen (bounding it\ntakes a quarter more at most)"}, \
        {"keep-partial",                                                                           \
         0,                                                                                        \
         NULL,                                                                                     \
         &(texts).keep_partial,                                                                    \
         NULL,                                                                                     \
         "the first Ctrl-C writes what there is, as\n--time-limit does; the second stops all "     \
         "(without\nit the first does, and nothing is written)"},                                  \
        {"resume",                                                                                 \
         0,                                                                                        \
         "FILE.slv",                                                                               \
         NULL,                                                                                     \
         &(texts).resume,                                                                          \
         "go on with a partial file of the same map and\noptions: in the end the same bytes"},     \
        {"previous",                                                                               \
         0,                                                                                        \
         "FILE.slv",                                                                               \
         NULL,                                                                                     \
         &(texts).previous,                                                                        \
         "take over what changed walls cannot affect from\nan older bake of the map: the same "    \
         "bytes, sooner"},                                                                         \
    {                                                                                              \
        "shard", 0, "K/N", NULL, &(texts).shard,                                                   \
            "do the Kth of N parts of the work, 1 to N, and\nwrite them for sightline merge"       \
    }

/// The options as they are meant. Zeroed, the bake is done in one go.
typedef struct sl_bake_parts {
    double start;      ///< of the program, by sl_now()
    double time_limit; ///< seconds; 0 for none
    bool keep_partial;
    uint32_t shard, shard_count; ///< 0, 0 for all
    const char *resume, *previous;
} sl_bake_parts;

/// Refuses what the method or the other options do not go with.
sl_status sl_bake_parts_plan(sl_context *context, const sl_bake_part_texts *texts,
                             const sl_see_method *method, const sl_see_options *see,
                             sl_bake_parts *out);

/// How two baked files come from different bakes, to go behind "was baked"; NULL where they do not.
const char *sl_bake_difference(const sl_baked *a, const sl_baked *b);

/// What the parts came to, for the report.
typedef struct sl_bake_parts_account {
    const char *units; ///< NULL where the bake was done in one go
    uint32_t unit_count, done;
    uint32_t known; ///< of `done`: before this run
} sl_bake_parts_account;

/// The stage "cell_to_cell" of a baked file that has a space, method and solver: sets its visible
/// sets, or the partial results of its shard.
sl_status sl_bake_parts_see(sl_context *context, const sl_bake_parts *parts,
                            const sl_see_method *method, const sl_see_options *see, sl_baked *baked,
                            sl_bake_parts_account *account);

#endif
