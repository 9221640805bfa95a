/// Cell-to-cell visibility: which cells can see which.
#ifndef SIGHTLINE_CELL_TO_CELL_H
#define SIGHTLINE_CELL_TO_CELL_H

#include "sightline/effects.h"
#include "sightline/pvs.h"
#include "sightline/space.h"
#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What stands before the number of a mirror in a stab tree; spaces have fewer directed portals.
#define SL_STAB_MIRROR 0x80000000u

/// A node of a stab tree: the portal sequence from the source cell down to here has a sightline,
/// reflected in each mirror that it names.
typedef struct sl_stab_node {
    uint32_t parent;   ///< a node of the same tree, before this one; its own number for the root
    uint32_t cell;     ///< where the sequence ends; of a mirror the parent's
    uint32_t directed; ///< the directed portal crossed last, an index of space.directed portals;
                       ///< UINT32_MAX for the root; or SL_STAB_MIRROR + the mirror reached last, an
                       ///< index of map.mirrors
} sl_stab_node;

/// Whether the last step is into a mirror.
static inline bool sl_stab_is_mirror(const sl_stab_node *node) {
    return node->directed >= SL_STAB_MIRROR && node->directed != UINT32_MAX;
}

/// The stab trees of all source cells: tree c is nodes[offsets[c] .. offsets[c + 1]), parents
/// first, numbered from 0 in each tree. A tree that the memory limit left out is empty.
typedef struct sl_stab_trees {
    uint32_t cell_count;
    uint32_t left_out; ///< trees that the limit left out
    uint64_t *offsets; ///< cell_count + 1
    sl_stab_node *nodes;
} sl_stab_trees;

/// What "sweep" alone counts.
typedef struct sl_sweep_account {
    uint64_t pieces; ///< of cells looked at
} sl_sweep_account;

/// What "multipass" alone counts.
typedef struct sl_multipass_account {
    uint64_t candidates; ///< cells to be decided on, over all faces and sectors
    uint64_t relations;  ///< and those of them that were seen
    uint64_t on_cycles;  ///< cells without an order, over all sectors
    uint32_t sectors;    ///< that directions were cut into
} sl_multipass_account;

/// What only a plan with effects makes methods count.
typedef struct sl_effects_account {
    uint64_t door_steps;     ///< sequences of which the doors that they pass were noted
    uint64_t door_fallbacks; ///< ordered pairs that more sets of doors join than the limit
    uint64_t mirror_steps;   ///< times that a sequence was to go on in a mirror
    uint64_t rounded_places; ///< portals whose place in a mirror was rounded
    uint64_t glass_tests;    ///< directed portals asked whether one-way glass bars them
    uint64_t range_tests;    ///< sequences whose shortest sightline was held against the range
    uint64_t close_calls;    ///< of them those within rounding of it: they count as seen
} sl_effects_account;

/// What the work took, in numbers.
typedef struct sl_see_account {
    uint64_t pairs;          ///< ordered pairs seen, each cell with itself included
    uint64_t doubtful_pairs; ///< ordered pairs of which rounding decided
    uint64_t mirrored_pairs; ///< ordered pairs seen by mirror; a cell may so see itself
    uint64_t tests;          ///< stabbing tests (for GLPK: linear programs)
    uint64_t nodes;          ///< stab-tree nodes, roots included, kept or not
    uint32_t deepest;        ///< portals in the longest sequence; of the sweep: that it followed
    sl_stab_account stab;    ///< of the solvers
    sl_effects_account effects;
    sl_sweep_account sweep;
    sl_multipass_account multipass;
} sl_see_account;

/// The result. Zeroed, it is empty.
typedef struct sl_visibility {
    sl_sight sight;
    sl_guarantee guarantee;
    sl_pvs pvs;
    sl_pvs
        doubtful; ///< pairs of which a rounded answer near zero decided; no rows for exact solvers
    sl_pvs mirrored;             ///< what is seen by mirror; no rows where the plan has none
    sl_door_sets doors;          ///< of the pairs of `pvs`; no rows where the plan has no doors
    sl_door_sets mirrored_doors; ///< of those of `mirrored`
    sl_stab_trees trees;         ///< no cells where trees were not asked for
    sl_see_account account;
} sl_visibility;

SL_API void sl_visibility_destroy(sl_context *context,
                                  sl_visibility *visibility); ///< and zeroes it

/// What is known when some units of a method's work are done: of the sweep the fans round portal
/// ends, of the searches the source cells. Each unit finds its pairs alone, so that partial results
/// of different units join by OR, in any order, from any number of runs. Zeroed: nothing is known.
typedef struct sl_partial {
    uint32_t unit_count, done_count;
    uint64_t *done;              ///< a bit a unit: unit u is done[u / 64] >> u % 64 & 1
    sl_pvs sure, doubtful;       ///< pairs found, some one way only; doubtful: by rounded solvers
    bool inside_only;            ///< the option they were found with
    uint32_t shard, shard_count; ///< which part of the work was asked for; 0, 0 for all
    // Of a plan with effects, by the searches; else all 0 and without rows.
    uint32_t effects, mirror_depth, door_limit; ///< of the plan
    bool rounded;                               ///< some place behind a mirror was
    sl_pvs mirrored;                            ///< rows of the units done, with mirrors
    sl_door_sets doors, mirrored_doors;         ///< likewise, with doors
} sl_partial;

SL_API void sl_partial_destroy(sl_context *context, sl_partial *partial); ///< and zeroes it

/// Whether there are partial results at all; whether they are those of all units.
SL_API bool sl_partial_begun(const sl_partial *partial);
/// Whether there are partial results of all units.
SL_API bool sl_partial_complete(const sl_partial *partial);

/// How many units of what was asked for, all or one shard, are left to do.
SL_API uint32_t sl_partial_left(const sl_partial *partial);

/// Adds what others hold, of the same space and method: SL_BAD_ARGUMENT where the units or the
/// options are not the same.
SL_API sl_status sl_partial_merge(sl_context *context, sl_partial *partial,
                                  const sl_partial *other);

/// How methods keep what they have found so far: all bits of a row, or the words that have any.
/// Which it is makes no difference to the result.
typedef enum sl_row_storage { SL_ROWS_BY_SIZE, SL_ROWS_DENSE, SL_ROWS_SPARSE } sl_row_storage;

/// Start from sl_see_options_default().
typedef struct sl_see_options {
    sl_sight sight;
    const sl_solver *solver; ///< needed by methods that stab
    unsigned threads;        ///< 0: one a core; the result does not depend on it
    bool trees;              ///< keep stab trees
    uint64_t tree_bytes;     ///< limit on memory for them; the PVS has none
    bool inside_only;        ///< look from and at inside cells only; other rows are empty
    uint64_t seed;           ///< of methods that draw at random
    uint32_t samples;        ///< lines that "sampling" draws from each cell
    sl_row_storage rows;     ///< of methods that keep rows of bits
    const sl_plan *plan;     ///< what the map calls for; NULL: nothing but walls
    uint64_t row_bytes;      ///< limit on memory for them; what needs more fails (SL_NO_MEMORY)
    /// Sectors that "multipass" cuts all directions into, at most: 4 at least; 0: at each portal's
    /// own, so that cells have an order in each. The result does not depend on it.
    uint32_t sectors;
    /// For `run` alone. The part of the units to be done, 1 .. shard_count; 0, 0 for all.
    uint32_t shard, shard_count;
    /// For `run` and `finish`: asked often, from several threads at once; once true, it stays
    /// true, and `run` begins no unit and goes on with none, `finish` takes looser bounds. NULL:
    /// never.
    bool (*enough)(void *user);
    void *enough_user;
} sl_see_options;

/// The usual options: closed sight, one thread a core, no stab trees.
SL_API sl_see_options sl_see_options_default(void);

/// A method: reachable by name, listed everywhere from this table. Each row of a PVS holds the cell
/// itself; pairs are symmetric where the plan is mutual. Reports stage "cell_to_cell", unit "cells"
/// or "corners". Methods that make no stab trees refuse to (SL_UNSUPPORTED).
typedef struct sl_see_method {
    const char *name, *what;
    bool stabs;      ///< whether it needs a solver; its guarantee is then the solver's
    bool keeps_rows; ///< of bits, as options->rows and row_bytes say
    sl_guarantee guarantee;
    unsigned knows;    ///< the effects that it takes account of where options ask for them: bits
    const char *lacks; ///< why it does not know the others, but doors; NULL where it knows all
    sl_status (*see)(sl_context *context, const sl_space *space, const sl_see_options *options,
                     sl_visibility *out);
    const char *units; ///< what its units are, plural; NULL, as the functions below, where it is
                       ///< done in one go only
    /// Does units that are not done yet, those of the shard, and adds to the partial results what
    /// they find. Partial results that are not zeroed must be of the same space and options.
    sl_status (*run)(sl_context *context, const sl_space *space, const sl_see_options *options,
                     sl_partial *partial);
    /// The result. From partial results of all units the same as `see` gives, but for the account
    /// of the work. Else what is not decided yet counts as seen, within the bound of the method
    /// "flood": an exact method's set is then SL_CONSERVATIVE.
    sl_status (*finish)(sl_context *context, const sl_space *space, const sl_see_options *options,
                        const sl_partial *partial, sl_visibility *out);
    /// Notes as done the units that can find no pair but of cells whose rows are known, and
    /// known not to hold others: `enclosed` has the bits of these cells (sl_partial_reuse); `kept`
    /// those of all cells whose rows are known.
    sl_status (*reuse)(sl_context *context, const sl_space *space, const sl_see_options *options,
                       const uint64_t *kept, const uint64_t *enclosed, sl_partial *partial);
} sl_see_method;

/// All methods, *count of them.
SL_API const sl_see_method *sl_see_methods(size_t *count);

/// The method of that name; NULL for none.
SL_API const sl_see_method *sl_see_method_named(const char *name);

/// The method that is taken where none is asked for: the fastest exact one that can do what the
/// options ask for and that knows the effects of the map. "sweep" in most cases; "dfs" where the
/// options ask for stab trees or name a solver.
SL_API const sl_see_method *sl_see_method_for(const sl_map *map, const sl_see_options *options);

/// SL_UNSUPPORTED, by name, where a method with a solver (NULL for methods that do not stab) does
/// not know what a map calls for. To be asked before any work; the methods themselves believe
/// their options.
SL_API sl_status sl_see_check(sl_context *context, const sl_see_method *method,
                              const sl_solver *solver, const sl_map *map);

/// Makes partial results for a space from what was seen in another one, before some walls were
/// changed: of all pairs that no changed cell can have a part in. The rest is for `run`; the
/// result is the same as without them. `seen` must have been made with the effects of the plan, and
/// its range: one-way glass and a range by the methods that stab, none by the others.
/// SL_BAD_ARGUMENT, and a message that says why, where nothing can be taken over: the plan has
/// other effects, the sets seen are not exact or were made with other options, or what is asked for
/// is not exact.
/// `partial` is zeroed before.
SL_API sl_status sl_partial_reuse(sl_context *context, const sl_space *before,
                                  const sl_visibility *seen, const sl_space *space,
                                  const sl_see_method *method, const sl_see_options *options,
                                  sl_partial *partial);

#ifdef __cplusplus
}
#endif

#endif
