/// Gates: the open ways from cell to cell on foot, and the corners that ways turn around.

// A corner is what ways turn around: the end of a wall, as it is met from one side. The gates that
// end at a point are in rows: two that are next to each other in a cell are joined. Where walls
// meet, they part what is around the point, and each part has a row and a corner of its own:
//
//       A | B        the gates (dots) around the point: those of A and C in one row, those of B
//     ....+....      and D in another one. No way leads from one row to the other here.
//       C | D
//
// A row that closes to a ring has no wall at its point: nothing is to turn around. (lib/analysis/
// route/corners.c does that for all corners at once; here it is one at a time, as doors stand.)

/// An open portal, or a wall that steps pass, as a cell crosses it.
typedef struct slrt_gate {
    uint32_t number; ///< of the directed portal; passages follow all of them
    uint32_t portal; ///< the same from both sides; walls of passages follow all portals
    uint32_t cell;   ///< beyond it
    double end[2][2];
} slrt_gate;

/// Sides of a gate.
enum { SLRT_GATE_RIGHT, SLRT_GATE_LEFT };

/// The gates of a cell: its directed portals, then its passages.
typedef struct slrt_gates {
    const sl_runtime *rt;
    const unsigned char *shut; ///< NULL for none
    uint32_t cell;
    uint32_t directed, directed_end; ///< those to come
    uint32_t passage;
} slrt_gates;

static slrt_gates slrt_gates_of(const sl_runtime *rt, const unsigned char *shut, uint32_t cell) {
    const sl_runtime_cell c = sl_runtime_get_cell(rt, cell);
    slrt_gates of;
    of.rt = rt;
    of.shut = shut;
    of.cell = cell;
    of.directed = c.first_directed;
    of.directed_end = c.first_directed + c.directed_count;
    of.passage = slrt_next_way(rt, cell, slrt_first_passage(rt, cell));
    return of;
}

/// Whether a seam that a gate is on keeps who walks from passing it: a shut door, glass that leads
/// to the dark, a wall that stops steps.
static bool slrt_seam_bars(const slrt_gates *of, const slrt_gate *gate, uint32_t number) {
    const unsigned char *seam = of->rt->seams + (size_t)number * 40;
    const uint32_t kind = slrt_u32(seam + 32);
    if (kind == 1 && of->shut && of->shut[slrt_u32(seam + 36)]) return true;
    if (kind == 2) {
        const slrt_arm along = slrt_make_arm(slrt_f64(seam), slrt_f64(seam + 8),
                                             slrt_f64(seam + 16), slrt_f64(seam + 24));
        const slrt_arm to_left =
            slrt_make_arm(gate->end[0][0], gate->end[0][1], gate->end[1][0], gate->end[1][1]);
        if (slrt_same_way(&to_left, &along)) return true;
    }
    return (slrt_seam_stops(of->rt, number) & SL_RUNTIME_STOPS_STEPS) != 0;
}

static bool slrt_is_gate_barred(const slrt_gates *of, const slrt_gate *gate) {
    const sl_runtime *rt = of->rt;
    uint32_t i;
    if (gate->number >= rt->directed_count) {
        for (i = 0; i < rt->seam_count; i++)
            if (slrt_seam_bars(of, gate, i) && slrt_seam_covers(rt, i, gate->end[0], gate->end[1]))
                return true;
        return false;
    }
    if (!rt->seam_portal_count) return false;
    for (i = slrt_first_seam(rt, gate->portal); i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12;
        if (slrt_u32(on) != gate->portal) break;
        if (slrt_seam_bars(of, gate, slrt_u32(on + 4))) return true;
    }
    return false;
}

/// Reads a gate, open or not.
static void slrt_read_gate(const sl_runtime *rt, uint32_t number, slrt_gate *out) {
    out->number = number;
    if (number < rt->directed_count) {
        const sl_runtime_directed_portal d = sl_runtime_get_directed_portal(rt, number);
        out->portal = d.portal;
        out->cell = d.cell;
        memcpy(out->end[SLRT_GATE_RIGHT], d.right, sizeof d.right);
        memcpy(out->end[SLRT_GATE_LEFT], d.left, sizeof d.left);
    } else {
        const uint32_t passage = number - rt->directed_count;
        const unsigned char *at = rt->passages + (size_t)passage * SLRT_PASSAGE_BYTES;
        out->portal = rt->portal_count + (slrt_u32(at + 4) & INT32_MAX);
        out->cell = slrt_u32(at + 8);
        slrt_read_passage(rt, passage, out->end[SLRT_GATE_RIGHT], out->end[SLRT_GATE_LEFT]);
    }
}

/// The next gate that is open; false behind the last.
static bool slrt_next_gate(slrt_gates *of, slrt_gate *out) {
    const sl_runtime *rt = of->rt;
    while (of->directed < of->directed_end) {
        slrt_read_gate(rt, of->directed++, out);
        if (!slrt_is_gate_barred(of, out)) return true;
    }
    while (of->passage < rt->passage_count) {
        slrt_read_gate(rt, rt->directed_count + of->passage, out);
        of->passage = slrt_next_way(rt, of->cell, of->passage + 1);
        if (!slrt_is_gate_barred(of, out)) return true;
    }
    return false;
}

/// The number of an end of a gate, the same from both sides.
static uint32_t slrt_gate_end(const slrt_gate *gate, int side) {
    const double *a = gate->end[side], *b = gate->end[!side];
    return 2 * gate->portal + ((a[0] != b[0] ? a[0] > b[0] : a[1] > b[1]) ? 1u : 0u);
}

/// What a cell has at a point where a gate ends.
typedef struct slrt_turnstile {
    bool opens; ///< the gate is open from here
    bool has_next;
    slrt_gate next; ///< the gate that ends there beside it
} slrt_turnstile;

/// Looks for the gate beside a gate, the one whose end at `side` is at a point.
static slrt_turnstile slrt_turnstile_of(slrt_gates of, uint32_t portal, int side, const double *at,
                                        uint64_t *patience) {
    slrt_turnstile found;
    slrt_gate gate;
    memset(&found, 0, sizeof found);
    while (!(found.opens && found.has_next) && *patience && slrt_next_gate(&of, &gate)) {
        --*patience;
        if (gate.portal == portal) {
            found.opens = true;
        } else if (slrt_same_place(gate.end[side], at)) {
            found.has_next = true;
            found.next = gate;
        }
    }
    return found;
}

/// The row that has an end of a gate of a cell, seen from beyond the gate: the least number of its
/// ends. SLRT_NONE for a ring.
static uint32_t slrt_row_at(const sl_runtime *rt, const unsigned char *shut, uint32_t cell,
                            const slrt_gate *gate, int side, uint64_t *patience) {
    const double *at = gate->end[side];
    uint32_t least = slrt_gate_end(gate, side), beyond = gate->cell, portal = gate->portal;
    slrt_turnstile t;
    while (true) {
        uint32_t number;
        t = slrt_turnstile_of(slrt_gates_of(rt, shut, beyond), portal, side, at, patience);
        if (!t.opens || !t.has_next || !*patience) break;
        if (t.next.portal == gate->portal) return SLRT_NONE;
        number = slrt_gate_end(&t.next, side);
        least = number < least ? number : least;
        beyond = t.next.cell;
        portal = t.next.portal;
    }
    t.next = *gate;
    while (true) { // the other way around the point
        uint32_t number;
        t = slrt_turnstile_of(slrt_gates_of(rt, shut, cell), t.next.portal, !side, at, patience);
        if (!t.opens || !t.has_next || !*patience) return least;
        number = slrt_gate_end(&t.next, !side);
        least = number < least ? number : least;
        cell = t.next.cell;
    }
}
