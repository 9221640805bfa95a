/// A small game: walls that break, a building site, doors, guards with cones, fog that stays.
/* A small game in C with SDL2, by the runtime header alone.
 *
 *     sightline bake maps/effects/fort.map -o fort.slv
 *     cc fort.c -I.. $(sdl2-config --cflags --libs) -lm -o fort
 *     ./fort fort.slv                             W A S D walk, E opens, shuts, breaks, builds
 *     ./fort fort.slv ddde....aa PICTURE.bmp      a frame for each of these keys, without a window
 *
 * Doors are those of the map: plain ones, walls that break, sites. Each path of the map is the
 * round of a guard. Guards stop as long as they see the player. What was seen once stays on the
 * screen, in grey. fort.html is the same in JavaScript. */
#include <SDL.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "sightline_runtime.h"

enum { GUARDS = 16, POINTS = 4096, PIXELS = 36 }; /* PIXELS: in a unit of the map */
enum { SETTLE_PORTALS = 10000 };                  /* in a frame: about a millisecond */
static const double RADIUS = 0.3, PACE = 0.15, GUARD_PACE = 0.06, REACH = 1.2, TILE = 0.25;
static const double PLAYER_RANGE = 10, GUARD_RANGE = 9;
static const double TAN_HALF = 1.732; /* guards look 120 degrees wide */

typedef struct guard {
    double x, y, look_x, look_y;
    double *points; /* its round, of `count` points; it walks to point `next` */
    uint32_t count, next;
    bool sees; /* the player */
} guard;

typedef struct game {
    sl_runtime level;
    sl_runtime_state state; /* doors and rows: one for each game that runs */
    sl_runtime_grid fog;
    uint32_t *scratch, frame, explored, guard_count;
    guard guards[GUARDS];
    double x, y, points[2 * POINTS]; /* the player, and the polygon that he sees */
    uint32_t point_count;
} game;

static void fail(const char *what, const char *name) {
    fprintf(stderr, "fort: %s: %s\n", name, what);
    exit(2);
}

static void *room(size_t bytes) {
    void *block = calloc(bytes + 1, 1);
    if (!block) fail("out of memory", "level");
    return block;
}

static void open_level(game *g, const char *name) {
    size_t size;
    void *bytes = SDL_LoadFile(name, &size);
    if (!bytes) fail("cannot be read", name);
    const sl_runtime_status status = sl_runtime_open(bytes, size, &g->level);
    if (status != SL_RUNTIME_OK) fail(sl_runtime_status_text(status), name);
    g->scratch = room(sl_runtime_scratch_count(&g->level) * sizeof *g->scratch);
    sl_runtime_state_start(&g->state, &g->level,
                           room(sl_runtime_state_count(&g->level) * sizeof(uint32_t)));
    g->fog = sl_runtime_grid_over(&g->level, TILE);
    g->fog.bits = room(((size_t)g->fog.columns * g->fog.rows + 7) / 8);

    sl_runtime_viewpoint start;
    if (!sl_runtime_start(&g->level, 0, &start)) fail("the map has no start", name);
    g->x = start.x;
    g->y = start.y;
    for (uint32_t i = 0; i < g->level.path_count && i < GUARDS; i++) {
        guard *who = &g->guards[g->guard_count++];
        sl_runtime_name path;
        sl_runtime_path(&g->level, i, &path, &who->count);
        who->points = room(2 * who->count * sizeof *who->points);
        sl_runtime_path_points(&g->level, i, who->points);
        who->x = who->points[0];
        who->y = who->points[1];
    }
}

/* --- doors and walls */

/* How near a door is to a place. Those of this game have one segment. */
static double distance_to(const game *g, uint32_t door, double x, double y) {
    sl_runtime_segment s = {0, 0, 1, 0};
    sl_runtime_door_segments(&g->level, door, &s, 1);
    const double ax = s.x1 - s.x0, ay = s.y1 - s.y0;
    const double t = ((x - s.x0) * ax + (y - s.y0) * ay) / (ax * ax + ay * ay);
    const double at = fmin(fmax(t, 0), 1);
    return hypot(s.x0 + at * ax - x, s.y0 + at * ay - y);
}

/* Opens, shuts, breaks or builds the nearest thing in reach that can be. Nobody may stand in it. */
static void act(game *g) {
    static const char *const verbs[3][2] = {
        {"opens", "shuts"}, {"breaks", ""}, {"", "is built"}}; /* by kind, and shut */
    uint32_t nearest = SL_RUNTIME_NO_DOOR;
    double least = REACH;
    for (uint32_t i = 0; i < g->level.door_count; i++) {
        const double far = distance_to(g, i, g->x, g->y);
        const sl_runtime_door_kind done = g->state.shut[i] ? SL_RUNTIME_SITE : SL_RUNTIME_BREAKABLE;
        if (far > least || sl_runtime_get_door_kind(&g->level, i) == done) continue;
        nearest = i;
        least = far;
    }
    if (nearest == SL_RUNTIME_NO_DOOR) return;
    const sl_runtime_name name = sl_runtime_door_name(&g->level, nearest);
    const bool shuts = !g->state.shut[nearest];
    for (uint32_t i = 0; i < g->guard_count; i++)
        least = fmin(least, distance_to(g, nearest, g->guards[i].x, g->guards[i].y));
    if (shuts && least <= RADIUS) return;
    sl_runtime_state_set_door(&g->state, nearest, shuts);
    printf("frame %u: %.*s %s\n", (unsigned)g->frame, (int)name.length, name.text,
           verbs[sl_runtime_get_door_kind(&g->level, nearest)][shuts]);
}

static void walk(const game *g, double *x, double *y, double step_x, double step_y) {
    const sl_runtime_walker walker = {RADIUS, g->state.shut, NULL, SL_RUNTIME_NO_BOX};
    sl_runtime_walk(&g->level, &walker, *x, *y, *x + step_x, *y + step_y, g->scratch, x, y);
}

/* --- guards */

/* The rows say no at once for most. The cone and the exact answer from point to point say the
 * rest. (Nobody stands on walls here: to who does, rows do not say it all.) */
static bool guard_sees(const game *g, const guard *who) {
    const uint32_t here = sl_runtime_locate(&g->level, who->x, who->y);
    const uint32_t there = sl_runtime_locate(&g->level, g->x, g->y);
    const double x = g->x - who->x, y = g->y - who->y;
    const double ahead = x * who->look_x + y * who->look_y;
    const double beside = fabs(x * who->look_y - y * who->look_x);
    return sl_runtime_state_can_see(&g->state, here, there) && beside <= TAN_HALF * ahead &&
           sl_runtime_sees(&g->level, who->x, who->y, g->x, g->y, g->state.shut, GUARD_RANGE,
                           g->scratch);
}

static void patrol(const game *g, guard *who) {
    const double x = who->points[2 * who->next] - who->x;
    const double y = who->points[2 * who->next + 1] - who->y;
    const double length = hypot(x, y), step = fmin(GUARD_PACE, length);
    if (length < GUARD_PACE) who->next = (who->next + 1) % who->count;
    if (length == 0) return;
    who->look_x = x / length;
    who->look_y = y / length;
    walk(g, &who->x, &who->y, step * who->look_x, step * who->look_y);
}

/* --- a frame */

static void step(game *g, double x, double y, bool acts) {
    g->frame++;
    walk(g, &g->x, &g->y, PACE * x, PACE * y);
    if (acts) act(g);
    for (uint32_t i = 0; i < g->guard_count; i++) {
        guard *who = &g->guards[i];
        if (!who->sees) patrol(g, who);
        const bool sees = guard_sees(g, who);
        if (sees != who->sees)
            printf("frame %u: guard %u %s you\n", (unsigned)g->frame, (unsigned)i,
                   sees ? "sees" : "loses");
        who->sees = sees;
    }
    const sl_runtime_view view = sl_runtime_view_all_round(g->x, g->y);
    g->point_count = sl_runtime_visible_polygon(&g->level, &view, g->state.shut, PLAYER_RANGE,
                                                g->scratch, g->points, POINTS);
    if (g->point_count > POINTS) g->point_count = 0; /* more than there is room for */
    g->explored += sl_runtime_explore(&g->fog, g->x, g->y, g->points, g->point_count);
    sl_runtime_settle(&g->state, SETTLE_PORTALS);
}

/* --- the picture; y goes up in the map and down on the screen */

/* A polygon that is seen whole from one point, as triangles about it. */
static void fill(SDL_Renderer *out, const game *g, double x, double y, const double *points,
                 uint32_t count, SDL_Color colour) {
    for (uint32_t i = 0; i < count; i++) {
        const double *a = points + 2 * i, *b = points + 2 * ((i + 1) % count);
        const double corners[6] = {x, y, a[0], a[1], b[0], b[1]};
        SDL_Vertex triangle[3];
        for (int k = 0; k < 3; k++) {
            triangle[k].position.x = (float)((corners[2 * k] - g->level.min_x) * PIXELS);
            triangle[k].position.y = (float)((g->level.max_y - corners[2 * k + 1]) * PIXELS);
            triangle[k].color = colour;
        }
        SDL_RenderGeometry(out, NULL, triangle, 3, NULL, 0);
    }
}

static void line(SDL_Renderer *out, const game *g, const sl_runtime_segment *s, double width,
                 SDL_Color colour) {
    const double x = s->x1 - s->x0, y = s->y1 - s->y0, size = width / 2 / hypot(x, y);
    const double u = x * size, v = y * size;
    const double points[8] = {s->x0 - u + v, s->y0 - v - u, s->x1 + u + v, s->y1 + v - u,
                              s->x1 + u - v, s->y1 + v + u, s->x0 - u - v, s->y0 - v + u};
    fill(out, g, s->x0, s->y0, points, 4, colour);
}

static void disc(SDL_Renderer *out, const game *g, double x, double y, SDL_Color colour) {
    double points[2 * 24];
    for (int i = 0; i < 24; i++) {
        points[2 * i] = x + RADIUS * cos(i * 0.2617993877991494);
        points[2 * i + 1] = y + RADIUS * sin(i * 0.2617993877991494);
    }
    fill(out, g, x, y, points, 24, colour);
}

static void draw_walls(SDL_Renderer *out, const game *g) {
    static const SDL_Color wall = {222, 214, 196, 255};
    /* By kind: a door, a wall that breaks, a site; shut and open. */
    static const SDL_Color colours[3][2] = {{{200, 60, 50, 255}, {60, 150, 70, 255}},
                                            {{190, 140, 80, 255}, {90, 75, 60, 255}},
                                            {{190, 140, 80, 255}, {70, 90, 130, 255}}};
    sl_runtime_segment at;
    for (uint32_t i = 0; sl_runtime_wall(&g->level, i, &at); i++) line(out, g, &at, 0.16, wall);
    for (uint32_t i = 0; i < g->level.door_count; i++) {
        const bool open = !g->state.shut[i];
        sl_runtime_door_segments(&g->level, i, &at, 1);
        line(out, g, &at, open ? 0.08 : 0.2, colours[sl_runtime_get_door_kind(&g->level, i)][open]);
    }
}

/* Guards that the player sees, with what they see. */
static void draw_guards(SDL_Renderer *out, const game *g) {
    static double points[2 * POINTS];
    for (uint32_t i = 0; i < g->guard_count; i++) {
        const guard *who = &g->guards[i];
        const SDL_Color calm = {220, 170, 60, 90}, alert = {230, 50, 40, 110};
        const SDL_Color body = {who->sees ? 255 : 230, who->sees ? 60 : 180, 50, 255};
        const sl_runtime_view view =
            sl_runtime_view_toward(who->x, who->y, who->look_x, who->look_y, TAN_HALF);
        if (!sl_runtime_sees(&g->level, g->x, g->y, who->x, who->y, g->state.shut, PLAYER_RANGE,
                             g->scratch))
            continue;
        const uint32_t count = sl_runtime_visible_polygon(&g->level, &view, g->state.shut,
                                                          GUARD_RANGE, g->scratch, points, POINTS);
        if (count <= POINTS) fill(out, g, who->x, who->y, points, count, who->sees ? alert : calm);
        disc(out, g, who->x, who->y, body);
    }
}

/* What was not explored is black. */
static void draw_fog(SDL_Renderer *out, const game *g) {
    const float size = (float)TILE * PIXELS,
                top = (float)(g->level.max_y - g->level.min_y) * PIXELS;
    SDL_SetRenderDrawColor(out, 0, 0, 0, 255);
    for (uint32_t i = 0; i < g->fog.columns * g->fog.rows; i++) {
        const float x = (float)(i % g->fog.columns), y = (float)(i / g->fog.columns + 1);
        const SDL_FRect tile = {x * size, top - y * size, size, size};
        if (!(g->fog.bits[i / 8] >> i % 8 & 1)) SDL_RenderFillRectF(out, &tile);
    }
}

static void draw(SDL_Renderer *out, const game *g) {
    const SDL_Color lit = {250, 235, 170, 70}, you = {90, 190, 250, 255};
    SDL_SetRenderDrawBlendMode(out, SDL_BLENDMODE_BLEND);
    SDL_SetRenderDrawColor(out, 58, 60, 72, 255);
    SDL_RenderClear(out);
    fill(out, g, g->x, g->y, g->points, g->point_count, lit);
    draw_guards(out, g);
    draw_walls(out, g);
    draw_fog(out, g);
    disc(out, g, g->x, g->y, you);
}

/* --- with keys, and without */

static void play(SDL_Renderer *out, game *g) {
    for (;;) {
        const Uint8 *down = SDL_GetKeyboardState(NULL);
        bool acts = false;
        SDL_Event event;
        while (SDL_PollEvent(&event)) {
            if (event.type == SDL_QUIT) return;
            acts |=
                event.type == SDL_KEYDOWN && !event.key.repeat && event.key.keysym.sym == SDLK_e;
        }
        step(g, down[SDL_SCANCODE_D] - down[SDL_SCANCODE_A],
             down[SDL_SCANCODE_W] - down[SDL_SCANCODE_S], acts);
        draw(out, g);
        SDL_RenderPresent(out);
        SDL_Delay(16);
    }
}

int main(int argc, char **argv) {
    static game g;
    if (argc != 2 && argc != 4) fail("LEVEL.slv [KEYS PICTURE.bmp]", "usage");
    open_level(&g, argv[1]);
    const int width = (int)((g.level.max_x - g.level.min_x) * PIXELS);
    const int height = (int)((g.level.max_y - g.level.min_y) * PIXELS);
    if (SDL_Init(SDL_INIT_VIDEO)) fail(SDL_GetError(), "SDL");
    SDL_Window *window = SDL_CreateWindow("Fort", SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED,
                                          width, height, argc == 4 ? SDL_WINDOW_HIDDEN : 0);
    SDL_Renderer *out = window ? SDL_CreateRenderer(window, -1, 0) : NULL;
    if (!out) fail(SDL_GetError(), "SDL");
    if (argc == 4) {
        for (const char *key = argv[2]; *key; key++)
            step(&g, (*key == 'd') - (*key == 'a'), (*key == 'w') - (*key == 's'), *key == 'e');
        draw(out, &g);
        SDL_Surface *picture =
            SDL_CreateRGBSurfaceWithFormat(0, width, height, 32, SDL_PIXELFORMAT_ARGB8888);
        if (!picture ||
            SDL_RenderReadPixels(out, NULL, SDL_PIXELFORMAT_ARGB8888, picture->pixels,
                                 picture->pitch) ||
            SDL_SaveBMP(picture, argv[3]))
            fail(SDL_GetError(), argv[3]);
    } else {
        play(out, &g);
    }
    printf("%u frames, at %.4g %.4g, %u of %u tiles explored, %u rows unsettled\n",
           (unsigned)g.frame, g.x, g.y, (unsigned)g.explored,
           (unsigned)(g.fog.columns * g.fog.rows), (unsigned)g.state.unsettled);
    SDL_Quit();
    return 0;
}
