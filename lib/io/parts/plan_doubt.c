/// Looks at a drawing as a net of lines.
///
/// Of a net with E lines, V corners and C pieces, E - V + C lines may be taken away before it falls
/// into trees: where that is 0 nothing is enclosed (Euler).
#include "io/parts/plan_doubt.h"

#include "io/parts/names.h"
#include "io/parts/plan_net.h"

#include <math.h>
#include <string.h>

/// Furniture and symbols are up to such a part of a drawing, round ones may be larger. A round
/// piece has so many walls.
enum { SMALL = 12, ROUND = 5, LEAST_ROUND = 8 };

// --- what is told

/// Counts the corners of each piece.
static void count_corners(sli_plan_net *n, uint32_t *corners) {
    for (uint32_t end = 0; end < 2 * (uint32_t)n->map->wall_count; end++)
        if (sl_root_of(n->corner, end) == end) corners[sl_root_of(n->piece, end / 2)]++;
}

/// Adds the pieces that are no circles or ellipses: not one ring, or with a corner that is not as
/// far from the middle of the box.
static void find_angular(const sli_plan_net *n, const uint32_t *corners, sl_bits *angular) {
    for (uint32_t i = 0; i < (uint32_t)n->map->wall_count; i++) {
        const uint32_t first = sl_root_of(n->piece, i);
        const sl_box box = n->boxes[first];
        const sl_point at = n->map->walls[i].a;
        const double x = (2 * at.x - box.min.x - box.max.x) / sli_box_width(box);
        const double y = (2 * at.y - box.min.y - box.max.y) / sli_box_height(box);
        if (n->counts[first] < LEAST_ROUND || n->counts[first] != corners[first] ||
            !(fabs(x * x + y * y - 1) < 0.1))
            sl_bits_add(angular, first);
    }
}

/// Small pieces, but for those that are long or have the sides of walls. `closed`, where not NULL,
/// gets the walls of those that enclose something: furniture does, and the end of a wall does not.
static sl_status find_small(sli_plan_net *n, sl_bits *closed, sli_plan_look *out) {
    const uint32_t count = (uint32_t)n->map->wall_count;
    sl_bits *walls = sl_alloc_array(n->context, sl_bits_words(count), sizeof *walls);
    sl_bits *angular = sl_alloc_array(n->context, sl_bits_words(count), sizeof *angular);
    uint32_t *corners = sl_alloc_array(n->context, count, sizeof *corners);
    const bool room = walls && angular && corners;
    for (size_t i = 0; room && i < n->pairs.count; i++) {
        sl_bits_add(walls, sl_root_of(n->piece, n->pairs.items[i].wall));
        sl_bits_add(walls, sl_root_of(n->piece, n->pairs.items[i].other));
    }
    if (room) count_corners(n, corners);
    if (room) find_angular(n, corners, angular);
    for (uint32_t i = 0; room && i < count; i++) {
        const uint32_t first = sl_root_of(n->piece, i);
        const double w = sli_box_width(n->boxes[first]), h = sli_box_height(n->boxes[first]);
        const bool large = fmax(w, h) > n->size / SMALL;
        const bool round = large && !sl_bits_has(angular, first) && fmax(w, h) <= n->size / ROUND;
        if (sl_bits_has(walls, first)) continue;
        if ((large && !round) || fmax(w, h) > 3 * fmin(w, h)) continue;
        if (round && closed) sl_bits_add(closed, i);
        if (round) {
            out->round += first == i;
            continue;
        }
        out->pieces += first == i;
        out->small++;
        if (n->counts[first] < corners[first]) continue;
        out->small_closed++;
        if (closed) sl_bits_add(closed, i);
    }
    sl_free(n->context, walls);
    sl_free(n->context, angular);
    sl_free(n->context, corners);
    return room ? SL_OK : SL_NO_MEMORY;
}

/// Walls that cross others and are short, as doors and symbols are.
static sl_status count_across(sli_plan_net *n, sli_plan_look *out) {
    sl_bits *across = sl_alloc_array(n->context, sl_bits_words(n->map->wall_count), sizeof *across);
    if (!across) return SL_NO_MEMORY;
    for (size_t i = 0; i < n->crossings.count; i++) {
        const uint32_t both[2] = {n->crossings.items[i].wall, n->crossings.items[i].other};
        double length[2];
        for (int k = 0; k < 2; k++) {
            const sl_wall *wall = &n->map->walls[both[k]];
            length[k] = sli_length(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
        }
        const uint32_t shorter = both[length[0] > length[1]];
        if (fmin(length[0], length[1]) > n->size / SMALL || sl_bits_has(across, shorter)) continue;
        sl_bits_add(across, shorter);
        out->across++;
    }
    sl_free(n->context, across);
    return SL_OK;
}

/// The box about all pieces but one; empty where there are none.
static sl_box box_of_others(const sli_plan_net *n, uint32_t piece) {
    sl_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < n->map->wall_count; i++) {
        const uint32_t first = sl_root_of(n->piece, i);
        if (first != i || first == piece) continue;
        box = sli_box_with(sli_box_with(box, n->boxes[i].min), n->boxes[i].max);
    }
    return box;
}

/// Sets the box that has all but one piece, with some room; none where the piece comes near it.
static void set_others(const sli_plan_net *n, uint32_t piece, sli_plan_look *out) {
    const double room = n->size / 100, digit = pow(10, floor(log10(room / 2)));
    const sl_box box = box_of_others(n, piece);
    const sl_box wide = {
        {floor((box.min.x - room) / digit) * digit, floor((box.min.y - room) / digit) * digit},
        {ceil((box.max.x + room) / digit) * digit, ceil((box.max.y + room) / digit) * digit}};
    for (uint32_t i = 0; i < n->map->wall_count; i++) {
        const sl_wall *wall = &n->map->walls[i];
        const sl_box at = sli_box_around(wall->a, wall->b);
        if (sl_root_of(n->piece, i) == piece && at.min.x <= wide.max.x && at.max.x >= wide.min.x &&
            at.min.y <= wide.max.y && at.max.y >= wide.min.y)
            return;
    }
    out->others = wide;
}

/// Whether a piece of four upright and level walls has all else in it, with room on all sides, and
/// something large among that.
static bool is_frame(sli_plan_net *n, uint32_t piece) {
    const sl_box box = n->boxes[piece];
    const double room = n->size / 50;
    bool large = false;
    if (n->counts[piece] != 4 || sli_box_width(box) < sli_box_width(n->bounds) ||
        sli_box_height(box) < sli_box_height(n->bounds))
        return false;
    for (uint32_t i = 0; i < n->map->wall_count; i++) {
        const sl_wall *wall = &n->map->walls[i];
        const uint32_t first = sl_root_of(n->piece, i);
        if (first == piece) {
            if (wall->a.x != wall->b.x && wall->a.y != wall->b.y) return false;
            continue;
        }
        const sl_box at = n->boxes[first];
        if (at.min.x < box.min.x + room || at.min.y < box.min.y + room ||
            at.max.x > box.max.x - room || at.max.y > box.max.y - room)
            return false;
        large |= n->counts[first] >= 8 && sli_box_width(at) >= 0.4 * sli_box_width(box) &&
                 sli_box_height(at) >= 0.4 * sli_box_height(box);
    }
    return large;
}

/// Whether a piece is one ring with all else in it and half of the room empty, as the boundary of a
/// site about a house.
static bool is_site(sli_plan_net *n, uint32_t piece) {
    const sl_box box = n->boxes[piece];
    const double room = n->size / 50;
    sl_box house = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    uint32_t corners = 0, most = 0;
    if (n->counts[piece] < 3 || sli_box_width(box) < sli_box_width(n->bounds) ||
        sli_box_height(box) < sli_box_height(n->bounds))
        return false;
    for (uint32_t end = 0; end < 2 * (uint32_t)n->map->wall_count; end++) {
        const uint32_t first = sl_root_of(n->piece, end / 2);
        corners += first == piece && sl_root_of(n->corner, end) == end;
        if (first == piece) continue;
        const bool small = fmax(sli_box_width(n->boxes[first]), sli_box_height(n->boxes[first])) <=
                           n->size / SMALL;
        if (n->counts[first] > most && !small) most = n->counts[first];
        house.min.x = fmin(house.min.x, n->boxes[first].min.x);
        house.min.y = fmin(house.min.y, n->boxes[first].min.y);
        house.max.x = fmax(house.max.x, n->boxes[first].max.x);
        house.max.y = fmax(house.max.y, n->boxes[first].max.y);
    }
    return corners == n->counts[piece] && most >= 8 && house.min.x >= box.min.x + room &&
           house.min.y >= box.min.y + room && house.max.x <= box.max.x - room &&
           house.max.y <= box.max.y - room &&
           2 * sli_box_width(house) * sli_box_height(house) <=
               sli_box_width(box) * sli_box_height(box);
}

static sl_status find_all(sli_plan_net *n, sli_plan_look *out) {
    const uint32_t count = (uint32_t)n->map->wall_count;
    size_t corners = 0, pieces = 0;
    for (uint32_t i = 0; i < 2 * count; i++) corners += sl_root_of(n->corner, i) == i;
    for (uint32_t i = 0; i < count; i++) {
        if (sl_root_of(n->piece, i) != i) continue;
        pieces++;
        const bool frame = is_frame(n, i), site = is_site(n, i);
        if (frame || (site && !out->frame)) set_others(n, i, out);
        out->frame |= frame;
        out->site |= site;
    }
    const size_t lines = count + n->ends_on_sides + n->crossings.count + pieces;
    out->walls = count;
    out->closed = lines > corners ? lines - corners : 0;
    SL_TRY(count_across(n, out));
    return find_small(n, NULL, out);
}

sl_status sli_plan_look_at(sl_context *context, const sl_map *map, double metre, double tolerance,
                           sli_plan_look *out) {
    sli_plan_net net;
    *out = (sli_plan_look){0};
    sl_status status = sli_plan_net_make(context, map, 0.05 * metre, 0.6 * metre, tolerance, &net);
    if (status == SL_OK && net.whole) status = find_all(&net, out);
    out->crowded = status == SL_OK && map->wall_count && !net.whole;
    sli_plan_net_destroy(&net);
    return status;
}

/// The lines of a map, its windows and its doors; the walls first.
static sl_status copy_lines(sl_context *context, const sl_map *map, sl_map *out) {
    const size_t count = map->wall_count + map->seam_count + map->door_count;
    out->walls = sl_alloc_array(context, count, sizeof *out->walls);
    if (!out->walls) return SL_NO_MEMORY;
    memcpy(out->walls, map->walls, map->wall_count * sizeof *out->walls);
    out->wall_count = map->wall_count;
    for (size_t i = 0; i < map->seam_count; i++) {
        const sl_segment at = map->seams[i].segment;
        out->walls[out->wall_count++] = (sl_wall){.a = at.a, .b = at.b};
    }
    for (size_t i = 0; i < map->door_count; i++) {
        const sl_segment at = map->doors[i].segment;
        out->walls[out->wall_count++] = (sl_wall){.a = at.a, .b = at.b};
    }
    return SL_OK;
}

sl_status sli_plan_keep_large(sl_context *context, sl_map *map, double metre, sli_plan_look *out) {
    sli_plan_net net = {0};
    sl_map lines = {0};
    *out = (sli_plan_look){.walls = map->wall_count};
    sl_bits *small = NULL;
    sl_status status = copy_lines(context, map, &lines);
    if (status == SL_OK)
        status = sli_plan_net_make(context, &lines, 0.05 * metre, 0.6 * metre, 0, &net);
    out->crowded = status == SL_OK && lines.wall_count && !net.whole;
    if (status == SL_OK && net.whole) {
        small = sl_alloc_array(context, sl_bits_words(lines.wall_count), sizeof *small);
        status = small ? find_small(&net, small, out) : SL_NO_MEMORY;
    }
    size_t kept = 0;
    for (size_t i = 0; status == SL_OK && small && i < map->wall_count; i++)
        if (!sl_bits_has(small, i)) map->walls[kept++] = map->walls[i];
    if (status == SL_OK && small) map->wall_count = kept;
    sl_free(context, small);
    sl_free(context, lines.walls);
    sli_plan_net_destroy(&net);
    return status;
}

/// Round pieces that are too large for columns, with the option that leaves them out.
static void note_round(sl_context *context, const char *file, const char *layers, size_t count) {
    sl_note(context,
            "%s: %zu round piece%s touch%s nothing: %s? --layers %s" SLI_LAYERS_LARGE
            "%s%s%s leaves %s out",
            file, count, count == 1 ? "" : "s", count == 1 ? "es" : "",
            count == 1 ? "a table or a symbol" : "tables or symbols", layers ? "'" : "",
            layers ? "," : "", layers ? layers : "", layers ? "'" : "", count == 1 ? "it" : "them");
}

/// Small pieces, with the option that leaves them out, where most of them are closed; else with
/// the next step.
static void note_small(sl_context *context, const char *file, const char *layers, const char *next,
                       const sli_plan_look *look) {
    const double share = 100 * (double)look->small / (double)look->walls;
    if (2 * look->small_closed >= look->small)
        sl_note(context,
                "%s: %.0f %% of the lines are small pieces that touch nothing: furniture or "
                "symbols? --layers %s" SLI_LAYERS_LARGE "%s%s%s leaves out those that are closed",
                file, share, layers ? "'" : "", layers ? "," : "", layers ? layers : "",
                layers ? "'" : "");
    else
        sl_note(context,
                "%s: %.0f %% of the lines are small pieces that touch nothing: furniture or "
                "symbols? %s",
                file, share, next);
}

/// What is about all else, with the option that leaves it out.
static void note_around(sl_context *context, const char *file, const sli_plan_look *look) {
    const sl_box box = look->others;
    char option[120] = "--layers A,B";
    if (box.min.x < box.max.x)
        snprintf(option, sizeof option, "--crop %.10g,%.10g,%.10g,%.10g", box.min.x, box.min.y,
                 box.max.x, box.max.y);
    if (look->frame)
        sl_note(context,
                "%s: a rectangle about all else touches nothing: if it is the frame of a sheet, "
                "what is inside is wrong: %s leaves it out",
                file, option);
    else if (look->site)
        sl_note(context,
                "%s: a line around all else touches nothing, and half of what is in it is empty: "
                "if it is the boundary of a site, what is inside is wrong: %s leaves it out",
                file, option);
}

sl_status sli_plan_tell(sl_context *context, const char *file, const char *layers, bool alike,
                        const sl_map *map, double metre, double tolerance) {
    sli_plan_look look;
    char next[SL_LINE_TEXT];
    SL_TRY(sli_plan_look_at(context, map, metre, tolerance, &look));
    if (alike)
        snprintf(next, sizeof next,
                 "All lines are alike: sightline convert %s -o map.map writes a map from which "
                 "lines can be deleted",
                 file);
    else
        snprintf(next, sizeof next,
                 "sightline info %s lists the layers, --layers A,B takes those of walls", file);
    if (look.crowded)
        sl_note(context,
                "%s: %zu lines are too many, or too dense, to look for furniture, lettering and "
                "dimensions among them: all of them are walls; sightline info %s lists the layers, "
                "--layers A,B takes those of walls",
                file, map->wall_count, file);
    const size_t share = look.pieces >= 10 ? 7 : 4;
    if (look.walls >= 20 && look.pieces >= 3 && share * look.small >= look.walls)
        note_small(context, file, layers, next, &look);
    else if (look.round)
        note_round(context, file, layers, look.round);
    if (look.across >= 8 && 12 * look.across >= look.walls)
        sl_note(context, "%s: %zu short lines cross walls: doors or symbols drawn over them? %s",
                file, look.across, next);
    note_around(context, file, &look);
    if (look.walls >= 10 && !look.closed)
        sl_note(context,
                "%s: its lines enclose nothing: if it is a plan, walls are missing: sightline info "
                "%s lists the layers, --layers '*' takes all",
                file, file);
    return SL_OK;
}
