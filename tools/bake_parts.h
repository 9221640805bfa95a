/// Bakes that are not done in one go: within a time limit, stopped by Ctrl-C, gone on with, one
/// shard of several, from an older bake of the same map, or by several processes.
#ifndef BAKE_PARTS_H
#define BAKE_PARTS_H

#include "options.h"
#include "sightline/bake.h"

/// Zeroed, the bake is done in one go.
typedef struct bake_parts {
    double start;      ///< of the program, by sl_seconds()
    double time_limit; ///< seconds; 0 for none
    bool keep_partial;
    uint32_t shard, shard_count; ///< 0, 0 for all
    const char *shard_text;      ///< "3/8"; NULL for all
    const char *resume, *previous;
} bake_parts;

/// The options of the command line that fill it.
option_table bake_parts_option_table(bake_parts *parts);

/// To be called when the options have been read. Refuses what the method or the other options do
/// not go with.
sl_status bake_parts_plan(sl_context *context, const sl_see_method *method,
                          const sl_see_options *see, bake_parts *parts);

/// How two baked files come from different bakes, to go behind "was baked"; NULL where they do not.
const char *bake_difference(const sl_baked *a, const sl_baked *b);

/// What the parts came to, for the report.
typedef struct bake_parts_account {
    const char *units; ///< NULL where the bake was done in one go
    uint32_t unit_count, done;
    uint32_t known; ///< of `done`: before this run
} bake_parts_account;

/// After sl_bake_space(): sets the visible sets of a baked file, or the partial results of its
/// shard.
sl_status bake_parts_see(sl_context *context, const bake_parts *parts,
                         const sl_bake_options *options, sl_baked *baked,
                         bake_parts_account *account);

#endif
