/// Why one cell does or does not see another: a portal sequence with a sightline, or the sequences
/// that came farthest, each with the few portal ends that stand in the way.
#ifndef SIGHTLINE_EXPLAIN_H
#define SIGHTLINE_EXPLAIN_H

#include "sightline/effects.h"
#include "sightline/map.h"
#include "sightline/space.h"
#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A distance where no portals lead from one cell to the other.
#define SL_NO_WAY UINT32_MAX

/// Start from sl_explain_options_default().
typedef struct sl_explain_options {
    sl_sight sight;
    const sl_solver *solver; ///< exact, and one that tells conflicts; usually sl_funnel()
    uint32_t most_misses;    ///< to be told of a hidden pair; usually 3
    uint64_t most_tests;     ///< stabbing tests after which to give up; 0, as usual, for no limit
    double range; ///< nothing farther is seen; 0, as usual, for no limit; INFINITY for none, but
                  ///< with lengths told. Only with sl_funnel()
} sl_explain_options;

/// The usual options, as told at each field.
SL_API sl_explain_options sl_explain_options_default(void);

/// A portal sequence, and the ends that decide on it; portal i of the ends is directed
/// portals[i]'s.
typedef struct sl_sequence {
    uint32_t *directed; ///< of the space, in the order crossed
    uint32_t directed_count;
    uint32_t end_count;
    sl_stab_end ends[SL_CONFLICT_MOST];
} sl_sequence;

/// A sequence that came to nothing: it has a sightline, of whatever sight, but for its last portal.
typedef struct sl_miss {
    /// The last directed portal is the one that stops it. Ends: those that no line keeps on their
    /// sides.
    sl_sequence sequence;
    uint32_t missing; ///< portals to the target from the cell before the last portal
    /// No direction crosses all portals forwards: the last one turns back against one before it, or
    /// against two together; the ends are those of these portals, in order, the left ones first.
    bool turns;
} sl_miss;

/// What a sequence with mirrors crosses: a portal or a mirror.
typedef struct sl_bent_step {
    uint32_t directed; ///< of the space; UINT32_MAX for a mirror
    uint32_t mirror;   ///< of the map; UINT32_MAX for a portal
    uint32_t cell;     ///< behind the portal, or before the mirror
} sl_bent_step;

/// A sightline that mirrors bend. Zeroed, it was not looked for.
typedef struct sl_bent_sightline {
    bool asked;              ///< it was looked for
    bool complete;           ///< false: most_tests ended the search
    sl_stab_verdict verdict; ///< SL_HIDDEN: there is none
    uint32_t mirrors;        ///< reflections: of all that there are, the fewest; then portals
    uint32_t step_count;
    sl_bent_step *steps;
    /// From the middle of its way through the first cell to that through the last, by a bend at
    /// each mirror: mirrors + 2 points. Rounded: to be shown.
    sl_point *bends;
    double length;  ///< as that of sl_explanation
    bool rounded;   ///< a portal's place in a mirror is rounded, and so is the verdict
    uint64_t tests; ///< stabbing tests
} sl_bent_sightline;

/// The answer. Zeroed, it is empty.
typedef struct sl_explanation {
    uint32_t from, to;
    sl_sight sight;
    bool seen;     ///< with that sight: SL_STABBED, or SL_GRAZING with closed sight
    bool complete; ///< false: most_tests ended the search; the rest is what it had found by then
    sl_stab_verdict verdict; ///< with closed sight and open; SL_STABBED for a cell and itself
    uint32_t distance;       ///< portals on the shortest way, seen or not; 0 for a cell and itself
    /// Where not SL_HIDDEN: of all sequences with that verdict one with the fewest portals. Ends:
    /// for SL_GRAZING those that the line touches and that leave no other way.
    sl_sequence sequence;
    /// A line through the sequence, proven by exact orientation tests; of few decimals where it
    /// can.
    sl_line witness;
    /// With a range: the length of the shortest sightline of the sequence, between its first portal
    /// and its last. Rounded.
    double length;
    bool touches; ///< the witness touches ends: where SL_GRAZING, and where all lines that do not
                  ///< lie too close together for doubles
    /// Along the witness from the middle of its way through the first cell to that through the
    /// last. Rounded: to be shown.
    sl_segment shown;
    /// Where SL_HIDDEN and there is a way: those that came farthest, from different last cells.
    /// First those with the fewest portals missing; of these those that ends stop before those that
    /// turn, and the shortest sequence first.
    sl_miss *misses;
    uint32_t miss_count;
    uint64_t tests;         ///< stabbing tests
    sl_bent_sightline bent; ///< by sl_explain_by_mirror alone
} sl_explanation;

/// Searches for sightlines from cell `from` to cell `to`. Exact. The fewest portals first, by ever
/// longer searches, so that a pair that is seen is found before all that is near has been tried; a
/// hidden pair takes a search of all that `from` sees. Reports stage "explain", unit "tests".
/// SL_BAD_ARGUMENT where a cell is none of the space or the solver cannot tell. In a space with
/// directed portals missing (sl_query_space), sight goes through those that are there.
SL_API sl_status sl_explain(sl_context *context, const sl_space *space,
                            const sl_explain_options *options, uint32_t from, uint32_t to,
                            sl_explanation *out);

/// Adds to an explanation whether its pair is seen by mirror as well, with `depth` reflections at
/// most, and how. `map`: whose walls the space was made from. Exact behind axial mirrors as long as
/// sums of coordinates are, else rounded, and marked so.
SL_API sl_status sl_explain_by_mirror(sl_context *context, const sl_space *space, const sl_map *map,
                                      const sl_explain_options *options, uint32_t depth,
                                      sl_explanation *explanation);

SL_API void sl_explanation_destroy(sl_context *context,
                                   sl_explanation *explanation); ///< and zeroes it

/// What keeps lines from a sequence of portals. Zeroed: nothing does.
typedef struct sl_conflict {
    sl_stab_verdict verdict; ///< of the sequence, with closed sight and open
    bool turns;              ///< SL_HIDDEN as no direction crosses all portals forwards
    /// Where not SL_STABBED: the ends that alone prove it. If the sequence turns, they are those of
    /// the portals that turn, as in sl_miss. None can be spared otherwise.
    uint32_t end_count;
    sl_stab_end ends[SL_CONFLICT_MOST];
} sl_conflict;

/// Finds what keeps lines from portals crossed in this order, which need not be those of a space.
/// Exact. The first portals that alone leave no line decide; the others are not looked at.
SL_API sl_status sl_conflict_find(sl_context *context, const sl_portal_ends *portals,
                                  uint32_t count, sl_conflict *out);

/// What the ends of a conflict are to each other, as a clause, like sl_sequence_reason.
SL_API const char *sl_conflict_reason(const sl_portal_ends *portals, const sl_conflict *conflict);

// --- with all effects of a map

/// What stands as it stands while a pair is explained.
typedef struct sl_explain_state {
    const bool *shut;      ///< by door of the map; NULL: all are open
    uint32_t mirror_depth; ///< reflections of a sightline, at most; 0: mirrors are walls
} sl_explain_state;

/// What effects do to a pair, directly or by mirror.
typedef struct sl_effect_verdict {
    bool seen;
    unsigned decides; ///< where not seen: the effects (bits) without any one of which it would be
    unsigned without; ///< the effects left out in the explanation kept; 0: walls hide it anyway
} sl_effect_verdict;

/// A pair explained with doors, one-way glass, the range and mirrors. Zeroed, it is empty.
typedef struct sl_effect_explanation {
    unsigned effects;   ///< those of the map that can hide something: bits
    sl_explanation now; ///< with all of them, by mirror too where the map has mirrors
    sl_effect_verdict direct, mirrored;
    /// The pair without the effects `direct.without`, and its way by mirror without those of
    /// `mirrored.without`: one that decides, or else as few as have to go together.
    sl_explanation without;
    sl_bent_sightline bent_without;
    bool complete;  ///< false: most_tests ended a search
    uint64_t tests; ///< of all searches
} sl_effect_explanation;

/// Explains a pair with the effects that a map has, and finds the effect that decides. The numbers
/// are those of `space`, which has all doors open. The range is the map's; options->range is not
/// used. Fails as sl_explain does. A map without effects costs what sl_explain does.
SL_API sl_status sl_explain_effects(sl_context *context, const sl_space *space, const sl_map *map,
                                    const sl_explain_state *state,
                                    const sl_explain_options *options, uint32_t from, uint32_t to,
                                    sl_effect_explanation *out);
SL_API void sl_effect_explanation_destroy(sl_context *context,
                                          sl_effect_explanation *explanation); ///< and zeroes it

/// The place of an end of a sequence.
SL_API sl_point sl_sequence_end(const sl_space *space, const sl_sequence *sequence,
                                sl_stab_end end);

/// What the ends of a sequence are to each other, as a clause: "the segment between those left ends
/// crosses the segment between those right ends".
SL_API const char *sl_sequence_reason(const sl_space *space, const sl_sequence *sequence);

#ifdef __cplusplus
}
#endif

#endif
