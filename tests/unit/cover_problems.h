/// Random set cover problems for tests: small ones of all kinds, and the least cost by trying every
/// set.
#ifndef SL_COVER_PROBLEMS_H
#define SL_COVER_PROBLEMS_H

#include "testing.h"

#include "sightline/set_cover.h"
#include "sightline/support.h"

enum { COVER_COLUMNS = 4096, COVER_ROWS = 1024, COVER_ENTRIES = 1 << 17 };

typedef struct cover_problem {
    sl_cover_problem problem;
    size_t ends[COVER_COLUMNS];
    uint32_t entries[COVER_ENTRIES], costs[COVER_COLUMNS], demands[COVER_ROWS];
} cover_problem;

/// Work that is cancelled when it asks for the last time, by sl_hooks.cancelled.
typedef struct cover_patience {
    unsigned long asked, most;
} cover_patience;

static inline bool cover_is_over(void *user) {
    cover_patience *q = user;
    return q->asked++ >= q->most;
}

/// An empty problem to add columns to, in ascending order of their rows.
static inline void cover_begin(cover_problem *p, uint32_t rows) {
    p->problem = (sl_cover_problem){rows, 0, p->ends, p->entries, NULL, NULL};
}

static inline size_t cover_end(const cover_problem *p) {
    return p->problem.column_count ? p->ends[p->problem.column_count - 1] : 0;
}

static inline void cover_add_column(cover_problem *p) {
    const size_t end = cover_end(p);
    assert_true(p->problem.column_count < COVER_COLUMNS);
    p->ends[p->problem.column_count++] = end;
}

static inline void cover_add_entry(cover_problem *p, uint32_t row) {
    size_t *end = &p->ends[p->problem.column_count - 1];
    assert_true(*end < COVER_ENTRIES);
    p->entries[(*end)++] = row;
}

/// Each entry by chance, one in `sparse`.
static inline void cover_random(cover_problem *p, sl_random *random, uint32_t rows,
                                uint32_t columns, uint32_t sparse) {
    cover_begin(p, rows);
    for (uint32_t j = 0; j < columns; j++) {
        cover_add_column(p);
        for (uint32_t r = 0; r < rows; r++)
            if (sl_random_below(random, sparse) == 0) cover_add_entry(p, r);
    }
}

/// How many columns a row has.
static inline uint32_t cover_row_size(const cover_problem *p, uint32_t row) {
    uint32_t size = 0;
    for (size_t i = 0; i < cover_end(p); i++) size += p->entries[i] == row;
    return size;
}

/// Demands of 0 to `most`, as far as rows have columns; at least 1 where `most` is 1.
static inline void cover_demand(cover_problem *p, sl_random *random, uint32_t most) {
    for (uint32_t r = 0; r < p->problem.row_count; r++) {
        const uint32_t size = cover_row_size(p, r);
        p->demands[r] = most == 1 ? 1 : (uint32_t)sl_random_below(random, most + 1);
        if (p->demands[r] > size) p->demands[r] = size;
    }
    p->problem.demands = p->demands;
}

/// Costs of 1 to `most`, times `unit`.
static inline void cover_cost(cover_problem *p, sl_random *random, uint32_t most, uint32_t unit) {
    for (uint32_t j = 0; j < p->problem.column_count; j++)
        p->costs[j] = unit * (1 + (uint32_t)sl_random_below(random, most));
    p->problem.costs = p->costs;
}

/// A small problem: any shape, demands and costs or none.
static inline void cover_small(cover_problem *p, sl_random *random) {
    const uint32_t columns = 1 + (uint32_t)sl_random_below(random, 11);
    const uint32_t rows = (uint32_t)sl_random_below(random, 12);
    cover_random(p, random, rows, columns, 2 + (uint32_t)sl_random_below(random, 5));
    static const uint32_t most[] = {1, 1, 2, 3};
    cover_demand(p, random, most[sl_random_below(random, 4)]);
    if (sl_random_below(random, 2))
        cover_cost(p, random, 1 + (uint32_t)sl_random_below(random, 9),
                   1 + (uint32_t)sl_random_below(random, 3));
}

/// Steiner triples (Fulkerson, Nemhauser and Trotter 1974): points are vectors of three values, and
/// each line of three of them is a row. 9, 27 or 81 points; A27 has 117 rows and needs 18 columns.
static inline void cover_steiner(cover_problem *p, uint32_t dimensions) {
    uint32_t points = 1, row = 0;
    for (uint32_t d = 0; d < dimensions; d++) points *= 3;
    cover_begin(p, 0);
    // The third point of a line: in each place, what makes the sum divisible by three.
    for (uint32_t j = 0; j < points; j++) {
        cover_add_column(p);
        row = 0;
        for (uint32_t a = 0; a < points; a++)
            for (uint32_t b = a + 1; b < points; b++) {
                uint32_t c = 0;
                for (uint32_t unit = 1; unit < points; unit *= 3)
                    c += (6 - a / unit % 3 - b / unit % 3) % 3 * unit;
                if (c <= b) continue;
                if (j == a || j == b || j == c) cover_add_entry(p, row);
                row++;
            }
    }
    p->problem.row_count = row;
}

/// Points and discs about them in a square: a point is a row, a disc the column of the points in
/// it.
static inline void cover_discs(cover_problem *p, sl_random *random, uint32_t rows, uint32_t columns,
                               double radius) {
    static sl_point points[COVER_ROWS];
    for (uint32_t r = 0; r < rows; r++)
        points[r] = (sl_point){sl_random_unit(random), sl_random_unit(random)};
    cover_begin(p, rows);
    for (uint32_t j = 0; j < columns; j++) {
        const sl_point at =
            j < rows ? points[j] : (sl_point){sl_random_unit(random), sl_random_unit(random)};
        cover_add_column(p);
        for (uint32_t r = 0; r < rows; r++) {
            const double x = points[r].x - at.x, y = points[r].y - at.y;
            if (x * x + y * y <= radius * radius) cover_add_entry(p, r);
        }
    }
}

static inline bool cover_holds(const cover_problem *p, const uint8_t *taken) {
    uint32_t covered[COVER_ROWS] = {0};
    for (uint32_t j = 0; j < p->problem.column_count; j++)
        for (size_t i = j ? p->ends[j - 1] : 0; i < p->ends[j] && taken[j]; i++)
            covered[p->entries[i]]++;
    for (uint32_t r = 0; r < p->problem.row_count; r++)
        if (covered[r] < (p->problem.demands ? p->demands[r] : 1)) return false;
    return true;
}

static inline uint64_t cover_cost_of(const cover_problem *p, const uint8_t *taken) {
    uint64_t cost = 0;
    for (uint32_t j = 0; j < p->problem.column_count; j++)
        if (taken[j]) cost += p->problem.costs ? p->costs[j] : 1;
    return cost;
}

/// The least cost, by trying all sets; UINT64_MAX where none covers.
static inline uint64_t cover_brute(const cover_problem *p) {
    uint64_t least = UINT64_MAX;
    uint8_t taken[32];
    for (uint32_t set = 0; set < 1u << p->problem.column_count; set++) {
        for (uint32_t j = 0; j < p->problem.column_count; j++) taken[j] = set >> j & 1;
        const uint64_t cost = cover_cost_of(p, taken);
        if (cost < least && cover_holds(p, taken)) least = cost;
    }
    return least;
}

static inline uint64_t cover_proves(sl_context *context, const cover_problem *p,
                                    const sl_cover_proof *proof) {
    uint64_t lower;
    assert_ok(context, sl_cover_check(context, &p->problem, proof, &lower));
    return lower;
}

/// What every result must keep: it covers, costs what it says, and its proof proves its bound.
static inline void cover_check_result(sl_context *context, const cover_problem *p,
                                      const sl_cover_result *r) {
    static uint8_t taken[COVER_COLUMNS];
    memset(taken, 0, sizeof taken);
    for (uint32_t i = 0; i < r->count; i++) {
        assert_true(r->columns[i] < p->problem.column_count);
        assert_true(i == 0 || r->columns[i - 1] < r->columns[i]);
        taken[r->columns[i]] = 1;
    }
    assert_true(cover_holds(p, taken));
    assert_true(cover_cost_of(p, taken) == r->cost);
    assert_true(r->lower <= r->cost);
    const uint64_t proven = cover_proves(context, p, &r->proof);
    if (proven != r->lower)
        fail_msg("claims %llu, proves %llu", (unsigned long long)r->lower,
                 (unsigned long long)proven);
}

/// Changes a number of a proof, and puts it back. No change may prove more than `least`.
static inline void cover_change(sl_context *context, const cover_problem *p,
                                const sl_cover_proof *proof, uint32_t *number, uint32_t to,
                                uint64_t least) {
    const uint32_t was = *number;
    *number = to;
    assert_true(cover_proves(context, p, proof) <= least);
    *number = was;
}

/// Memory fails once, at each of many allocations.
static inline void cover_without_memory(const cover_problem *p, const sl_cover_options *options) {
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    long failed = 0;
    memory.once = true;
    for (long n = 1, done = 0; !done; n += 1 + n / 16) {
        sl_cover_result result = {0};
        memory.fail_at = memory.calls + n;
        const sl_status status = sl_cover_solve(context, &p->problem, options, &result);
        done = memory.calls < memory.fail_at;
        memory.fail_at = 0;
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        failed += status == SL_NO_MEMORY;
        sl_cover_result_destroy(context, &result);
    }
    assert_true(failed > 20);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

#endif
