/// The export of a baked file as a C header, for programs that read no file when they run.
///
/// The header holds constant tables and needs nothing but a compiler (C99 or later, or C++). Each
/// name in it begins with a prefix, so that a program can hold several maps. A table that would be
/// empty has one entry of zeros, as C knows no empty arrays; the counts say how many entries there
/// are.
#include "bake/export.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <string.h>

typedef struct printer {
    sl_context *context;
    const sl_baked *baked;
    FILE *stream;
    const char *name;               ///< what names begin with
    char upper[SL_PREFIX_MOST + 1]; ///< the same in capitals, for macros
    uint32_t *doors;                ///< by door of the map: its number among the different names
    uint32_t door_count;            ///< of different names
} printer;

// --- names and values

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Names that begin with '_' belong to compilers.
static sl_status check_prefix(sl_context *context, const char *prefix) {
    bool fits = is_letter(*prefix);
    for (const char *at = prefix; *at; at++)
        fits = fits && (is_letter(*at) || (*at >= '0' && *at <= '9') || *at == '_');
    if (fits && strlen(prefix) <= SL_PREFIX_MOST) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "prefix '%s': expected a C identifier: a letter, then letters, digits or '_', "
                   "up to %d in all",
                   prefix, SL_PREFIX_MOST);
}

static void set_upper(printer *out) {
    size_t i = 0;
    for (; out->name[i]; i++) {
        const char c = out->name[i];
        out->upper[i] = c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
    }
    out->upper[i] = '\0';
}

/// A number that C reads as a double, whatever its size.
static void put_real(const printer *out, double value) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    fputs(text, out->stream);
    if (!strpbrk(text, ".e")) fputs(".0", out->stream);
}

static void put_pair(const printer *out, sl_point p) {
    fputs("{", out->stream);
    put_real(out, p.x);
    fputs(", ", out->stream);
    put_real(out, p.y);
    fputs("}", out->stream);
}

/// A C string of any bytes: what is not plain is written as an octal escape of three digits.
static void put_text(const printer *out, const char *text) {
    fputs("\"", out->stream);
    for (; *text; text++) {
        const bool plain = is_letter(*text) || (*text >= '0' && *text <= '9') ||
                           (*text && strchr("_-.:+ ", *text));
        if (plain)
            putc(*text, out->stream);
        else
            fprintf(out->stream, "\\%03o", (unsigned)(unsigned char)*text);
    }
    fputs("\"", out->stream);
}

// --- doors: those of one name are one door

static sl_status number_doors(printer *out) {
    const sl_map *map = &out->baked->map;
    out->doors = sl_alloc_array(out->context, map->door_count, sizeof *out->doors);
    if (!out->doors) return SL_NO_MEMORY;
    for (size_t i = 0; i < map->door_count; i++) {
        size_t same = 0;
        while (strcmp(map->doors[same].name, map->doors[i].name) != 0) same++;
        out->doors[i] = same < i ? out->doors[same] : out->door_count++;
    }
    return SL_OK;
}

// --- the comment, counts and types

static void put_comment(const printer *out) {
    const sl_visibility *seen = &out->baked->visibility;
    const char *p = out->name, *u = out->upper;
    fprintf(out->stream,
            "/* A map by Sightline: cells, portals, doors, starts, and which cells see which.\n"
            " *\n"
            " *   %s_corners[i]   x, y: the corners of all cells\n"
            " *   %s_cells[i]     a convex polygon, counter-clockwise: the corners\n"
            " *       `first` .. `first + count - 1`; whether it is inside the building, and\n"
            " *       whether it is solid ground\n"
            " *   %s_portals[i]   an opening between cells `from` and `to`; its left and right\n"
            " *       end for a viewer who goes from `from` to `to`; `door`: the number of its\n"
            " *       door, -1 for none; `oneway`: 0: sight goes both ways, 1: from `from` to\n"
            " *       `to` only, 2: from `to` to `from` only, 3: neither way\n"
            " *   %s_doors[i]     a name, and whether the door is open when the map begins\n"
            " *   %s_starts[i]    a viewpoint; its heading in degrees, counter-clockwise from +x\n"
            " *   %s_seen[a][]    a bit for each cell that cell a sees: use %s_SEES(a, b)\n"
            " *   %s_bounds       min x, min y, max x, max y\n"
            " *\n"
            " * A table that has no entries holds one of zeros: trust the counts. Coordinates are\n"
            " * in the unit of the map, with y up. Visible sets: %s, %s sight, all doors open.",
            p, p, p, p, p, p, u, p, sl_guarantee_name(seen->guarantee),
            seen->sight == SL_CLOSED ? "closed" : "open");
    if (sl_partial_begun(&out->baked->partial))
        fputs("\n * The bake was stopped: pairs that are not decided count as seen.", out->stream);
    fputs(" */\n", out->stream);
}

static void put_counts(const printer *out) {
    const sl_space *space = &out->baked->space;
    const struct {
        const char *name;
        size_t count;
    } counts[] = {{"CELLS", space->cell_count},
                  {"CORNERS", space->vertex_count},
                  {"PORTALS", space->portal_count},
                  {"DOORS", out->door_count},
                  {"STARTS", out->baked->map.start_count}};
    fprintf(out->stream, "#ifndef SIGHTLINE_%s_H\n#define SIGHTLINE_%s_H\n\n", out->name,
            out->name);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        fprintf(out->stream, "#define %s_%s %zu\n", out->upper, counts[i].name, counts[i].count);
}

static void put_types(const printer *out) {
    const char *p = out->name;
    fprintf(out->stream,
            "\nstruct %s_cell {\n"
            "    int first, count;\n"
            "    unsigned char inside, solid;\n"
            "};\n"
            "struct %s_portal {\n"
            "    int from, to;\n"
            "    double left[2], right[2];\n"
            "    int door, oneway;\n"
            "};\n"
            "struct %s_door {\n"
            "    const char *name;\n"
            "    int open;\n"
            "};\n"
            "struct %s_start {\n"
            "    double at[2], heading;\n"
            "};\n",
            p, p, p, p);
}

// --- tables

/// `type`: the name of a type of the header ("cell"), or NULL for numbers of the type `numbers`.
static void begin_table(const printer *out, const char *type, const char *numbers, const char *name,
                        size_t count, const char *width) {
    fprintf(out->stream, "\n%s_TABLE ", out->upper);
    if (type)
        fprintf(out->stream, "struct %s_%s", out->name, type);
    else
        fputs(numbers, out->stream);
    fprintf(out->stream, " %s_%s[%zu]%s = {\n", out->name, name, count ? count : 1, width);
}

static void end_table(const printer *out, size_t count, const char *zeros) {
    fprintf(out->stream, "%s};\n", count ? "" : zeros);
}

static void put_cells(const printer *out) {
    const sl_space *space = &out->baked->space;
    begin_table(out, NULL, "double", "corners", space->vertex_count, "[2]");
    for (uint32_t i = 0; i < space->vertex_count && !ferror(out->stream); i++) {
        fputs("    ", out->stream);
        put_pair(out, space->vertices[i]);
        fputs(",\n", out->stream);
    }
    end_table(out, space->vertex_count, "    {0.0, 0.0}\n");
    begin_table(out, "cell", NULL, "cells", space->cell_count, "");
    for (uint32_t i = 0; i < space->cell_count && !ferror(out->stream); i++) {
        const sl_cell *cell = &space->cells[i];
        fprintf(out->stream, "    {%" PRIu32 ", %" PRIu32 ", %d, %d},\n", cell->first_vertex,
                cell->vertex_count, cell->inside != 0, cell->solid != 0);
    }
    end_table(out, space->cell_count, "    {0, 0, 0, 0}\n");
}

static void put_portals(const printer *out) {
    const sl_space *space = &out->baked->space;
    begin_table(out, "portal", NULL, "portals", space->portal_count, "");
    for (uint32_t i = 0; i < space->portal_count && !ferror(out->stream); i++) {
        const sl_portal *portal = &space->portals[i];
        const sl_door *door = sli_portal_door(out->baked, i);
        fprintf(out->stream, "    {%" PRIu32 ", %" PRIu32 ", ", portal->cell[0], portal->cell[1]);
        put_pair(out, portal->left);
        fputs(", ", out->stream);
        put_pair(out, portal->right);
        fprintf(out->stream, ", %" PRId64 ", %d},\n",
                door ? (int64_t)out->doors[door - out->baked->map.doors] : -1,
                (int)sli_portal_glass(space, i));
    }
    end_table(out, space->portal_count, "    {0, 0, {0.0, 0.0}, {0.0, 0.0}, -1, 0}\n");
}

/// A door is open if all doors of its name are.
static void put_doors(const printer *out) {
    const sl_map *map = &out->baked->map;
    uint32_t next = 0;
    begin_table(out, "door", NULL, "doors", out->door_count, "");
    for (size_t i = 0; i < map->door_count; i++) {
        if (out->doors[i] != next) continue;
        bool open = true;
        for (size_t k = i; k < map->door_count; k++)
            if (out->doors[k] == next) open = open && map->doors[k].open;
        fputs("    {", out->stream);
        put_text(out, map->doors[i].name);
        fprintf(out->stream, ", %d},\n", open);
        next++;
    }
    end_table(out, out->door_count, "    {\"\", 0}\n");
}

static void put_starts(const printer *out) {
    const sl_map *map = &out->baked->map;
    begin_table(out, "start", NULL, "starts", map->start_count, "");
    for (size_t i = 0; i < map->start_count; i++) {
        fputs("    {", out->stream);
        put_pair(out, map->starts[i].at);
        fputs(", ", out->stream);
        put_real(out, map->starts[i].heading);
        fputs("},\n", out->stream);
    }
    end_table(out, map->start_count, "    {{0.0, 0.0}, 0.0}\n");
}

// --- visible sets

/// The bits of a row, lowest first in each byte.
static void fill_row(const sl_pvs *pvs, uint32_t cell, uint8_t *row, size_t bytes) {
    memset(row, 0, bytes);
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++) row[i / 8] |= (uint8_t)(1u << i % 8);
}

static sl_status put_rows(const printer *out, const sl_pvs *pvs, const char *name, uint8_t *row,
                          size_t bytes) {
    char width[32];
    snprintf(width, sizeof width, "[%zu]", bytes);
    begin_table(out, NULL, "unsigned char", name, pvs->cell_count, width);
    for (uint32_t cell = 0; cell < pvs->cell_count && !ferror(out->stream); cell++) {
        SL_TRY(sl_check_cancelled(out->context));
        fill_row(pvs, cell, row, bytes);
        fputs("    {", out->stream);
        for (size_t i = 0; i < bytes; i++) fprintf(out->stream, i ? ",%u" : "%u", row[i]);
        fputs("},\n", out->stream);
        sl_report(out->context, "export", "cells", cell + 1, pvs->cell_count);
    }
    end_table(out, pvs->cell_count, "    {0}\n");
    return SL_OK;
}

static bool has_mirrors(const printer *out) {
    return out->baked->visibility.mirrored.cell_count > 0;
}

static sl_status put_seen(const printer *out) {
    const sl_visibility *seen = &out->baked->visibility;
    const size_t bytes = ((size_t)seen->pvs.cell_count + 7) / 8;
    uint8_t *row = sl_alloc_array(out->context, bytes, 1);
    if (!row) return SL_NO_MEMORY;
    sl_status status = put_rows(out, &seen->pvs, "seen", row, bytes);
    if (status == SL_OK && has_mirrors(out))
        status = put_rows(out, &seen->mirrored, "mirrored", row, bytes);
    sl_free(out->context, row);
    return status;
}

/// Only for maps with mirrors: where they stand, and what they show.
static void put_mirrors(const printer *out) {
    const sl_map *map = &out->baked->map;
    const char *p = out->name, *u = out->upper;
    fprintf(
        out->stream,
        "\n/* %s_mirrors[i]: a mirror; whether it reflects on its left only, from its first end\n"
        " * to its second. Cell b is seen from cell a by mirror where %s_SEES_MIRRORED is not 0:\n"
        " * a bit of %s_mirrored[a][]. */\n"
        "#define %s_MIRRORS %zu\n"
        "#define %s_SEES_MIRRORED(a, b) (%s_mirrored[a][(b) / 8] >> (b) %% 8 & 1)\n"
        "struct %s_mirror {\n"
        "    double from[2], to[2];\n"
        "    int one_sided;\n"
        "};\n",
        p, u, p, u, map->mirror_count, u, p, p);
    begin_table(out, "mirror", NULL, "mirrors", map->mirror_count, "");
    for (size_t i = 0; i < map->mirror_count; i++) {
        fputs("    {", out->stream);
        put_pair(out, map->mirrors[i].segment.a);
        fputs(", ", out->stream);
        put_pair(out, map->mirrors[i].segment.b);
        fprintf(out->stream, ", %d},\n", map->mirrors[i].one_sided);
    }
    end_table(out, map->mirror_count, "    {{0.0, 0.0}, {0.0, 0.0}, 0}\n");
}

static sl_status put_all(const printer *out) {
    const sl_box *b = &out->baked->space.bounds;
    const double ends[4] = {b->min.x, b->min.y, b->max.x, b->max.y};
    put_comment(out);
    put_counts(out);
    fprintf(out->stream,
            "\n/* Programs need not use all tables. */\n"
            "#if defined(__GNUC__)\n"
            "#define %s_TABLE static const __attribute__((unused))\n"
            "#else\n"
            "#define %s_TABLE static const\n"
            "#endif\n",
            out->upper, out->upper);
    fprintf(out->stream,
            "\n/* Cell b is seen from cell a where this is not 0. */\n"
            "#define %s_SEES(a, b) (%s_seen[a][(b) / 8] >> (b) %% 8 & 1)\n",
            out->upper, out->name);
    if (strcmp(out->name, SL_PREFIX_DEFAULT) == 0) // as the macro was called before
        fputs("#define VISIBLE(a, b) VISIBLE_SEES(a, b)\n", out->stream);
    put_types(out);
    fprintf(out->stream, "\n%s_TABLE double %s_bounds[4] = {", out->upper, out->name);
    for (int i = 0; i < 4; i++) {
        if (i) fputs(", ", out->stream);
        put_real(out, ends[i]);
    }
    fputs("};\n", out->stream);
    put_cells(out);
    put_portals(out);
    put_doors(out);
    put_starts(out);
    if (has_mirrors(out)) put_mirrors(out);
    SL_TRY(put_seen(out));
    fputs("\n#endif\n", out->stream);
    return SL_OK;
}

sl_status sli_export_c(sl_context *context, const sl_baked *baked, const sl_export_options *options,
                       const char *path) {
    printer out = {.context = context,
                   .baked = baked,
                   .name = options->prefix ? options->prefix : SL_PREFIX_DEFAULT};
    SL_TRY(check_prefix(context, out.name));
    set_upper(&out);
    SL_TRY(number_doors(&out));
    sl_output output;
    sl_status status = sl_output_open(context, path, &output);
    out.stream = output.stream;
    if (status == SL_OK) status = sl_output_close(context, &output, put_all(&out));
    sl_free(context, out.doors);
    return status;
}
