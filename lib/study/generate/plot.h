/// The plot that a kind of map is laid out on: walls on whole coordinates, and chance.
#ifndef SL_GENERATE_PLOT_H
#define SL_GENERATE_PLOT_H

#include "sightline/generate.h"
#include "sightline/support.h"

typedef struct sli_plot {
    sl_context *context;
    sl_map *map;
    sl_random random;
    int columns, rows; ///< of the kind's units, at least as many as it needs
    int count;         ///< units asked for, columns * rows at most
    double open;       ///< percent
} sli_plot;

/// x0 < x1, y0 < y1.
typedef struct sli_rect {
    int x0, y0, x1, y1;
} sli_rect;

/// A straight piece: upright at x = `at`, or level at y = `at`.
typedef struct sli_run {
    bool upright;
    int at, low, high; ///< low < high
} sli_run;

typedef enum sl_side { SLI_LEFT, SLI_RIGHT, SLI_BOTTOM, SLI_TOP, SLI_SIDES } sl_side;

/// Any of low .. high, each as likely.
int sli_pick(sli_plot *plot, int low, int high);
bool sli_chance(sli_plot *plot, int percent);

/// Walls may lie on walls that are there already: the map is cleaned at the end. A run without
/// length adds nothing.
sl_status sli_plot_wall(sli_plot *plot, sli_run run);
/// A wall with an opening, low < high, within the run.
sl_status sli_plot_wall_open(sli_plot *plot, sli_run run, int low, int high);
/// A wall with a door of 1 somewhere.
sl_status sli_plot_wall_door(sli_plot *plot, sli_run run);
sl_status sli_plot_box(sli_plot *plot, sli_rect rect);
sli_run sli_side_of(sli_rect rect, sl_side side);

sl_status sli_plot_start(sli_plot *plot, double x, double y);

/// Reports and asks whether to stop: after each row of units.
sl_status sli_plot_row_done(sli_plot *plot, int row);

/// Divides a rectangle, whose own walls are somebody else's, into rooms at least `least` wide, by
/// walls with one door each: all rooms are joined. No wall begins or ends in a gap between whole
/// coordinates, so doors of 1 stay free.
sl_status sli_plot_rooms(sli_plot *plot, sli_rect rect, int least);

/// The kinds.
sl_status sli_lay_maze(sli_plot *plot);
sl_status sli_lay_office(sli_plot *plot);
sl_status sli_lay_city(sli_plot *plot);
sl_status sli_lay_pillars(sli_plot *plot);
sl_status sli_lay_tunnels(sli_plot *plot);
sl_status sli_lay_tower(sli_plot *plot);

#endif
