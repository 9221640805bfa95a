/// The plot that a kind of map is laid out on: walls on whole coordinates, and chance.
#ifndef SL_GENERATE_PLOT_H
#define SL_GENERATE_PLOT_H

#include "sightline/generate.h"
#include "sightline/support.h"

typedef struct sl_plot {
    sl_context *context;
    sl_map *map;
    sl_random random;
    int columns, rows; ///< of the kind's units, at least as many as it needs
    int count;         ///< units asked for, columns * rows at most
    double open;       ///< percent
} sl_plot;

/// x0 < x1, y0 < y1.
typedef struct sl_rect {
    int x0, y0, x1, y1;
} sl_rect;

/// A straight piece: upright at x = `at`, or level at y = `at`.
typedef struct sl_run {
    bool upright;
    int at, low, high; ///< low < high
} sl_run;

typedef enum sl_side { SL_LEFT, SL_RIGHT, SL_BOTTOM, SL_TOP, SL_SIDES } sl_side;

/// Any of low .. high, each as likely.
int sl_pick(sl_plot *plot, int low, int high);
bool sl_chance(sl_plot *plot, int percent);

/// Walls may lie on walls that are there already: the map is cleaned at the end. A run without
/// length adds nothing.
sl_status sl_plot_wall(sl_plot *plot, sl_run run);
/// A wall with an opening, low < high, within the run.
sl_status sl_plot_wall_open(sl_plot *plot, sl_run run, int low, int high);
/// A wall with a door of 1 somewhere.
sl_status sl_plot_wall_door(sl_plot *plot, sl_run run);
sl_status sl_plot_box(sl_plot *plot, sl_rect rect);
sl_run sl_side_of(sl_rect rect, sl_side side);

sl_status sl_plot_start(sl_plot *plot, double x, double y);

/// Reports and asks whether to stop: after each row of units.
sl_status sl_plot_row_done(sl_plot *plot, int row);

/// Divides a rectangle, whose own walls are somebody else's, into rooms at least `least` wide, by
/// walls with one door each: all rooms are joined. No wall begins or ends in a gap between whole
/// coordinates, so doors of 1 stay free.
sl_status sl_plot_rooms(sl_plot *plot, sl_rect rect, int least);

/// The kinds.
sl_status sl_lay_maze(sl_plot *plot);
sl_status sl_lay_office(sl_plot *plot);
sl_status sl_lay_city(sl_plot *plot);
sl_status sl_lay_pillars(sl_plot *plot);
sl_status sl_lay_tunnels(sl_plot *plot);
sl_status sl_lay_tower(sl_plot *plot);

#endif
