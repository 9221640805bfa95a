/// Fog of war: what an eye sees of a level, drawn as SVG by the runtime header alone.
/* Fog of war in C: what an eye sees of a baked level, with doors opened and shut by name.
 *
 *     cc fog.c -I.. -o fog
 *     ./fog LEVEL.slv PICTURE.svg X Y [open NAME | shut NAME]...
 *
 * Other doors are as the map has them. It prints the eye's cell, the cells that its row sees past
 * the doors, the cells that the eye sees, and the corners of the polygon that it sees. The picture
 * has fog in grey, the polygon in yellow, shut doors in red and open ones in green.
 * fog.py and fog.mjs do the same with the JSON export. */
#include <stdio.h>
#include <stdlib.h>

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "sightline_runtime.h"

static void fail(const char *what, const char *name) {
    fprintf(stderr, "fog: %s: %s\n", name, what);
    exit(2);
}

static void *room(size_t bytes) {
    void *block = malloc(bytes ? bytes : 1);
    if (!block) fail("out of memory", "level");
    return block;
}

static void *read_file(const char *name, size_t *size) {
    FILE *file = fopen(name, "rb");
    if (!file || fseek(file, 0, SEEK_END) != 0) fail("cannot be read", name);
    *size = (size_t)ftell(file);
    rewind(file);
    void *bytes = room(*size);
    if (fread(bytes, 1, *size, file) != *size) fail("cannot be read", name);
    fclose(file);
    return bytes;
}

/* Opens or shuts all doors of a name. */
static void set_door(const sl_runtime *level, unsigned char *shut, const char *name, bool open) {
    uint32_t door = sl_runtime_find_door(level, name);
    if (door == SL_RUNTIME_NO_DOOR) fail("there is no such door", name);
    for (; door < level->door_count; door++) {
        const sl_runtime_name is = sl_runtime_door_name(level, door);
        if (is.length == strlen(name) && memcmp(is.text, name, is.length) == 0) shut[door] = !open;
    }
}

static double number(const char *text) {
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end) fail("is not a number", text);
    return value;
}

static int by_number(const void *a, const void *b) {
    const uint32_t u = *(const uint32_t *)a, v = *(const uint32_t *)b;
    return (u > v) - (u < v);
}

/* SVG counts y downwards. */
static void draw_polygon(FILE *out, const double *points, uint32_t count, const char *style) {
    fputs("<polygon points='", out);
    for (uint32_t i = 0; i < count; i++)
        fprintf(out, "%.9g,%.9g ", points[2 * i], -points[2 * i + 1]);
    fprintf(out, "' %s/>\n", style);
}

static void draw_line(FILE *out, double x0, double y0, double x1, double y1, const char *colour) {
    fprintf(out, "<line x1='%.9g' y1='%.9g' x2='%.9g' y2='%.9g' stroke='%s'/>\n", x0, -y0, x1, -y1,
            colour);
}

static void draw_cells(FILE *out, const sl_runtime *level) {
    for (uint32_t i = 0; i < level->cell_count; i++) {
        const sl_runtime_cell cell = sl_runtime_get_cell(level, i);
        double *corners = room(2 * cell.vertex_count * sizeof *corners);
        for (uint32_t k = 0; k < cell.vertex_count; k++)
            sl_runtime_get_vertex(level, cell.first_vertex + k, &corners[2 * k],
                                  &corners[2 * k + 1]);
        draw_polygon(out, corners, cell.vertex_count,
                     sl_runtime_is_solid(level, i) ? "fill='#000'" : "fill='#777' stroke='#000'");
        free(corners);
    }
    for (uint32_t i = 0; i < level->directed_count; i++) {
        const sl_runtime_directed_portal p = sl_runtime_get_directed_portal(level, i);
        draw_line(out, p.left[0], p.left[1], p.right[0], p.right[1], "#777");
    }
}

static void draw_doors(FILE *out, const sl_runtime *level, const unsigned char *shut) {
    for (uint32_t i = 0; i < level->door_count; i++) {
        const uint32_t count = sl_runtime_door_segments(level, i, NULL, 0);
        sl_runtime_segment *at = room(count * sizeof *at);
        sl_runtime_door_segments(level, i, at, count);
        for (uint32_t k = 0; k < count; k++)
            draw_line(out, at[k].x0, at[k].y0, at[k].x1, at[k].y1, shut[i] ? "red" : "green");
        free(at);
    }
}

static void draw(const char *name, const sl_runtime *level, const unsigned char *shut, double x,
                 double y, const double *points, uint32_t count) {
    const double width = level->max_x - level->min_x, height = level->max_y - level->min_y;
    FILE *out = fopen(name, "w");
    if (!out) fail("cannot be written", name);
    fprintf(out,
            "<svg xmlns='http://www.w3.org/2000/svg' viewBox='%.9g %.9g %.9g %.9g' "
            "stroke-width='%.9g'>\n",
            level->min_x, -level->max_y, width, height, width / 300);
    draw_cells(out, level);
    draw_polygon(out, points, count, "fill='#fe9'");
    draw_doors(out, level, shut);
    fprintf(out, "<circle cx='%.9g' cy='%.9g' r='%.9g'/>\n</svg>\n", x, -y, width / 150);
    if (fclose(out) != 0) fail("cannot be written", name);
}

int main(int argc, char **argv) {
    if (argc < 5 || argc % 2 == 0)
        fail("LEVEL.slv PICTURE.svg X Y [open NAME | shut NAME]...", "usage");
    size_t size;
    void *bytes = read_file(argv[1], &size);
    sl_runtime level;
    const sl_runtime_status status = sl_runtime_open(bytes, size, &level);
    if (status != SL_RUNTIME_OK) fail(sl_runtime_status_text(status), argv[1]);
    if (level.mirrors) fputs("note: mirrors are walls here\n", stderr);

    const double x = number(argv[3]), y = number(argv[4]);
    unsigned char *shut = room(level.door_count);
    for (uint32_t i = 0; i < level.door_count; i++) shut[i] = !sl_runtime_door_open(&level, i);
    for (int i = 5; i < argc; i += 2) {
        if (strcmp(argv[i], "open") != 0 && strcmp(argv[i], "shut") != 0)
            fail("is neither open nor shut", argv[i]);
        set_door(&level, shut, argv[i + 1], argv[i][0] == 'o');
    }

    const uint32_t cell = sl_runtime_locate(&level, x, y);
    if (cell == SL_RUNTIME_NO_CELL) fail("the eye is outside", argv[1]);
    printf("cell %u\nrow", (unsigned)cell);
    for (uint32_t i = 0; i < level.cell_count; i++)
        if (sl_runtime_can_see_past(&level, cell, i, shut)) printf(" %u", (unsigned)i);

    const sl_runtime_view view = sl_runtime_view_all_round(x, y);
    uint32_t *scratch = room(sl_runtime_scratch_count(&level) * sizeof *scratch);
    uint32_t *cells = room(level.cell_count * sizeof *cells);
    const uint32_t seen =
        sl_runtime_look_past(&level, &view, shut, 0, scratch, cells, level.cell_count);
    qsort(cells, seen, sizeof *cells, by_number);
    printf("\nseen");
    for (uint32_t i = 0; i < seen; i++) printf(" %u", (unsigned)cells[i]);

    /* Ask for the number of points first, then for the points. */
    const uint32_t count = sl_runtime_visible_polygon(&level, &view, shut, 0, scratch, NULL, 0);
    double *points = room(2 * count * sizeof *points);
    sl_runtime_visible_polygon(&level, &view, shut, 0, scratch, points, count);
    printf("\npoints %u\n", (unsigned)count);
    for (uint32_t i = 0; i < count; i++) printf("%.17g %.17g\n", points[2 * i], points[2 * i + 1]);
    draw(argv[2], &level, shut, x, y, points, count);

    free(points);
    free(cells);
    free(scratch);
    free(shut);
    free(bytes);
    return 0;
}
