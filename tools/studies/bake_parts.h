/// Bakes that are not done in one go. A bake may stop at a time limit or at Ctrl-C and be resumed
/// later. It may do one shard of several, start from an older bake of the map, or be shared by
/// several processes.
#ifndef BAKE_PARTS_H
#define BAKE_PARTS_H

#include "arguments/options.h"
#include "sightline/bake.h"

/// Zeroed: the bake is done in one go.
typedef struct bake_parts {
    double start;      ///< of the program, by sl_seconds()
    double time_limit; ///< seconds; 0 for none
    bool keep_partial;
    uint32_t shard, shard_count; ///< 0, 0 for all
    const char *shard_text;      ///< "3/8"; NULL for all
    const char *resume, *previous;

    // When to stop.
    double end; ///< by sl_seconds(); 0 for none
    bool asked; ///< whether Ctrl-C ends it
} bake_parts;

/// The command-line options that fill it.
option_table bake_parts_option_table(bake_parts *parts);

/// Call it after the options are read. Refuses options that do not fit the method or each other.
sl_status bake_parts_plan(sl_context *context, const sl_see_method *method,
                          const sl_see_options *see, bake_parts *parts);

/// Call it with the map, before sl_bake(). Chooses a method that knows the effects of the map
/// where none is asked for and the work is done in parts.
void bake_parts_choose(const bake_parts *parts, const sl_map *map, sl_bake_options *options);

/// How the bakes of two files differ, as words that follow "was baked". NULL: they are alike.
const char *bake_difference(const sl_baked *a, const sl_baked *b);

/// Call it between the halves of sl_bake(), as sl_bake_options.between. Chooses whether the bake
/// works by units, and takes what --resume and --previous know.
sl_status bake_parts_begin(sl_context *context, bake_parts *parts, sl_bake_options *options,
                           const sl_baked *baked, sl_partial *known);

/// Call it as sl_bake_options.join. The first process of the crew gathers all partial results.
sl_status bake_parts_join(sl_context *context, bake_parts *parts, sl_status outcome,
                          sl_partial *partial);

#endif
