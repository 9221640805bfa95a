/// The lesson of the subdivision: the splits of a kd-tree in the order in which they are made; for
/// a mesh the triangulation, and the sides that are taken out or have to stay.
#include "draw/draw_lesson.h" // private: the lesson shows the inside of the library
#include "lessons/learn.h"
#include "sightline/draw.h"

#include <math.h>
#include <stdio.h>

static bool is_mesh(const document_state *document) {
    return document->baked->space.neighbour != NULL;
}

/// Old files with oblique walls have neither splits nor a mesh.
static bool fits(const document_state *document) {
    return !document->baked || !document->baked->space.loose;
}

// --- a kd-tree

static const char *const kd_code[] = {
    "subdivide(box):",
    "    if no wall is inside box: it is a cell",
    "    lines = those that hold a wall inside",
    "    keep walls that span, then well covered lines,",
    "        then those that cut the fewest walls",
    "    split at the one nearest to the median",
    "    subdivide(below), subdivide(above)",
};

static void say_split(const document_state *document, uint32_t at, char text[SENTENCE]) {
    const sl_space *space = &document->baked->space;
    const sl_node *node = &space->nodes[at];
    snprintf(text, SENTENCE,
             "Split %u of %u, %u deep: the line %s = %.*g, of which walls cover %.0f %% here; %s.",
             at + 1, space->node_count, document->splits[at].depth + 1, node->axis == 0 ? "x" : "y",
             sl_map_digits(&document->map), node->position,
             100 * sli_splits_covered(document->splits, space, at),
             node->below < 0 && node->above < 0   ? "both sides are cells"
             : node->below < 0 || node->above < 0 ? "one side is a cell, the other goes on"
                                                  : "both sides go on");
}

// --- a mesh

/// Number of steps before the sides. Each side is one step, and the final cells are one more.
enum { WALLS, POINTS, DELAUNAY, TRIANGLES, FIRST_SIDE };

static const char *const mesh_code[] = {
    "subdivide(walls, seams):",
    "    points = their ends, corners of the bounds",
    "    triangles = Delaunay triangulation of points",
    "    for each wall or seam that is no side:",
    "        turn the sides that cross it",
    "    for all other sides, the longest first:",
    "        if a corner would turn right: it stays",
    "        else: take it out",
    "    cells = what triangles have become",
};

static size_t mesh_line(const lesson_state *lesson) {
    static const size_t lines[] = {[WALLS] = 0, [POINTS] = 1, [DELAUNAY] = 2, [TRIANGLES] = 4};
    if (lesson->at < FIRST_SIDE) return lines[lesson->at];
    const size_t place = lesson->at - FIRST_SIDE;
    if (place == lesson->mesh.sides.count) return 8;
    return lesson->mesh.sides.items[place].stuck == SLI_OUTSIDE ? 7 : 6;
}

static const char *ending(size_t count) {
    return count == 1 ? "" : "s";
}

/// Counts walls and seams that the triangulation of the points alone does not have.
static size_t count_missing(const sli_mesh_steps *mesh) {
    size_t count = 0;
    for (size_t i = 0; i < mesh->triangles.halves.count / 2; i++)
        count += mesh->fresh[i] && mesh->triangles.labels[i];
    return count;
}

static void say_stage(const lesson_state *lesson, const sl_space *space, char text[SENTENCE]) {
    const sli_mesh_steps *mesh = &lesson->mesh;
    const size_t missing = count_missing(mesh), points = mesh->triangles.points.count;
    if (lesson->at == WALLS)
        snprintf(text, SENTENCE, "%u wall%s and %u seam%s: cells must not run over them.",
                 space->wall_count, ending(space->wall_count), space->seam_count,
                 ending(space->seam_count));
    else if (lesson->at == POINTS)
        snprintf(text, SENTENCE,
                 "%zu points: all corners of cells will be among them, so no coordinate is ever "
                 "computed.",
                 points);
    else if (lesson->at == DELAUNAY && missing)
        snprintf(text, SENTENCE,
                 "No circle around a triangle has a point inside. %zu wall%s or seam%s (marked) "
                 "cross%s sides.",
                 missing, ending(missing), ending(missing), missing == 1 ? "es" : "");
    else if (lesson->at == DELAUNAY)
        snprintf(text, SENTENCE,
                 "No circle around a triangle has a point inside. All walls and seams are sides.");
    else if (missing)
        snprintf(text, SENTENCE,
                 "Sides that crossed a wall or seam are turned (blue): now all walls and seams are "
                 "sides.");
    else
        snprintf(text, SENTENCE, "No side has to be turned.");
}

static void say_side(const sli_mesh_steps *mesh, const document_state *document, size_t place,
                     char text[SENTENCE]) {
    const sli_mesh_side *side = &mesh->sides.items[place];
    const sli_triangulation *t = &mesh->triangles;
    const sl_point a = t->points.items[t->halves.items[side->half].from];
    const sl_point b = t->points.items[sli_half_end(t, side->half)];
    const int length = snprintf(text, SENTENCE, "Side %zu of %zu, %.5g long", place + 1,
                                mesh->sides.count, hypot(b.x - a.x, b.y - a.y));
    if (side->stuck == SLI_OUTSIDE) {
        snprintf(text + length, SENTENCE - (size_t)length,
                 ": it is taken out, as the two cells make a convex one.");
        return;
    }
    sl_point corner[3];
    sli_mesh_steps_corner(mesh, place, corner);
    char place_of_corner[PLACE_TEXT];
    view_say_place(&document->map, corner[1], place_of_corner);
    snprintf(text + length, SENTENCE - (size_t)length,
             " stays: without it the corner at %s would turn %s.", place_of_corner,
             sl_orient(corner[0], corner[1], corner[2]) ? "right" : "back");
}

static void say_cells(const sli_mesh_steps *mesh, const document_state *document,
                      char text[SENTENCE]) {
    const sl_space *space = &document->baked->space;
    size_t stay = 0;
    for (size_t i = 0; i < mesh->sides.count; i++)
        stay += mesh->sides.items[i].stuck != SLI_OUTSIDE;
    const int length = snprintf(text, SENTENCE, "%zu sides are taken out, %zu stay as portals.",
                                mesh->sides.count - stay, stay);
    if (document->map.cell_count)
        snprintf(text + length, SENTENCE - (size_t)length,
                 " The map has cells of its own too: with their sides as seams there are %u cells.",
                 space->cell_count);
    else
        snprintf(text + length, SENTENCE - (size_t)length, " %u cells are left.",
                 space->cell_count);
}

/// Covers the final cells of the plan.
static void draw_ground(view_state *view, const sl_frame *frame) {
    const sl_box b = view->document->baked->space.bounds;
    const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
    sl_path_polygon(view->ui->cairo, frame, corners, 4);
    sl_set_colour(view->ui->cairo, view->ui->palette.floor[0]);
    cairo_fill(view->ui->cairo);
    const sl_space *space = &view->document->baked->space;
    for (uint32_t cell = 0; cell < space->cell_count && view->document->solid; cell++) {
        const sl_cell *c = &space->cells[cell];
        if (c->solid)
            sl_path_polygon(view->ui->cairo, frame, space->vertices + c->first_vertex,
                            c->vertex_count);
    }
    sl_set_colour(view->ui->cairo, view->ui->palette.solid);
    cairo_fill(view->ui->cairo);
}

static void draw_mesh(learn_state *learn, const sl_frame *frame) {
    const sl_palette *palette = &learn->ui->palette;
    const sli_mesh_steps *mesh = &learn->lesson.mesh;
    cairo_t *cairo = learn->ui->cairo;
    const size_t at = learn->lesson.at;
    if (at == FIRST_SIDE + mesh->sides.count) return;
    draw_ground(learn->view, frame);
    if (at == DELAUNAY) sli_draw_mesh_delaunay(cairo, palette, frame, mesh);
    if (at == TRIANGLES) sli_draw_mesh_triangles(cairo, palette, frame, mesh);
    if (at >= FIRST_SIDE)
        view_check(learn->view, sli_draw_mesh_side(learn->context, cairo, palette, frame, mesh,
                                                   at - FIRST_SIDE));
}

// --- all of it

static sl_status record(sl_context *context, lesson_state *lesson, const document_state *document,
                        uint32_t source) {
    (void)source;
    lesson->subdivision_steps = document->baked->space.node_count;
    if (!is_mesh(document)) return SL_OK;
    SL_TRY(sli_mesh_steps_record(context, &document->baked->space, &lesson->mesh));
    lesson->subdivision_steps = FIRST_SIDE + lesson->mesh.sides.count + 1;
    return SL_OK;
}

static size_t length(const lesson_state *lesson) {
    return lesson->subdivision_steps;
}

static const char *const *code(const lesson_state *lesson, const document_state *document,
                               size_t *count, size_t *lit) {
    if (is_mesh(document)) {
        *lit = mesh_line(lesson);
        *count = sizeof mesh_code / sizeof *mesh_code;
        return mesh_code;
    }
    *lit = 5; // every step is a split
    *count = sizeof kd_code / sizeof *kd_code;
    return kd_code;
}

static void say(const lesson_state *lesson, const document_state *document, char text[SENTENCE]) {
    const size_t place = lesson->at - FIRST_SIDE;
    if (!is_mesh(document))
        say_split(document, (uint32_t)lesson->at, text);
    else if (lesson->at < FIRST_SIDE)
        say_stage(lesson, &document->baked->space, text);
    else if (place < lesson->mesh.sides.count)
        say_side(&lesson->mesh, document, place, text);
    else
        say_cells(&lesson->mesh, document, text);
}

static void below(learn_state *learn, const sl_frame *frame) {
    if (is_mesh(learn->document))
        draw_mesh(learn, frame);
    else
        sli_draw_split(learn->ui->cairo, &learn->ui->palette, frame, learn->document->splits,
                       (uint32_t)learn->lesson.at);
}

static void above(learn_state *learn, const sl_frame *frame) {
    const lesson_state *lesson = &learn->lesson;
    if (!is_mesh(learn->document)) return;
    if (lesson->at == POINTS)
        sli_draw_mesh_points(learn->ui->cairo, &learn->ui->palette, frame, &lesson->mesh);
    if (lesson->at >= FIRST_SIDE)
        sli_draw_mesh_corner(learn->ui->cairo, &learn->ui->palette, frame, &lesson->mesh,
                             lesson->at - FIRST_SIDE);
}

/// A side that is taken out: two cells become one.
static bool finds(const lesson_state *lesson, size_t step) {
    const size_t place = step - FIRST_SIDE;
    return lesson->mesh.sides.count && step >= FIRST_SIDE && place < lesson->mesh.sides.count &&
           lesson->mesh.sides.items[place].stuck == SLI_OUTSIDE;
}

/// A side that stays.
static bool rejects(const lesson_state *lesson, size_t step) {
    const size_t place = step - FIRST_SIDE;
    return lesson->mesh.sides.count && step >= FIRST_SIDE && place < lesson->mesh.sides.count &&
           lesson->mesh.sides.items[place].stuck != SLI_OUTSIDE;
}

const subject_row lesson_subdivision = {
    .title = "Subdivision",
    .fits = fits,
    .record = record,
    .length = length,
    .sentence = say,
    .code = code,
    .finds = finds,
    .rejects = rejects,
    .found = "Taken out",
    .rejected = "Stays",
    .below = below,
    .above = above,
};
