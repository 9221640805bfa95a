/// How much a drawing gives, before it is drawn: a few blocks that insert one another in rows and
/// columns give any number of entities. Each block is counted once, so the time is that of the
/// file: a block's entities, and for each INSERT its rows x columns x those of the block inserted.
/// The sums stay at UINT64_MAX where they would go beyond it. Entities with wrong numbers count for
/// little: they will be passed over.
#include "io/dxf/dxf.h"
#include "io/parts/limits.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/// Entities and insertions, and the walls that they give at least.
typedef struct amount {
    uint64_t entities, walls;
    uint64_t height; ///< of blocks within blocks
    enum { UNKNOWN, COUNTING, KNOWN } state;
} amount;

typedef struct counter {
    sli_dxf *dxf;
    amount *blocks; ///< by block
} counter;

static uint64_t number_of(const sli_dxf *dxf, sli_dxf_range entity, int code) {
    uint64_t count = 0;
    for (size_t i = entity.begin; i < entity.end; i++) count += sli_dxf_at(dxf, i)->code == code;
    return count;
}

/// The chords of an arc over so much of its circle, as the pen makes them without a tolerance.
static uint64_t chords(const sli_dxf *dxf, double share) {
    if (dxf->options->tolerance > 0) return 1;
    return share > 0 && share <= 1 ? (uint64_t)(31 * share) + 1 : 1;
}

/// Of the circle: a bulge is the tangent of a quarter of its arc's angle.
static double bulge_share(double bulge) {
    return 2 * atan(fabs(bulge)) / pi;
}

/// From the groups of an arc's two angles. `full` is a whole turn in their unit.
static uint64_t count_arc(sli_dxf *dxf, sli_dxf_range entity, int group, double full) {
    double from = 0, to = full;
    (void)sli_dxf_number(dxf, entity, group, &from);
    (void)sli_dxf_number(dxf, entity, group + 1, &to);
    const double sweep = fmod(to - from, full);
    return chords(dxf, (sweep > 0 ? sweep : sweep + full) / full);
}

/// The pieces between corners; a bulge makes one an arc. The last corner's is of the side that
/// closes the polyline.
static uint64_t count_polyline(sli_dxf *dxf, sli_dxf_range entity) {
    const uint64_t corners = number_of(dxf, entity, 10);
    uint64_t seen = 0, walls = corners ? corners - 1 : 0;
    for (size_t i = entity.begin; i < entity.end; i++) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, i);
        double bulge;
        seen += pair->code == 10;
        if (pair->code != 42 || !seen || seen == corners) continue;
        if (sli_dxf_read_number(dxf, pair, &bulge) != SL_OK) return 0;
        walls = sli_limit_sum(walls, chords(dxf, bulge_share(bulge)) - 1);
    }
    return walls;
}

/// A piece between two knots as one wall.
static uint64_t count_spline(sli_dxf *dxf, sli_dxf_range entity) {
    const uint64_t points = number_of(dxf, entity, 10);
    uint64_t walls = 0;
    double last = INFINITY;
    for (size_t i = entity.begin; i < entity.end; i++) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, i);
        double knot;
        if (pair->code != 40) continue;
        if (sli_dxf_read_number(dxf, pair, &knot) != SL_OK) return 0;
        walls += knot > last && walls + 1 < points;
        last = knot;
    }
    return walls;
}

/// The walls of an entity but for its blocks, at least.
static uint64_t count_shape(sli_dxf *dxf, sli_dxf_range entity) {
    const sli_word kind = sli_dxf_at(dxf, entity.begin)->value;
    if (sli_word_is(kind, "LINE") || sli_word_is(kind, "3DLINE")) return 1;
    if (sli_word_is(kind, "CIRCLE")) return chords(dxf, 1);
    if (sli_word_is(kind, "ARC")) return count_arc(dxf, entity, 50, 360);
    if (sli_word_is(kind, "ELLIPSE")) return count_arc(dxf, entity, 41, 2 * pi);
    if (sli_word_is(kind, "LWPOLYLINE")) return count_polyline(dxf, entity);
    if (sli_word_is(kind, "SPLINE")) return count_spline(dxf, entity);
    if (!sli_word_is(kind, "VERTEX")) return 0;
    double bulge = 0;
    (void)sli_dxf_number(dxf, entity, 42, &bulge);
    return chords(dxf, bulge_share(bulge));
}

static sl_status count_range(counter *c, sli_dxf_range range, uint64_t depth, amount *sum);

static sl_status count_insert(counter *c, sli_dxf_range entity, uint64_t depth, amount *sum) {
    sli_dxf *dxf = c->dxf;
    const sli_word name = sli_dxf_text(dxf, entity, 2);
    const sli_dxf_block *block = sli_dxf_find_block(dxf, name);
    int columns = 1, rows = 1, on_paper = 0;
    const bool good = sli_dxf_integer(dxf, entity, 67, &on_paper) == SL_OK &&
                      sli_dxf_integer(dxf, entity, 70, &columns) == SL_OK &&
                      sli_dxf_integer(dxf, entity, 71, &rows) == SL_OK;
    if (!good || !block || on_paper || columns <= 0 || rows <= 0) return SL_OK;
    amount *own = &c->blocks[block - dxf->blocks.items];
    const uint32_t line = sli_dxf_at(dxf, entity.begin)->line;
    if (own->state == COUNTING)
        return sl_fail_at(dxf->context, dxf->name, line, "block '%s' is inserted in itself",
                          sli_show(name).text);
    if (own->state == UNKNOWN) {
        char what[80];
        snprintf(what, sizeof what, "block '%s' within blocks", sli_show(name).text);
        SL_TRY(sli_limit_check(dxf->context, dxf->name, line, SLI_LIMIT_DEPTH, depth + 1, what));
        own->state = COUNTING;
        SL_TRY(count_range(c, block->entities, depth + 1, own));
        own->state = KNOWN;
    }
    if (own->height + 1 > sum->height) sum->height = own->height + 1;
    const uint64_t times = (uint64_t)columns * (uint64_t)rows;
    const uint64_t each = sli_limit_sum(own->entities, 1);
    sum->entities = sli_limit_sum(sum->entities, sli_limit_product(times, each));
    sum->walls = sli_limit_sum(sum->walls, sli_limit_product(times, own->walls));
    return SL_OK;
}

static sl_status count_range(counter *c, sli_dxf_range range, uint64_t depth, amount *sum) {
    sli_dxf *dxf = c->dxf;
    sli_dxf_range entity;
    for (size_t i = range.begin; i < range.end; i = entity.end) {
        entity = sli_dxf_entity(dxf, i, range.end);
        const sli_word kind = sli_dxf_at(dxf, i)->value;
        const uint64_t walls = count_shape(dxf, entity);
        sum->entities = sli_limit_sum(sum->entities, 1);
        // Lines of no length and other layers give none: too few walls are counted only where the
        // entities are not inserted.
        if (depth) sum->walls = sli_limit_sum(sum->walls, walls);
        if (sli_word_is(kind, "INSERT")) SL_TRY(count_insert(c, entity, depth, sum));
    }
    return SL_OK;
}

sl_status sli_dxf_check_amount(sli_dxf *dxf) {
    counter c = {.dxf = dxf};
    amount all = {0};
    c.blocks = sl_alloc_array(dxf->context, dxf->blocks.count, sizeof *c.blocks);
    if (!c.blocks) return SL_NO_MEMORY;
    sl_status status = count_range(&c, dxf->entities, 0, &all);
    sl_free(dxf->context, c.blocks);
    if (status == SL_OK)
        status = sli_limit_check(dxf->context, dxf->name, 0, SLI_LIMIT_DEPTH, all.height,
                                 "blocks within blocks");
    if (status == SL_OK)
        status = sli_limit_check(dxf->context, dxf->name, 0, SLI_LIMIT_ENTITIES, all.entities,
                                 "the drawing's blocks insert one another");
    if (status == SL_OK)
        status = sli_limit_check(dxf->context, dxf->name, 0, SLI_LIMIT_WALLS, all.walls,
                                 "the drawing's blocks give");
    return status;
}
