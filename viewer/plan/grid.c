/// The grid that things are drawn on by hand, and how near the pointer has to be to them.
#include "plan/grid.h"

#include <math.h>

double grid_step(const view_state *view) {
    const double wanted = 11 * view->ui->density / view->camera.scale;
    double step = pow(10, floor(log10(wanted)));
    if (step * 2 >= wanted) return step * 2;
    return step * 5 >= wanted ? step * 5 : step * 10;
}

sl_point grid_snap(const view_state *view, sl_point at) {
    const double step = grid_step(view);
    return (sl_point){step * round(at.x / step), step * round(at.y / step)};
}

sl_point grid_moved(const view_state *view, sl_point from, sl_point to) {
    return grid_snap(view, (sl_point){to.x - from.x, to.y - from.y});
}

double grid_distance(sl_point p, sl_point a, sl_point b) {
    const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
    const double along = length > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length : 0;
    const double t = fmin(fmax(along, 0), 1);
    return hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

double grid_reach(const view_state *view) {
    return 7 * view->ui->density / view->camera.scale;
}
