/// The map text, written: map_text.c reads it.
///
/// Comments are printed with the first thing that has their line. Walls, doors and cells go by
/// kinds, so comments move along with theirs. The rest, whose statement is gone (as a wall that
/// cleaning joined with another), stands at the end.
#include "map/ground.h"
#include "map/scan.h"
#include "map/source.h"
#include "map/unit.h"
#include "sightline/support.h"

/// The writing of a map text. `done`: which of the map's comments are written.
typedef struct text_writer {
    sl_context *context;
    const sl_map *map;
    FILE *stream;
    bool *done;
    size_t walls;   ///< written so far
    uint32_t stops; ///< what those do that are being written
} text_writer;

/// The first comment that belongs to a line, or to one below.
static size_t find_comment(const sl_map *map, uint32_t line) {
    size_t low = 0, high = map->source.comment_count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (map->source.comments[middle].line < line)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// Among the first lines "#! " begins a note, which a comment must not become.
static void print_comment(FILE *stream, const char *text) {
    const bool like_note = strncmp(text, "#!", 2) == 0 && (text[2] == ' ' || !text[2]);
    fprintf(stream, "%s%s", like_note ? "# " : "", text + like_note);
}

/// Prints the comments of a line that are not written yet: those before it, or that behind it.
static void print_comments(text_writer *writer, uint32_t line, bool behind) {
    const sl_map *map = writer->map;
    for (size_t i = find_comment(map, line); i < map->source.comment_count; i++) {
        const sl_comment *comment = &map->source.comments[i];
        if (comment->line != line) return;
        if (comment->behind != behind || writer->done[i]) continue;
        writer->done[i] = true;
        if (behind) putc(' ', writer->stream);
        print_comment(writer->stream, comment->text);
        if (!behind) putc('\n', writer->stream);
    }
}

/// Begins a statement; things that are not from the file have line 0.
static void begin_statement(text_writer *writer, uint32_t line, const char *word) {
    if (line && writer->map->source.comment_count) print_comments(writer, line, false);
    fputs(word, writer->stream);
}

static void end_statement(text_writer *writer, uint32_t line) {
    if (writer->stops) {
        char stops[SL_STOPS_TEXT];
        sl_stops_write(writer->stops, stops);
        fprintf(writer->stream, " stops %s", stops);
    }
    if (line && writer->map->source.comment_count) print_comments(writer, line, true);
    putc('\n', writer->stream);
}

/// Prints the comments that are left, at the end.
static void print_rest(text_writer *writer) {
    const sl_map *map = writer->map;
    size_t strays = 0;
    for (size_t i = 0; i < map->source.comment_count; i++) {
        const sl_comment *comment = &map->source.comments[i];
        if (writer->done[i] || (!comment->text[0] && comment->line != UINT32_MAX)) continue;
        print_comment(writer->stream, comment->text);
        putc('\n', writer->stream);
        strays += comment->line != UINT32_MAX;
    }
    if (strays)
        sl_note(writer->context,
                "%zu comment%s at the end of the map text: what %s to is written in another form",
                strays, strays == 1 ? " stands" : "s stand",
                strays == 1 ? "it belongs" : "they belong");
}

static void print_number(FILE *stream, double value) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    fprintf(stream, " %s", text);
}

static void print_point(FILE *stream, sl_point point) {
    print_number(stream, point.x);
    print_number(stream, point.y);
}

static void print_ends(FILE *stream, sl_point a, sl_point b) {
    print_point(stream, a);
    print_point(stream, b);
}

static void print_notes(FILE *stream, const char *notes) {
    sli_lines lines = {.at = notes, .end = notes + strlen(notes), .ending = '\n'};
    for (sli_word line; sli_lines_next(&lines, &line);) {
        fprintf(stream, line.length ? "#! " : "#!");
        fwrite(line.at, 1, line.length, stream);
        fprintf(stream, "\n");
    }
}

/// All but walls.
static void print_others(text_writer *writer) {
    const sl_map *map = writer->map;
    FILE *stream = writer->stream;
    for (size_t i = 0; i < map->door_count; i++) {
        const sl_door *door = &map->doors[i];
        begin_statement(writer, door->line, "door ");
        fputs(door->name, stream);
        print_ends(stream, door->segment.a, door->segment.b);
        fputs(door->open ? " open" : " shut", stream);
        if (door->kind) fputs(door->kind == SL_DOOR_SITE ? " site" : " breakable", stream);
        end_statement(writer, door->line);
    }
    for (size_t i = 0; i < map->mirror_count; i++) {
        begin_statement(writer, map->mirrors[i].line, "mirror");
        print_ends(stream, map->mirrors[i].segment.a, map->mirrors[i].segment.b);
        fputs(map->mirrors[i].one_sided ? " one" : "", stream);
        end_statement(writer, map->mirrors[i].line);
    }
    for (size_t i = 0; i < map->oneway_count; i++) {
        begin_statement(writer, map->oneways[i].line, "oneway");
        print_ends(stream, map->oneways[i].segment.a, map->oneways[i].segment.b);
        end_statement(writer, map->oneways[i].line);
    }
    for (size_t i = 0; i < map->seam_count; i++) {
        if (map->seams[i].stops) continue;
        begin_statement(writer, map->seams[i].line, "seam");
        print_ends(stream, map->seams[i].segment.a, map->seams[i].segment.b);
        end_statement(writer, map->seams[i].line);
    }
    for (size_t i = 0; i < map->start_count; i++) {
        begin_statement(writer, map->starts[i].line, "start");
        print_point(stream, map->starts[i].at);
        print_number(stream, map->starts[i].heading);
        end_statement(writer, map->starts[i].line);
    }
    for (size_t i = 0; i < map->path_count; i++) {
        begin_statement(writer, map->paths[i].line, "path ");
        fputs(map->paths[i].name, stream);
        for (size_t k = 0; k < map->paths[i].count; k++)
            print_point(stream, map->paths[i].points[k]);
        end_statement(writer, map->paths[i].line);
    }
    for (size_t i = 0; i < map->object_count; i++) {
        begin_statement(writer, map->objects[i].line, "object ");
        fputs(map->objects[i].name, stream);
        print_ends(stream, map->objects[i].box.min, map->objects[i].box.max);
        end_statement(writer, map->objects[i].line);
    }
}

static void print_cells(text_writer *writer) {
    const sl_map *map = writer->map;
    if (map->snap > 0) {
        begin_statement(writer, map->snap_line, "snap");
        print_number(writer->stream, map->snap);
        end_statement(writer, map->snap_line);
    }
    for (size_t i = 0; i < map->cell_count; i++) {
        begin_statement(writer, map->cells[i].line, "cell");
        for (uint32_t k = 0; k < map->cells[i].count; k++)
            print_point(writer->stream, map->corners[map->cells[i].first + k]);
        end_statement(writer, map->cells[i].line);
    }
}

/// Asked at each wall or polygon, as a map may have very many.
static sl_status check_cancelled(text_writer *writer) {
    return ++writer->walls % 1024 ? SL_OK : sl_check_cancelled(writer->context);
}

static sl_status print_wall(text_writer *writer, sl_point from, sl_point to, const char *more,
                            uint32_t line) {
    begin_statement(writer, line, "wall");
    print_ends(writer->stream, from, to);
    fputs(more, writer->stream);
    end_statement(writer, line);
    return check_cancelled(writer);
}

static sl_status print_solid_wall(void *user, sl_point from, sl_point to, uint32_t line) {
    return print_wall(user, from, to, " solid", line);
}

static sl_status print_plain_wall(void *user, sl_point from, sl_point to, uint32_t line) {
    return print_wall(user, from, to, "", line);
}

/// Open ground in walls that do not stop all has no statement: its walls are written one by one.
static sl_status print_polygon(void *user, const sl_point *corners, size_t count, bool solid,
                               uint32_t line) {
    text_writer *writer = user;
    if (writer->stops && !solid) {
        for (size_t i = 0; i < count; i++)
            SL_TRY(print_solid_wall(user, corners[i], corners[(i + 1) % count], line));
        return SL_OK;
    }
    begin_statement(writer, line, solid ? "solid" : "open");
    for (size_t i = 0; i < count; i++) print_point(writer->stream, corners[i]);
    end_statement(writer, line);
    return check_cancelled(writer);
}

/// Walls without solid ground beside them; then solid ground, whose outline is wall.
static sl_status print_walls(text_writer *writer, const sl_wall *walls, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const sl_wall *wall = &walls[i];
        const bool solid = wall->ground & (SL_SOLID_LEFT | SL_SOLID_RIGHT);
        if (solid && !sli_ground_parts_rooms(wall->ground)) continue;
        SL_TRY(print_plain_wall(writer, wall->a, wall->b, wall->line));
    }
    const sli_loop_user plain = {.user = writer, .plain = print_plain_wall};
    const sli_loop_user user = {writer, print_polygon, print_solid_wall, NULL};
    SL_TRY(sli_ground_trace(writer->context, walls, count, &plain));
    return sli_ground_trace(writer->context, walls, count, &user);
}

/// Walls that do not stop all, by what they stop.
static sl_status print_partial_walls(text_writer *writer) {
    const sl_map *map = writer->map;
    size_t all = 0;
    for (size_t i = 0; i < map->seam_count; i++) all += map->seams[i].stops != 0;
    if (!all) return SL_OK;
    sl_wall *walls = sl_alloc_array(writer->context, all, sizeof *walls);
    sl_status status = walls ? SL_OK : SL_NO_MEMORY;
    for (uint32_t stops = 1; stops < 2 * SL_STOPS_LIMITED && status == SL_OK; stops++) {
        size_t count = 0;
        for (size_t i = 0; i < map->seam_count; i++) {
            const sl_glass *seam = &map->seams[i];
            if (seam->stops == stops)
                walls[count++] =
                    (sl_wall){seam->segment.a, seam->segment.b, seam->line, seam->ground};
        }
        writer->stops = stops;
        if (count) status = print_walls(writer, walls, count);
    }
    writer->stops = 0;
    sl_free(writer->context, walls);
    return status;
}

static sl_status print_map(text_writer *writer) {
    const sl_map *map = writer->map;
    print_comments(writer, 0, false);
    fputs("sightline 1", writer->stream);
    print_comments(writer, 0, true);
    putc('\n', writer->stream);
    if (map->source.notes) print_notes(writer->stream, map->source.notes);
    if (map->unit_line || sli_unit_metres(map->unit) > 0) {
        begin_statement(writer, map->unit_line, "unit ");
        fputs(map->unit, writer->stream);
        end_statement(writer, map->unit_line);
    }
    if (map->earth.known) {
        begin_statement(writer, map->earth_line, "earth");
        print_number(writer->stream, map->earth.longitude);
        print_number(writer->stream, map->earth.latitude);
        end_statement(writer, map->earth_line);
    }
    if (map->earth.epsg) {
        begin_statement(writer, map->earth_line, "crs ");
        fprintf(writer->stream, "EPSG:%u", (unsigned)map->earth.epsg);
        end_statement(writer, map->earth_line);
    }
    if (map->entrance > 0) {
        begin_statement(writer, map->entrance_line, "entrance");
        print_number(writer->stream, map->entrance);
        if (map->entrance_by_doors) fputs(" doors", writer->stream);
        end_statement(writer, map->entrance_line);
    }
    if (map->range > 0) {
        begin_statement(writer, map->range_line, "range");
        print_number(writer->stream, map->range);
        end_statement(writer, map->range_line);
    }
    if (map->precision > 0) {
        fputs("precision", writer->stream);
        print_number(writer->stream, map->precision);
        putc('\n', writer->stream);
    }
    SL_TRY(print_walls(writer, map->walls, map->wall_count));
    SL_TRY(print_partial_walls(writer));
    print_others(writer);
    print_cells(writer);
    print_rest(writer);
    return SL_OK;
}

sl_status sli_map_print_text(sl_context *context, const sl_map *map, FILE *stream) {
    text_writer writer = {.context = context, .map = map, .stream = stream};
    writer.done = sl_alloc_array(context, map->source.comment_count, sizeof *writer.done);
    if (!writer.done) return SL_NO_MEMORY;
    const sl_status status = print_map(&writer);
    sl_free(context, writer.done);
    return status;
}
