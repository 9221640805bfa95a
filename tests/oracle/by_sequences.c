// Who sees whom, by depth-first search over every portal sequence.
#include "oracle/oracle.h"

#include <stdlib.h>

typedef struct search {
    const sl_space *space;
    oracle_sequence *sequence;
    uint64_t left;       ///< portals that may still be pushed
    bool *closed, *open; ///< the source's rows
} search;

static bool go_on(search *s, uint32_t at) {
    const sl_cell *cell = &s->space->cells[at];
    bool within = true;
    for (uint32_t i = 0; within && i < cell->directed_count; i++) {
        const sl_directed_portal *directed = &s->space->directed[cell->first_directed + i];
        oracle_portal portal = {directed->left, directed->right};
        if (!oracle_sequence_forwards(s->sequence, portal)) continue;
        if (s->left == 0) return false;
        s->left--;
        sl_stab_verdict verdict = oracle_sequence_push(s->sequence, portal);
        if (verdict != SL_HIDDEN) {
            s->closed[directed->cell] = true;
            if (verdict == SL_STABBED) s->open[directed->cell] = true;
            within = go_on(s, directed->cell);
        }
        oracle_sequence_pop(s->sequence);
    }
    return within;
}

bool oracle_by_sequences(const sl_space *space, uint64_t limit, bool *closed, bool *open) {
    search s = {.space = space, .left = limit};
    sl_point *ends = calloc(2 * (size_t)space->directed_count + 1, sizeof *ends);
    if (!ends) abort();
    for (uint32_t i = 0; i < space->directed_count; i++) {
        ends[2 * i] = space->directed[i].left;
        ends[2 * i + 1] = space->directed[i].right;
    }
    s.sequence = oracle_sequence_create(ends, 2 * (size_t)space->directed_count);
    free(ends);
    bool within = true;
    for (uint32_t c = 0; within && c < space->cell_count; c++) {
        if (space->cells[c].solid) continue; // nobody looks from there
        s.closed = closed + (size_t)c * space->cell_count;
        s.open = open + (size_t)c * space->cell_count;
        s.closed[c] = s.open[c] = true;
        within = go_on(&s, c);
    }
    oracle_sequence_destroy(s.sequence);
    return within;
}
