/// Squares of two grids that lie at one place are compared, measure by measure.
#include "studies/vga_change.h"

#include "inputs/inputs.h"
#include "reports/fields.h"
#include "reports/heat_map.h"
#include "reports/summary.h"
#include "sightline/json.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

void vga_change_destroy(sl_context *context, vga_change *change) {
    sl_free(context, change->pairs);
    *change = (vga_change){0};
}

/// The order of points in grids: by column, then by row.
static int compare_squares(const sl_vga_grid *a, uint32_t p, const sl_vga_grid *b, uint32_t q) {
    const int64_t x = a->left + a->squares[p] / a->rows, u = b->left + b->squares[q] / b->rows;
    const int64_t y = a->bottom + a->squares[p] % a->rows, v = b->bottom + b->squares[q] % b->rows;
    return x != u ? (x > u) - (x < u) : (y > v) - (y < v);
}

sl_status vga_change_make(sl_context *context, const vga_table *before, const vga_table *after,
                          vga_change *out) {
    const sl_vga_grid *a = &before->grid, *b = &after->grid;
    *out = (vga_change){.before = before, .after = after};
    out->pairs = sl_alloc_array(context, (size_t)a->count + b->count, sizeof *out->pairs);
    if (!out->pairs) return SL_NO_MEMORY;
    for (uint32_t p = 0, q = 0; p < a->count || q < b->count;) {
        const int order = p == a->count ? 1 : q == b->count ? -1 : compare_squares(a, p, b, q);
        out->pairs[out->count++] =
            (vga_pair){order <= 0 ? a->points[p] : b->points[q], order <= 0 ? p : UINT32_MAX,
                       order >= 0 ? q : UINT32_MAX};
        p += order <= 0;
        q += order >= 0;
    }
    return SL_OK;
}

enum { VALUES = 3 };

/// Before, after, and the change; NAN where there is none.
static void values_of(const vga_change *c, size_t measure, const vga_pair *pair,
                      double values[VALUES]) {
    values[0] = pair->before == UINT32_MAX ? NAN : vga_value(c->before, measure, pair->before);
    values[1] = pair->after == UINT32_MAX ? NAN : vga_value(c->after, measure, pair->after);
    values[2] = values[1] - values[0];
}

static double change_of(const vga_change *c, size_t measure, const vga_pair *pair) {
    double values[VALUES];
    values_of(c, measure, pair, values);
    return values[2];
}

// --- files

static const char *const endings[VALUES] = {"", "_other", "_change"};

static sl_status write_csv(sl_context *context, const vga_change *c, FILE *out) {
    const name_table names = measure_table(SL_VGA);
    double values[VALUES];
    fputs("x,y", out);
    for (size_t k = 0; k < names.count; k++)
        for (size_t i = 0; i < VALUES && vga_has(c->before, k); i++)
            fprintf(out, ",%s%s", name_table_at(&names, k), endings[i]);
    putc('\n', out);
    for (size_t n = 0; n < c->count; n++) {
        if (n % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        csv_put(out, c->pairs[n].at.x, ",");
        csv_put(out, c->pairs[n].at.y, "");
        for (size_t k = 0; k < names.count; k++) {
            if (!vga_has(c->before, k)) continue;
            values_of(c, k, &c->pairs[n], values);
            for (size_t i = 0; i < VALUES; i++) {
                putc(',', out);
                csv_put(out, values[i], "");
            }
        }
        putc('\n', out);
    }
    return SL_OK;
}

static sl_status write_geojson(sl_context *context, const vga_change *c, FILE *file) {
    const name_table names = measure_table(SL_VGA);
    sl_geojson_writer out = sl_geojson_begin(file, &c->before->earth);
    double values[VALUES];
    char key[96];
    for (size_t n = 0; n < c->count; n++) {
        if (n % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        sl_geojson_put_point(&out, "point", c->pairs[n].at);
        for (size_t k = 0; k < names.count; k++) {
            if (!vga_has(c->before, k)) continue;
            values_of(c, k, &c->pairs[n], values);
            for (size_t i = 0; i < VALUES; i++) {
                snprintf(key, sizeof key, "%s%s", name_table_at(&names, k), endings[i]);
                sl_geojson_add_real(&out, key, values[i]);
            }
        }
        sl_geojson_end_feature(&out);
    }
    sl_geojson_end(&out);
    return SL_OK;
}

sl_status vga_change_write(sl_context *context, const vga_change *change, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output,
                           name_ends_with(path, ".geojson")
                               ? write_geojson(context, change, output.stream)
                               : write_csv(context, change, output.stream));
}

sl_status vga_change_field(sl_context *context, const vga_change *change, size_t measure,
                           double **values_out, sl_field *out) {
    const sl_vga_grid *grid = &change->before->grid;
    const size_t count = (size_t)grid->columns * grid->rows;
    double *changes = sl_alloc_array(context, grid->count, sizeof *changes);
    *values_out = sl_alloc_array(context, count, sizeof **values_out);
    const sl_status status = changes && *values_out ? SL_OK : SL_NO_MEMORY;
    for (size_t n = 0; status == SL_OK && n < change->count; n++) {
        const vga_pair *pair = &change->pairs[n];
        if (pair->before != UINT32_MAX) changes[pair->before] = change_of(change, measure, pair);
    }
    if (status == SL_OK) *out = heat_map_field(grid, changes, *values_out);
    out->diverging = true;
    sl_free(context, changes);
    return status;
}

// --- the summary

/// One of the three values of a measure, or gains alone: changes times `sign`.
typedef struct change_measure {
    const vga_change *change;
    size_t measure, which;
    int sign;
} change_measure;

static double value_at(const void *of, size_t index) {
    const change_measure *m = of;
    double values[VALUES];
    values_of(m->change, m->measure, &m->change->pairs[index], values);
    return values[m->which];
}

static double gain_at(const void *of, size_t index) {
    const change_measure *m = of;
    const double gain = m->sign * change_of(m->change, m->measure, &m->change->pairs[index]);
    return gain > 0 ? gain : NAN;
}

static double size_at(const void *of, size_t index) {
    return fabs(value_at(of, index));
}

/// The mean change in a line, and the largest one with its place.
static void print_change(const vga_change *c, size_t measure) {
    size_t best[SUMMARY_BEST];
    double mean, deviation;
    const change_measure of = {c, measure, 2, 1};
    if (!summary_mean(&(summary_values){value_at, &of, c->count}, &mean, &deviation)) return;
    summary_best(&(summary_values){size_at, &of, c->count}, best);
    const vga_pair *p = &c->pairs[best[0]];
    const double most = change_of(c, measure, p);
    const name_table names = measure_table(SL_VGA);
    const char *name = name_table_at(&names, measure);
    if (most == 0)
        printf("%s does not change\n", name);
    else
        printf("%s changes by %.6g on average, most by %.6g at %.10g,%.10g\n", name, mean, most,
               p->at.x, p->at.y);
}

/// The largest gains, or the largest losses with a sign of -1.
static void print_best(const vga_change *c, size_t measure, int sign) {
    const name_table names = measure_table(SL_VGA);
    size_t best[SUMMARY_BEST];
    const change_measure of = {c, measure, 0, sign};
    const size_t count = summary_best(&(summary_values){gain_at, &of, c->count}, best);
    if (count)
        printf("largest %s of %s:\n  %12s %12s %12s\n", sign > 0 ? "gains" : "losses",
               name_table_at(&names, measure), "x", "y", "change");
    for (size_t k = 0; k < count; k++) {
        const vga_pair *p = &c->pairs[best[k]];
        printf("  %12.10g %12.10g %12.6g\n", p->at.x, p->at.y, change_of(c, measure, p));
    }
}

void vga_change_print(const vga_change *change, size_t measure) {
    const name_table names = measure_table(SL_VGA);
    size_t both = 0, before = 0, after = 0;
    for (size_t n = 0; n < change->count; n++) {
        const vga_pair *p = &change->pairs[n];
        before += p->after == UINT32_MAX;
        after += p->before == UINT32_MAX;
        both += p->before != UINT32_MAX && p->after != UINT32_MAX;
    }
    printf("%zu point%s in both plans", both, both == 1 ? "" : "s");
    if (before) printf(", %zu in the first one only", before);
    if (after) printf(", %zu in the other one only", after);
    putchar('\n');
    print_change(change, measure);
    printf("  %-36s %12s %12s %12s %12s\n", "measure", "mean", "other", "change", "deviation");
    for (size_t k = 0; k < names.count; k++) {
        double mean[VALUES], deviation[VALUES];
        if (!vga_has(change->before, k)) continue;
        bool known = true;
        for (size_t i = 0; i < VALUES; i++) {
            const change_measure of = {change, k, i, 1};
            const summary_values values = {value_at, &of, change->count};
            known &= summary_mean(&values, &mean[i], &deviation[i]);
        }
        if (known)
            printf("  %-36s %12.6g %12.6g %12.6g %12.6g\n", name_table_at(&names, k), mean[0],
                   mean[1], mean[2], deviation[2]);
        else
            printf("  %-36s %12s\n", name_table_at(&names, k), "not defined");
    }
    print_best(change, measure, 1);
    print_best(change, measure, -1);
}
