/// Whole servers: which players may see which things.

/// The part of a box, with a margin around it, within the bounds of the map. False for none. It is
/// where the points of the box are for sl_runtime_sees, too, by slrt_no_dust.
static bool slrt_box_in_map(const sl_runtime *rt, const sl_runtime_box *of, double margin,
                            double box[4]) {
    const double low_x = slrt_no_dust(of->min_x - margin), low_y = slrt_no_dust(of->min_y - margin);
    const double high_x = slrt_no_dust(of->max_x + margin);
    const double high_y = slrt_no_dust(of->max_y + margin);
    box[0] = low_x > rt->min_x ? low_x : rt->min_x;
    box[1] = low_y > rt->min_y ? low_y : rt->min_y;
    box[2] = high_x < rt->max_x ? high_x : rt->max_x;
    box[3] = high_y < rt->max_y ? high_y : rt->max_y;
    return low_x <= high_x && low_y <= high_y && box[0] <= box[2] && box[1] <= box[3];
}

// --- from all of a box

/// A search from the cells of a box.
typedef struct slrt_origin {
    slrt_beams beams;
    uint32_t sources[32], count; ///< the last cells that it came from: a cell may be visited again
} slrt_origin;

static bool slrt_look_from_cell(void *context, uint32_t cell) {
    slrt_origin *o = (slrt_origin *)context;
    enum { MOST = sizeof o->sources / sizeof *o->sources };
    uint32_t i;
    for (i = 0; i < MOST && i < o->count; i++)
        if (o->sources[i] == cell) return true;
    if (sl_runtime_is_solid(o->beams.rt, cell) || !slrt_meets_box(o->beams.rt, cell, o->beams.box))
        return true;
    o->sources[o->count++ % MOST] = cell;
    return !slrt_send_beams(&o->beams, cell);
}

/// Prepares searches. `scratch` has six numbers and a bit for each cell.
static void slrt_start_origin(slrt_origin *o, const sl_runtime *rt, const unsigned char *shut,
                              double range, uint32_t *scratch) {
    memset(&o->beams, 0, sizeof o->beams);
    o->beams.rt = rt;
    o->beams.shut = shut;
    o->beams.range = slrt_range(rt, range);
    o->beams.path = scratch;
    o->beams.on_path = scratch + SLRT_BEAM_STEP * (size_t)rt->cell_count;
    memset(o->beams.on_path, 0, ((size_t)rt->cell_count + 31) / 32 * sizeof *scratch);
}

/// Looks from all of a box. True if `meet` ended the search, or it took too long.
static bool slrt_look_from_box(slrt_origin *o, const sl_runtime_box *box, double margin) {
    if (!slrt_box_in_map(o->beams.rt, box, margin, o->beams.box)) return false;
    memset(o->beams.past, 0xff, sizeof o->beams.past);
    o->beams.patience = SLRT_BEAM_PATIENCE * ((uint64_t)o->beams.rt->directed_count + 1024);
    o->count = 0;
    return !slrt_visit_near(o->beams.rt, o->beams.box, slrt_look_from_cell, o);
}

// --- one box

static bool slrt_meet_target(slrt_beams *b, uint32_t cell, const slrt_beam *beam) {
    double bounds[4], part[4];
    if (!slrt_meets_box(b->rt, cell, b->target)) return false;
    slrt_bounds_of(b->rt, &b->cell, bounds);
    slrt_part_in(bounds, b->target, part);
    return !slrt_is_beam_beside(beam, part) && !slrt_is_out_of_range(b, part);
}

static sl_runtime_box slrt_square(double x, double y, double radius) {
    sl_runtime_box box;
    box.min_x = x - radius;
    box.min_y = y - radius;
    box.max_x = x + radius;
    box.max_y = y + radius;
    box.blocks = false;
    return box;
}

SL_RUNTIME_API bool sl_runtime_sees_within(const sl_runtime *runtime, double x0, double y0,
                                           double radius0, double x1, double y1, double radius1,
                                           const unsigned char *shut, double range,
                                           uint32_t *scratch) {
    const sl_runtime_box from = slrt_square(x0, y0, radius0), to = slrt_square(x1, y1, radius1);
    slrt_origin o;
    double target[4];
    if (!slrt_box_in_map(runtime, &to, 0, target)) return false;
    slrt_start_origin(&o, runtime, shut, range, scratch);
    o.beams.target = target;
    o.beams.meet = slrt_meet_target;
    return slrt_look_from_box(&o, &from, 0);
}

// --- many things

// Memory: that of a search, the first entry of each cell, and the entries. An entry is two numbers:
// a thing that comes near the cell, and the cell's next entry. Most cells are never looked into: of
// which things touch a cell is found when the first beam comes to it. There is room for a thing in
// each cell, and 16 entries for each thing. Then the parts of the things in the map, four doubles
// each.

/// Added to a cell's first entry: some of its things may not touch it.
#define SLRT_UNSORTED UINT32_C(0x80000000)

enum { SLRT_THING_PART = 4 * sizeof(double) / sizeof(uint32_t) };

typedef struct slrt_relevant {
    slrt_origin origin;
    const sl_runtime_box *things;
    uint32_t *first, *entries, *parts, count;
    size_t room;
    uint32_t thing; ///< is being placed
    unsigned char *bits;
    size_t pairs;
} slrt_relevant;

/// The part of a thing that has been placed within the bounds of the map.
static void slrt_thing_in_map(const slrt_relevant *t, uint32_t thing, double box[4]) {
    memcpy(box, t->parts + SLRT_THING_PART * (size_t)thing, SLRT_THING_PART * sizeof *t->parts);
}

static bool slrt_place_thing(void *context, uint32_t cell) {
    slrt_relevant *t = (slrt_relevant *)context;
    uint32_t *first = t->first + cell;
    const size_t at = *first & ~SLRT_UNSORTED;
    if (*first != SLRT_NO_ENTRY && t->entries[2 * at] == t->thing) return true;
    if (t->count == t->room) return false;
    t->entries[2 * (size_t)t->count] = t->thing;
    t->entries[2 * (size_t)t->count + 1] = *first == SLRT_NO_ENTRY ? *first : (uint32_t)at;
    *first = t->count++ | SLRT_UNSORTED;
    return true;
}

/// Keeps of a cell's things those that touch it.
static void slrt_sort_things(slrt_relevant *t, uint32_t cell) {
    uint32_t *link = t->first + cell;
    *link &= ~SLRT_UNSORTED;
    while (*link != SLRT_NO_ENTRY) {
        uint32_t *entry = t->entries + 2 * (size_t)*link;
        double box[4];
        slrt_thing_in_map(t, *entry, box);
        if (slrt_meets_box(t->origin.beams.rt, cell, box))
            link = entry + 1;
        else
            *link = entry[1];
    }
}

static bool slrt_meet_things(slrt_beams *b, uint32_t cell, const slrt_beam *beam) {
    slrt_relevant *t = (slrt_relevant *)b->context;
    double bounds[4];
    uint32_t at = t->first[cell];
    if (at == SLRT_NO_ENTRY) return false;
    if (at & SLRT_UNSORTED) slrt_sort_things(t, cell);
    slrt_bounds_of(b->rt, &b->cell, bounds);
    for (at = t->first[cell]; at != SLRT_NO_ENTRY; at = t->entries[2 * (size_t)at + 1]) {
        const uint32_t thing = t->entries[2 * (size_t)at];
        double box[4], part[4];
        if (t->bits[thing / 8] >> thing % 8 & 1) continue;
        slrt_thing_in_map(t, thing, box);
        slrt_part_in(bounds, box, part);
        if (slrt_is_beam_beside(beam, part) || slrt_is_out_of_range(b, part)) continue;
        t->bits[thing / 8] |= (unsigned char)(1 << thing % 8);
        t->pairs++;
    }
    return false;
}

/// Places things until there is no room. The last one and those that are left have their turn after
/// these.
static void slrt_place_things(slrt_relevant *t, uint32_t thing_count) {
    const sl_runtime *rt = t->origin.beams.rt;
    double box[4];
    memset(t->first, 0xff, rt->cell_count * sizeof *t->first);
    t->count = 0;
    for (; t->thing < thing_count; t->thing++) {
        uint32_t *part = t->parts + SLRT_THING_PART * (size_t)t->thing;
        if (!slrt_box_in_map(rt, &t->things[t->thing], 0, box)) continue;
        memcpy(part, box, sizeof box);
        if (!slrt_visit_near(rt, box, slrt_place_thing, t)) return;
    }
}

/// Takes each thing in the map for relevant.
static void slrt_meet_all(slrt_relevant *t, uint32_t thing_count) {
    double box[4];
    uint32_t i;
    for (i = 0; i < thing_count; i++) {
        if (t->bits[i / 8] >> i % 8 & 1 ||
            !slrt_box_in_map(t->origin.beams.rt, &t->things[i], 0, box))
            continue;
        t->bits[i / 8] |= (unsigned char)(1 << i % 8);
        t->pairs++;
    }
}

SL_RUNTIME_API size_t sl_runtime_relevant_count(const sl_runtime *runtime, uint32_t thing_count) {
    return sl_runtime_scratch_count(runtime) + 3 * (size_t)runtime->cell_count +
           (32 + SLRT_THING_PART) * (size_t)thing_count;
}

SL_RUNTIME_API size_t sl_runtime_relevant(const sl_runtime *runtime, const sl_runtime_box *players,
                                          uint32_t player_count, double margin,
                                          const sl_runtime_box *things, uint32_t thing_count,
                                          const unsigned char *shut, double range,
                                          uint32_t *relevant_scratch, unsigned char *bits) {
    const size_t stride = ((size_t)thing_count + 7) / 8;
    slrt_relevant t;
    uint32_t i;
    memset(bits, 0, stride * player_count);
    memset(&t, 0, sizeof t);
    slrt_start_origin(&t.origin, runtime, shut, range, relevant_scratch);
    t.origin.beams.meet = slrt_meet_things;
    t.origin.beams.context = &t;
    t.things = things;
    t.first = relevant_scratch + sl_runtime_scratch_count(runtime);
    t.entries = t.first + runtime->cell_count;
    t.room = runtime->cell_count + 16 * (size_t)thing_count;
    t.parts = t.entries + 2 * t.room;
    if (t.room >= SLRT_UNSORTED) t.room = SLRT_UNSORTED - 1;
    while (t.thing < thing_count) {
        slrt_place_things(&t, thing_count);
        for (i = 0; i < player_count; i++) {
            t.bits = bits + stride * i;
            if (slrt_look_from_box(&t.origin, &players[i], margin)) slrt_meet_all(&t, thing_count);
        }
    }
    return t.pairs;
}
