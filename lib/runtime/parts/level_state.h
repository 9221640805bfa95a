/// Doors that stand as they do in one game, and rows that follow them.

// The row of a cell is searched through portals, depth first. No line enters a cell that the baked
// row, past shut doors, has not. So those cells alone are looked for, and a settled row has a bit
// for each cell of the baked one. A door matters to the rows that have a cell beside it: a line
// that passes the door comes to such a cell before it.

/// The limit of portals that the search of one row comes to, for each directed portal of the map.
#ifndef SLRT_SETTLE_PATIENCE
#define SLRT_SETTLE_PATIENCE 64
#endif

enum {
    SLRT_STEP_WORDS = sizeof(slrt_stab_step) / sizeof(uint32_t),
    SLRT_CORNER_WORDS = sizeof(slrt_corner) / sizeof(uint32_t),
    SLRT_CORNERS_MORE = 1024
};

/// Corners in a state: 4 for each cell that a sequence may pass, and some more.
static uint32_t slrt_corner_room(const sl_runtime *rt) {
    return 4 * rt->cell_count + SLRT_CORNERS_MORE;
}

static size_t slrt_row_words(const sl_runtime *rt, uint32_t cell) {
    return ((size_t)sl_runtime_row_count(rt, cell) + 31) / 32;
}

SL_RUNTIME_API size_t sl_runtime_state_count(const sl_runtime *runtime) {
    const size_t cells = runtime->cell_count;
    size_t words = 2 * cells + 1 + (cells + 31) / 32 + ((size_t)runtime->door_count + 3) / 4;
    uint32_t i;
    for (i = 0; i < runtime->cell_count; i++) words += slrt_row_words(runtime, i);
    return words + SLRT_STEP_WORDS * (cells + 1) +
           (size_t)SLRT_CORNER_WORDS * slrt_corner_room(runtime);
}

SL_RUNTIME_API void sl_runtime_state_start(sl_runtime_state *out, const sl_runtime *runtime,
                                           uint32_t *memory) {
    const size_t cells = runtime->cell_count;
    size_t words = 0;
    uint32_t i;
    memset(out, 0, sizeof *out);
    out->runtime = runtime;
    out->first = memory;
    out->settled = out->first + cells + 1;
    out->ranks = out->settled + (cells + 31) / 32;
    out->steps = out->ranks + cells;
    out->corners = out->steps + SLRT_STEP_WORDS * (cells + 1);
    out->bits = out->corners + (size_t)SLRT_CORNER_WORDS * slrt_corner_room(runtime);
    memset(out->settled, 0, (cells + 31) / 32 * sizeof *memory);
    memset(out->ranks, 0xff, cells * sizeof *memory);
    for (i = 0; i < runtime->cell_count; i++) {
        out->first[i] = (uint32_t)words;
        words += slrt_row_words(runtime, i);
        if (words == out->first[i])
            out->settled[i / 32] |= UINT32_C(1) << i % 32; // without a row
        else
            out->unsettled++;
    }
    out->first[cells] = (uint32_t)words;
    out->shut = (unsigned char *)(out->bits + words);
    out->row = SLRT_NONE;
    for (i = 0; i < runtime->door_count; i++) out->shut[i] = !sl_runtime_door_open(runtime, i);
}

// --- changes

static bool slrt_is_settled(const sl_runtime_state *state, uint32_t cell) {
    return state->settled[cell / 32] >> cell % 32 & 1;
}

/// The place of a cell among those of a row; SLRT_NONE if it is not in the row.
static uint32_t slrt_rank(const sl_runtime *rt, uint32_t from, uint32_t to) {
    sl_runtime_run run;
    uint32_t rank = 0;
    if (!slrt_may_see(rt, from, to)) return SLRT_NONE;
    run = sl_runtime_row(rt, from);
    while (sl_runtime_next(&run)) {
        if (to < run.end) return to >= run.first ? rank + (to - run.first) : SLRT_NONE;
        rank += run.end - run.first;
    }
    return SLRT_NONE;
}

SL_RUNTIME_API bool sl_runtime_state_can_see(const sl_runtime_state *state, uint32_t from,
                                             uint32_t to) {
    uint32_t rank;
    if (from >= state->runtime->cell_count) return false;
    if (!slrt_is_settled(state, from))
        return sl_runtime_can_see_past(state->runtime, from, to, state->shut);
    rank = slrt_rank(state->runtime, from, to);
    return rank != SLRT_NONE && state->bits[state->first[from] + rank / 32] >> rank % 32 & 1;
}

/// Leaves the search of a row: the row is not settled.
static void slrt_leave_row(sl_runtime_state *state) {
    sl_runtime_run run;
    if (state->row == SLRT_NONE) return;
    run = sl_runtime_row(state->runtime, state->row);
    while (sl_runtime_next(&run))
        memset(state->ranks + run.first, 0xff, (run.end - run.first) * sizeof *state->ranks);
    state->row = SLRT_NONE;
    state->depth = 0;
}

/// Unsettles the rows that have a cell. If no glass makes it one-way, these are of cells that are
/// in the row of that cell.
static void slrt_unsettle(sl_runtime_state *state, uint32_t cell) {
    const sl_runtime *rt = state->runtime;
    sl_runtime_run run = sl_runtime_row(rt, cell);
    uint32_t i;
    if (rt->has_glass) {
        run.first = 0;
        run.end = rt->cell_count;
        run.next = run.stop;
    } else if (!sl_runtime_next(&run))
        return;
    do
        for (i = run.first; i < run.end; i++)
            if (slrt_is_settled(state, i) && sl_runtime_state_can_see(state, i, cell)) {
                state->settled[i / 32] &= ~(UINT32_C(1) << i % 32);
                state->unsettled++;
            }
    while (sl_runtime_next(&run));
}

static bool slrt_same_door(const sl_runtime *rt, uint32_t a, uint32_t b) {
    const sl_runtime_name p = sl_runtime_door_name(rt, a), q = sl_runtime_door_name(rt, b);
    return a == b || (p.length == q.length && !memcmp(p.text, q.text, p.length));
}

/// Whether a door may be opened or shut, as it stands.
static bool slrt_may_set(const sl_runtime_state *state, uint32_t door, bool shut) {
    const sl_runtime_door_kind kind = sl_runtime_get_door_kind(state->runtime, door);
    return !state->shut[door] == !shut || kind != (shut ? SL_RUNTIME_BREAKABLE : SL_RUNTIME_SITE);
}

SL_RUNTIME_API bool sl_runtime_state_set_door(sl_runtime_state *state, uint32_t door, bool shut) {
    const sl_runtime *rt = state->runtime;
    bool changes = false;
    uint32_t i;
    if (door >= rt->door_count) return false;
    for (i = 0; i < rt->door_count; i++)
        if (slrt_same_door(rt, i, door) && !slrt_may_set(state, i, shut)) return false;
    for (i = 0; i < rt->door_count; i++) {
        if (!state->shut[i] == !shut || !slrt_same_door(rt, i, door)) continue;
        state->shut[i] = shut;
        changes = true;
    }
    if (!changes) return true;
    slrt_leave_row(state);
    for (i = 0; i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12;
        const unsigned char *seam = rt->seams + (size_t)slrt_u32(on + 4) * 40;
        const unsigned char *portal = rt->portals + (size_t)slrt_u32(on) * SLRT_PORTAL_BYTES;
        if (slrt_u32(seam + 32) != 1 || !slrt_same_door(rt, slrt_u32(seam + 36), door)) continue;
        slrt_unsettle(state, slrt_u32(portal));
        slrt_unsettle(state, slrt_u32(portal + 4));
    }
    return true;
}

// --- the search of a row

/// Whether a directed portal is on a shut door, or on glass that is dark as it leads.
static bool slrt_is_barred(const sl_runtime_state *state, uint32_t directed) {
    const sl_runtime *rt = state->runtime;
    const uint32_t portal = slrt_u32(rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES);
    uint32_t i;
    if (!rt->seam_portal_count) return false;
    for (i = slrt_first_seam(rt, portal); i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12, *seam;
        if (slrt_u32(on) != portal) return false;
        seam = rt->seams + (size_t)slrt_u32(on + 4) * 40;
        if (slrt_u32(seam + 32) == 1 && state->shut[slrt_u32(seam + 36)]) return true;
        if (slrt_u32(seam + 32) == 2 && slrt_leads_along(rt, directed, seam)) return true;
    }
    return false;
}

static void slrt_find(sl_runtime_state *state, uint32_t cell) {
    const uint32_t rank = state->ranks[cell];
    uint32_t *word = state->bits + state->first[state->row] + rank / 32;
    if (*word >> rank % 32 & 1) return;
    *word |= UINT32_C(1) << rank % 32;
    state->missing--;
}

static slrt_stab_step *slrt_steps(const sl_runtime_state *state) {
    return (slrt_stab_step *)state->steps;
}

/// Starts with the next row that is not settled: numbers the cells that are looked for by their
/// places in it. Returns how many there are.
static uint32_t slrt_start_row(sl_runtime_state *state) {
    const sl_runtime *rt = state->runtime;
    slrt_stab_step *step = slrt_steps(state);
    slrt_door_pairs pairs;
    sl_runtime_run run;
    uint32_t cell = state->next, rank = 0, i;
    while (slrt_is_settled(state, cell)) cell = cell + 1 < rt->cell_count ? cell + 1 : 0;
    state->row = cell;
    state->next = cell + 1 < rt->cell_count ? cell + 1 : 0;
    state->missing = 0;
    state->patience = SLRT_SETTLE_PATIENCE * ((uint64_t)rt->directed_count + 1024);
    memset(state->bits + state->first[cell], 0,
           (state->first[cell + 1] - state->first[cell]) * sizeof *state->bits);
    pairs = slrt_door_pairs_of(rt, cell);
    run = sl_runtime_row(rt, cell);
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++, rank++) {
            if (!slrt_pair_is_open(&pairs, i, state->shut)) continue;
            state->ranks[i] = rank;
            state->missing++;
        }
    slrt_find(state, cell);
    memset(step, 0, sizeof *step);
    step->cell = cell;
    step->line = SLRT_NONE;
    state->depth = 1;
    return rank;
}

/// Takes the next way out of the last cell. False if the search has to give up.
static bool slrt_search_row(sl_runtime_state *state) {
    slrt_stab_step *step = slrt_steps(state) + state->depth - 1;
    const sl_runtime_cell cell = sl_runtime_get_cell(state->runtime, step->cell);
    const uint32_t directed = cell.first_directed + step->done;
    uint32_t to;
    slrt_stab stab;
    if (step->done == cell.directed_count) {
        state->depth--;
        return true;
    }
    step->done++;
    to = slrt_cell_across(state->runtime, directed);
    if (state->ranks[to] == SLRT_NONE || slrt_is_barred(state, directed)) return true;
    stab.rt = state->runtime;
    stab.corners = (slrt_corner *)state->corners;
    stab.room = slrt_corner_room(state->runtime);
    stab.full = false;
    if (!slrt_stab_push(&stab, step, directed, step + 1)) return true;
    // No line enters a cell twice: a longer sequence is that of a damaged file.
    if (stab.full || state->depth > state->runtime->cell_count) return false;
    step[1].cell = to;
    slrt_find(state, to);
    state->depth++;
    return true;
}

/// Ends the search of a row. If it gave up, all that was looked for counts as seen.
static void slrt_settle_row(sl_runtime_state *state, bool gave_up) {
    const uint32_t cell = state->row;
    sl_runtime_run run = sl_runtime_row(state->runtime, cell);
    uint32_t i;
    while (gave_up && sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++)
            if (state->ranks[i] != SLRT_NONE) slrt_find(state, i);
    slrt_leave_row(state);
    state->settled[cell / 32] |= UINT32_C(1) << cell % 32;
    state->unsettled--;
}

SL_RUNTIME_API uint32_t sl_runtime_settle(sl_runtime_state *state, uint32_t portals) {
    while (state->unsettled && portals) {
        bool gave_up = false;
        if (state->row == SLRT_NONE) {
            const uint32_t cost = 1 + slrt_start_row(state) / 16;
            portals -= cost < portals ? cost : portals;
        }
        for (; portals && state->depth && state->missing && !gave_up; portals--)
            gave_up = !state->patience-- || !slrt_search_row(state);
        if (!state->depth || !state->missing || gave_up) {
            if (gave_up) state->given_up++;
            slrt_settle_row(state, gave_up);
        }
    }
    return state->unsettled;
}

SL_RUNTIME_API uint32_t sl_runtime_state_row_bits(const sl_runtime_state *state, uint32_t cell,
                                                  unsigned char *bits) {
    const sl_runtime *rt = state->runtime;
    sl_runtime_run run = sl_runtime_row(rt, cell);
    uint32_t rank = 0, count = 0, i;
    if (cell >= rt->cell_count || !slrt_is_settled(state, cell))
        return sl_runtime_seen_from(rt, &cell, 1, state->shut, bits);
    memset(bits, 0, ((size_t)rt->cell_count + 7) / 8);
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++, rank++) {
            if (!(state->bits[state->first[cell] + rank / 32] >> rank % 32 & 1)) continue;
            bits[i / 8] |= (unsigned char)(1 << i % 8);
            count++;
        }
    return count;
}
