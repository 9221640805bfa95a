/// Writing maps of virtual tabletops: Universal VTT, and scenes of Foundry.
///
/// Both have walls and doors, in JSON with y down. What they have no words for stands in members of
/// ours, which other programs pass over: "sightline" in a Universal VTT file, "flags.sightline" in
/// a scene, where Foundry keeps what modules add. They say which y is 0 in the map, the names of
/// doors, and the sum of all digits, by which the reader sees that nobody has edited the numbers.
/// In a scene, walls also say whether they are mirrors or seams, and starts are friendly tokens.
#include "io/io_formats.h"
#include "io/parts/layers.h"
#include "sightline/io.h"
#include "sightline/json.h"

#include <inttypes.h>
#include <math.h>

typedef struct tabletop_writer {
    sl_context *context;
    const sl_map *map;
    sl_json_writer json;
    double top;
    double pixels; ///< of a scene in a unit of the map
    uint64_t sum;
    size_t written; ///< walls, doors and glass
    size_t between; ///< of these, with ends between pixels
    size_t rounded; ///< starts that do not read back exactly
} tabletop_writer;

static void put_real(tabletop_writer *writer, const char *key, double value) {
    sl_json_put_key(&writer->json, key);
    sl_json_put_real(&writer->json, value + 0.0);
}

/// A coordinate that the reader counts.
static void put_place(tabletop_writer *writer, double value) {
    writer->sum += sli_digits_of_number(value);
    sl_json_put_real(&writer->json, value + 0.0);
}

static void put_text(tabletop_writer *writer, const char *key, const char *text) {
    sl_json_put_key(&writer->json, key);
    sl_json_put_text(&writer->json, text);
}

static void put_flag(tabletop_writer *writer, const char *key, bool flag) {
    sl_json_put_key(&writer->json, key);
    sl_json_put_flag(&writer->json, flag);
}

static void put_whole(tabletop_writer *writer, const char *key, int64_t number) {
    sl_json_put_key(&writer->json, key);
    sl_json_put_integer(&writer->json, number);
}

static sl_status check_cancelled(tabletop_writer *writer) {
    return ++writer->written % 1024 ? SL_OK : sl_check_cancelled(writer->context);
}

static void begin_json_part(tabletop_writer *writer, const char *key, char bracket) {
    if (key) sl_json_put_key(&writer->json, key);
    if (bracket == '{')
        sl_json_put_object(&writer->json);
    else
        sl_json_put_list(&writer->json);
}

static void end_json_part(tabletop_writer *writer, char bracket) {
    sl_json_put_end(&writer->json, bracket);
}

/// What both files say of the whole map.
static void put_marks(tabletop_writer *writer) {
    char mark[SLI_MARK_TEXT];
    put_real(writer, "y0", writer->top);
    if (writer->map->range > 0) put_real(writer, "range", writer->map->range);
    sli_write_mark(writer->map, writer->sum, mark);
    put_text(writer, "digits", mark);
}

// --- Universal VTT

static void put_point(tabletop_writer *writer, const char *key, sl_point point, bool counts) {
    const double y = sli_turned_y(writer->top, point.y);
    begin_json_part(writer, key, '{');
    sl_json_put_key(&writer->json, "x");
    if (counts)
        put_place(writer, point.x);
    else
        sl_json_put_real(&writer->json, point.x + 0.0);
    sl_json_put_key(&writer->json, "y");
    if (counts)
        put_place(writer, y);
    else
        sl_json_put_real(&writer->json, y);
    end_json_part(writer, '}');
}

static void put_ends(tabletop_writer *writer, const char *key, sl_point a, sl_point b) {
    begin_json_part(writer, key, '[');
    put_point(writer, NULL, a, true);
    put_point(writer, NULL, b, true);
    end_json_part(writer, ']');
}

static void put_resolution(tabletop_writer *writer) {
    const sl_box page = sli_page_of(writer->map);
    const double sizes[2] = {page.max.x - page.min.x, page.max.y - page.min.y};
    begin_json_part(writer, "resolution", '{');
    put_point(writer, "map_origin", (sl_point){page.min.x, page.max.y}, false);
    begin_json_part(writer, "map_size", '{');
    put_real(writer, "x", sizes[0]);
    put_real(writer, "y", sizes[1]);
    end_json_part(writer, '}');
    const double pixels = rint(writer->map->source.pixels);
    put_whole(writer, "pixels_per_grid", pixels > 1 && pixels <= 65536 ? (int64_t)pixels : 64);
    end_json_part(writer, '}');
}

static sl_status put_lines(tabletop_writer *writer) {
    const sl_map *map = writer->map;
    begin_json_part(writer, "line_of_sight", '[');
    for (size_t i = 0; i < map->wall_count; i++) {
        put_ends(writer, NULL, map->walls[i].a, map->walls[i].b);
        SL_TRY(check_cancelled(writer));
    }
    for (size_t i = 0; i < map->mirror_count; i++)
        put_ends(writer, NULL, map->mirrors[i].segment.a, map->mirrors[i].segment.b);
    end_json_part(writer, ']');
    begin_json_part(writer, "objects_line_of_sight", '[');
    end_json_part(writer, ']');
    return SL_OK;
}

static sl_status put_portals(tabletop_writer *writer) {
    const sl_map *map = writer->map;
    begin_json_part(writer, "portals", '[');
    for (size_t i = 0; i < map->door_count; i++) {
        const sl_door *door = &map->doors[i];
        const sl_segment at = door->segment;
        const sl_point middle = {at.a.x / 2 + at.b.x / 2, at.a.y / 2 + at.b.y / 2};
        begin_json_part(writer, NULL, '{');
        put_point(writer, "position", middle, false);
        put_ends(writer, "bounds", at.a, at.b);
        put_real(writer, "rotation", atan2(at.a.y - at.b.y, at.b.x - at.a.x));
        put_flag(writer, "closed", !door->open);
        put_flag(writer, "freestanding", false);
        begin_json_part(writer, "sightline", '{');
        put_text(writer, "name", door->name);
        end_json_part(writer, '}');
        end_json_part(writer, '}');
        SL_TRY(check_cancelled(writer));
    }
    end_json_part(writer, ']');
    return SL_OK;
}

static void put_starts(tabletop_writer *writer) {
    const sl_map *map = writer->map;
    begin_json_part(writer, "starts", '[');
    for (size_t i = 0; i < map->start_count; i++) {
        begin_json_part(writer, NULL, '{');
        put_point(writer, "at", map->starts[i].at, true);
        put_real(writer, "heading", map->starts[i].heading);
        end_json_part(writer, '}');
    }
    end_json_part(writer, ']');
}

static tabletop_writer writer_of(sl_context *context, const sl_map *map, FILE *stream) {
    return (tabletop_writer){.context = context,
                             .map = map,
                             .json = sl_json_writer_to(stream, 1),
                             .top = sli_choose_top(map)};
}

sl_status sli_map_print_uvtt(sl_context *context, const sl_map *map, FILE *stream) {
    /// A white pixel, as PNG: programs that show such files need a picture.
    static const char picture[] =
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP4DwABAQEA"
        "sTj2FAAAAABJRU5ErkJggg==";
    tabletop_writer writer = writer_of(context, map, stream);
    begin_json_part(&writer, NULL, '{');
    sl_json_put_key(&writer.json, "format");
    sl_json_put_written(&writer.json, "0.3", 3);
    put_resolution(&writer);
    SL_TRY(put_lines(&writer));
    SL_TRY(put_portals(&writer));
    begin_json_part(&writer, "environment", '{');
    put_flag(&writer, "baked_lighting", false);
    put_text(&writer, "ambient_light", "ffffffff");
    end_json_part(&writer, '}');
    begin_json_part(&writer, "lights", '[');
    end_json_part(&writer, ']');
    begin_json_part(&writer, "sightline", '{');
    put_starts(&writer);
    put_marks(&writer);
    end_json_part(&writer, '}');
    put_text(&writer, "image", picture);
    end_json_part(&writer, '}');
    putc('\n', stream);
    sl_note(context, "the Universal VTT file has a blank picture of one pixel");
    return SL_OK;
}

// --- Foundry

enum { SIGHT_NONE = 0, SIGHT_LIMITED = 10, SIGHT_NORMAL = 20, LEFT_ONLY = 1, DOOR_PLAIN = 1 };
/// Pixels in a unit of the map, a power of two, so that nothing is rounded: as many as the file had
/// that the map is from; else so many that the scene is 1024 pixels wide or high at least. Foundry
/// itself keeps whole pixels.
static double pixels_of(const sl_map *map) {
    const sl_box page = sli_page_of(map);
    const double size = fmax(page.max.x - page.min.x, page.max.y - page.min.y);
    double pixels = 1;
    while (pixels < 65536 &&
           (map->source.pixels > 0 ? pixels * 1.5 < map->source.pixels : pixels * size < 1024))
        pixels *= 2;
    return pixels;
}

/// The side of a square of the scene's grid, in pixels: a unit of the map, or where that is too
/// small for Foundry the usual size.
static double square_of(double pixels) {
    return pixels < 64 ? 128 : pixels;
}

/// What is special about a wall; zeroed for a plain one.
typedef struct foundry_wall {
    const sl_door *door;
    bool oneway, seam;
    uint32_t stops; ///< of a wall that does not stop all; else 0
    const char *mirror;
} foundry_wall;

static void put_wall_flags(tabletop_writer *writer, const foundry_wall *wall) {
    if (!wall->door && !wall->seam && !wall->mirror) return;
    begin_json_part(writer, "flags", '{');
    begin_json_part(writer, "sightline", '{');
    if (wall->door) put_text(writer, "name", wall->door->name);
    if (wall->seam) put_flag(writer, "seam", true);
    if (wall->mirror) put_text(writer, "mirror", wall->mirror);
    end_json_part(writer, '}');
    end_json_part(writer, '}');
}

static void put_id(tabletop_writer *writer, const char *kind, size_t number) {
    char id[32];
    snprintf(id, sizeof id, "%s%011" PRIu64, kind, (uint64_t)number % 100000000000u);
    put_text(writer, "_id", id);
}

static sl_status put_wall(tabletop_writer *writer, sl_point a, sl_point b, foundry_wall wall) {
    const double y[2] = {sli_turned_y(writer->top, a.y), sli_turned_y(writer->top, b.y)};
    const double c[4] = {a.x * writer->pixels, y[0] * writer->pixels, b.x * writer->pixels,
                         y[1] * writer->pixels};
    const uint32_t stops = wall.seam ? 0 : wall.stops ? wall.stops : SL_STOPS_ALL;
    const int64_t sight = stops & SL_STOPS_SIGHT     ? SIGHT_NORMAL
                          : stops & SL_STOPS_LIMITED ? SIGHT_LIMITED
                                                     : SIGHT_NONE;
    bool whole = true;
    begin_json_part(writer, NULL, '{');
    put_id(writer, "wall0", writer->written);
    begin_json_part(writer, "c", '[');
    for (int i = 0; i < 4; i++) {
        put_place(writer, c[i]);
        whole &= c[i] == rint(c[i]);
    }
    end_json_part(writer, ']');
    put_whole(writer, "light", sight);
    put_whole(writer, "move", stops & SL_STOPS_STEPS ? SIGHT_NORMAL : SIGHT_NONE);
    put_whole(writer, "sight", sight);
    put_whole(writer, "sound", stops & SL_STOPS_SOUND ? SIGHT_NORMAL : SIGHT_NONE);
    put_whole(writer, "dir", wall.oneway ? LEFT_ONLY : 0);
    put_whole(writer, "door", wall.door ? DOOR_PLAIN : 0);
    put_whole(writer, "ds", wall.door && wall.door->open);
    put_wall_flags(writer, &wall);
    end_json_part(writer, '}');
    writer->between += !whole;
    return check_cancelled(writer);
}

static sl_status put_walls(tabletop_writer *writer) {
    const sl_map *map = writer->map;
    begin_json_part(writer, "walls", '[');
    for (size_t i = 0; i < map->wall_count; i++)
        SL_TRY(put_wall(writer, map->walls[i].a, map->walls[i].b, (foundry_wall){0}));
    for (size_t i = 0; i < map->door_count; i++)
        SL_TRY(put_wall(writer, map->doors[i].segment.a, map->doors[i].segment.b,
                        (foundry_wall){.door = &map->doors[i]}));
    for (size_t i = 0; i < map->mirror_count; i++)
        SL_TRY(put_wall(writer, map->mirrors[i].segment.a, map->mirrors[i].segment.b,
                        (foundry_wall){.mirror = map->mirrors[i].one_sided ? "one" : "both"}));
    for (size_t i = 0; i < map->oneway_count; i++)
        SL_TRY(put_wall(writer, map->oneways[i].segment.a, map->oneways[i].segment.b,
                        (foundry_wall){.oneway = true}));
    for (size_t i = 0; i < map->seam_count; i++)
        SL_TRY(
            put_wall(writer, map->seams[i].segment.a, map->seams[i].segment.b,
                     (foundry_wall){.seam = !map->seams[i].stops, .stops = map->seams[i].stops}));
    end_json_part(writer, ']');
    return SL_OK;
}

/// The size of a token, in squares, with which the reader finds its middle again: 1 or a smaller
/// power of two. 0 where there is none.
static double size_of_token(const tabletop_writer *writer, sl_point at) {
    for (double size = 1; size > 0x1p-60; size /= 2) {
        const double half = size * square_of(writer->pixels) / 2;
        if (at.x - half + half == at.x && at.y - half + half == at.y) return size;
    }
    return 0;
}

static void put_token(tabletop_writer *writer, const sl_start *start, size_t number) {
    const sl_point at = {start->at.x * writer->pixels,
                         sli_turned_y(writer->top, start->at.y) * writer->pixels};
    const double exact = size_of_token(writer, at), size = exact > 0 ? exact : 1;
    const double half = size * square_of(writer->pixels) / 2;
    writer->rounded += exact == 0;
    begin_json_part(writer, NULL, '{');
    put_id(writer, "start", number);
    put_text(writer, "name", "start");
    put_real(writer, "x", at.x - half);
    put_real(writer, "y", at.y - half);
    put_real(writer, "width", size);
    put_real(writer, "height", size);
    // Turned by 0 degrees a token faces down; it turns clockwise.
    put_real(writer, "rotation", fmod(630 - fmod(start->heading, 360), 360));
    put_whole(writer, "disposition", 1);
    end_json_part(writer, '}');
}

static void tell_rounding(const tabletop_writer *writer) {
    if (writer->between)
        sl_note(writer->context,
                "Foundry itself keeps whole pixels: %zu of %zu walls and doors have ends between "
                "them, which it may round",
                writer->between, writer->written);
    if (writer->rounded)
        sl_note(writer->context, "%zu start%s moved by the rounding of doubles", writer->rounded,
                writer->rounded == 1 ? " is" : "s are");
}

sl_status sli_map_print_foundry(sl_context *context, const sl_map *map, FILE *stream) {
    const sl_box page = sli_page_of(map);
    tabletop_writer writer = writer_of(context, map, stream);
    writer.pixels = pixels_of(map);
    begin_json_part(&writer, NULL, '{');
    put_text(&writer, "name", "Sightline");
    put_real(&writer, "width", fmax(ceil(page.max.x * writer.pixels), 1));
    put_real(&writer, "height", fmax(ceil((writer.top - page.min.y) * writer.pixels), 1));
    put_whole(&writer, "padding", 0);
    begin_json_part(&writer, "grid", '{');
    put_whole(&writer, "type", 1);
    put_real(&writer, "size", square_of(writer.pixels));
    end_json_part(&writer, '}');
    SL_TRY(put_walls(&writer));
    begin_json_part(&writer, "tokens", '[');
    for (size_t i = 0; i < map->start_count; i++) put_token(&writer, &map->starts[i], i);
    end_json_part(&writer, ']');
    begin_json_part(&writer, "flags", '{');
    begin_json_part(&writer, "sightline", '{');
    if (writer.pixels != 1) put_real(&writer, "pixels", writer.pixels);
    put_marks(&writer);
    end_json_part(&writer, '}');
    end_json_part(&writer, '}');
    end_json_part(&writer, '}');
    putc('\n', stream);
    tell_rounding(&writer);
    return SL_OK;
}
