/// Bakes that are not done in one go. A bake may stop at a time limit or at Ctrl-C and be resumed
/// later. It may do one shard of several, start from an older bake of the map, or be shared by
/// several processes.
#ifndef BAKE_PARTS_H
#define BAKE_PARTS_H

#include "options.h"
#include "sightline/bake.h"

/// Zeroed: the bake is done in one go.
typedef struct bake_parts {
    double start;      ///< of the program, by sl_seconds()
    double time_limit; ///< seconds; 0 for none
    bool keep_partial;
    uint32_t shard, shard_count; ///< 0, 0 for all
    const char *shard_text;      ///< "3/8"; NULL for all
    const char *resume, *previous;
} bake_parts;

/// The command-line options that fill it.
option_table bake_parts_option_table(bake_parts *parts);

/// Call it after the options are read. Refuses options that do not fit the method or each other.
sl_status bake_parts_plan(sl_context *context, const sl_see_method *method,
                          const sl_see_options *see, bake_parts *parts);

/// Call it with the map, before sl_bake_space(). Chooses a method that knows the effects of the map
/// where none is asked for and the work is done in parts.
void bake_parts_choose(const bake_parts *parts, const sl_map *map, sl_bake_options *options);

/// How the bakes of two files differ, as words that follow "was baked". NULL: they are alike.
const char *bake_difference(const sl_baked *a, const sl_baked *b);

/// How much of the work is done, for the report.
typedef struct bake_parts_account {
    const char *units; ///< NULL where the bake was done in one go
    uint32_t unit_count, done;
    uint32_t known; ///< of `done`: before this run
} bake_parts_account;

/// Call it after sl_bake_space(). Sets the visible sets of a baked file, or the partial results of
/// its shard.
sl_status bake_parts_see(sl_context *context, const bake_parts *parts,
                         const sl_bake_options *options, sl_baked *baked,
                         bake_parts_account *account);

#endif
