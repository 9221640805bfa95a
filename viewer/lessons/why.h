/// From an explanation to the lesson: the step of the search that decides.
#ifndef VIEWER_WHY_H
#define VIEWER_WHY_H

#include "lessons/learn.h"

/// The pair that was explained, and the sequence that stops, kept while the mode changes.
typedef struct why_pair {
    uint32_t from, to;
    bool seen;
    uint32_t count;
    sl_portal_ends ends[SL_DUAL_PORTALS_MOST];
} why_pair;

/// Takes the pair that was explained last, and chooses the lesson of the search, from its first
/// cell. False where nothing was explained, which is said.
bool why_take(learn_state *learn, why_pair *pair);

/// Once the lesson is there: shows the step that decides. It enters the cell for the first time, or
/// passes over the portal that stops the search.
void why_show(learn_state *learn, const why_pair *pair);

#endif
