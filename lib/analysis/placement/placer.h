/// What the parts of sl_place share: witnesses, candidates, and what is chosen of them.
#ifndef SLI_PLACER_H
#define SLI_PLACER_H

#include "analysis/placement/gaps.h"
#include "sightline/place.h"

/// A place to look from.
typedef struct sli_candidate {
    sli_look look;
    SL_ARRAY(uint32_t) sees;  ///< witnesses, ascending
    SL_ARRAY(uint32_t) germs; ///< that it sees, ascending
} sli_candidate;

/// A witness, and the area of its region.
typedef struct sli_hard_witness {
    double area;
    uint32_t witness;
} sli_hard_witness;

/// Where a witness stands in the lower bound. One that came back stays: else they would come and go
/// in circles.
typedef enum sli_standing { SLI_IDLE, SLI_ACTIVE, SLI_DROPPED, SLI_BACK } sli_standing;

/// What is just beyond a window, at a share of its way.
typedef struct sli_germ {
    sli_track track;
    double share;
    sl_point at; ///< rounded
} sli_germ;

typedef struct sli_placer {
    sl_context *context;
    sl_query *query;
    const sl_place_options *options;
    sli_ground ground;
    bool listed; ///< candidates are given: none is added
    bool coarse; ///< set covers without trees
    bool drops;  ///< the next lower bound drops what others imply: once a round
    sl_region memory;
    sl_random random;
    SL_ARRAY(sli_look) witnesses; ///< all that were made: the rows of the upper bound
    sli_nearby witness_points;
    SL_ARRAY(sli_germ) germs; ///< more rows of the upper bound
    sli_nearby germ_points;
    sli_spans spans;                    ///< scratch
    SL_ARRAY(uint32_t) active;          ///< those of the lower bound
    SL_ARRAY(sli_standing) standings;   ///< by witness
    SL_ARRAY(sli_candidate) candidates; ///< the columns of the upper bound
    sli_nearby candidate_bounds;        ///< of what they see
    SL_ARRAY(uint32_t) chosen;          ///< candidates
    sli_nearby chosen_bounds;           ///< of what they see
    SL_ARRAY(const sli_look *) looks;   ///< scratch
    SL_ARRAY(sli_hard_witness) unseen;  ///< scratch
    SL_ARRAY(sl_segment) lines;         ///< of walls that gaps' apexes hid, and through two corners
    sli_nearby line_starts;
    sli_crossings crossings; ///< of the active witnesses
    sli_window_parts gaps;   ///< what the first `gaps_of` of the chosen ones leave unseen
    uint32_t gaps_of;
    sl_placement *out;
} sli_placer;

void sli_placer_destroy(sli_placer *placer); ///< but for `out`

// --- witnesses (witnesses.c)

/// Witnesses in convex corners, and before walls between two corners that are not.
sl_status sli_add_first_witnesses(sli_placer *placer);
/// Adds one in each part of what is inside in which no chosen candidate stands.
sl_status sli_add_unseen_parts(sli_placer *placer, bool *added);
/// Adds one beyond a gap of the chosen candidates that none of them sees.
sl_status sli_add_beyond(sli_placer *placer, const sli_window_part *gap, bool *added);
/// Takes witnesses that no chosen candidate sees into the lower bound: those with the smallest
/// regions first. Of those that see each other it takes one, and others while they are few.
sl_status sli_activate(sli_placer *placer, bool *added);
/// Drops active witnesses that others imply, by the steps of the proof for their columns.
sl_status sli_drop_implied(sli_placer *placer, const sl_cover_proof *proof);

// --- germs (germs.c)

/// Adds a germ for a gap of the chosen candidates, once, and its apex as a candidate. *added is
/// false where none of the candidates sees it.
sl_status sli_add_germ(sli_placer *placer, const sli_window_part *gap, bool *added);
/// Notes the germs that a candidate sees.
sl_status sli_try_germs(sli_placer *placer, size_t candidate);
/// Chooses more candidates, for what the gaps leave unseen. *more: there are some. Else *closed:
/// all gaps lie in cells that are seen from their middles, so that nothing is unseen.
sl_status sli_choose_for_gaps(sli_placer *placer, bool *more, bool *closed);

// --- candidates (candidates.c)

/// Adds a candidate, once; *number is UINT32_MAX where nothing can be seen from there.
sl_status sli_add_candidate(sli_placer *placer, sl_point at, uint32_t *number);
/// Fails: no place that is given sees a point.
sl_status sli_fail_unseen(const sli_placer *placer, sl_point at);
/// Adds the corners that hide something from a witness.
sl_status sli_add_corners(sli_placer *placer);
/// Adds places in line with walls, or with two corners, that the chosen ones have gaps at.
sl_status sli_add_in_line(sli_placer *placer);
/// Adds a candidate for a column of the lower bound. It sees the column's witnesses, or as many as
/// can be found. *number as in sli_add_candidate().
sl_status sli_add_column(sli_placer *placer, const sli_place_columns *columns, uint32_t column,
                         uint32_t *number);
sl_cover_options sli_cover_options(const sli_placer *placer);
/// Chooses the fewest candidates that see all witnesses and germs. `problem` and `cover` are the
/// caller's, on failure too: sli_choice_destroy(). SL_BAD_ARGUMENT, with the witness, where
/// candidates are given and none of them sees it.
sl_status sli_choose_fewest(sli_placer *placer, sl_cover_problem *problem, sl_cover_result *cover);
void sli_choice_destroy(sl_context *context, sl_cover_problem *problem, sl_cover_result *cover);
/// Notes a witness where a candidate sees it.
sl_status sli_try_seeing(sli_placer *placer, size_t candidate, uint32_t witness);
const sli_look *sli_chosen_look(const sli_placer *placer, size_t i);
sl_status sli_is_seen(sli_placer *placer, sl_point at, bool *seen); ///< by a chosen candidate
/// Chooses no candidate; and one more.
void sli_choose_none(sli_placer *placer);
sl_status sli_choose(sli_placer *placer, uint32_t candidate);
/// Drops chosen candidates where others see all the witnesses and germs that they do. What only
/// they saw, gaps tell: of each part of the plan that has a witness some is still seen. *dropped:
/// there were some.
sl_status sli_drop_redundant(sli_placer *placer, bool *dropped);

#endif
