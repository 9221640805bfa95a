#include "sightline/view.h"
#include "eye_to_cell/cone.h"

#include <math.h>

/// The point at an angle in degrees and a distance; exact for the four directions of the axes.
static sl_point toward(sl_point eye, double degrees, double reach) {
    const double turned = remainder(degrees, 360);
    double x, y;
    if (turned == 0 || fabs(turned) == 180) {
        x = turned == 0 ? 1 : -1;
        y = 0;
    } else if (fabs(turned) == 90) {
        x = 0;
        y = turned > 0 ? 1 : -1;
    } else {
        const double radians = turned * (acos(-1) / 180);
        x = cos(radians);
        y = sin(radians);
    }
    return (sl_point){eye.x + reach * x, eye.y + reach * y};
}

sl_view sl_view_all_round(sl_point eye) {
    return (sl_view){.eye = eye, .full = true};
}

sl_view sl_view_cone(sl_point eye, double heading, double fov, double reach) {
    const sl_view cone = {.eye = eye,
                          .left = toward(eye, heading + fov / 2, reach),
                          .right = toward(eye, heading - fov / 2, reach)};
    const bool closed = cone.left.x == cone.right.x && cone.left.y == cone.right.y;
    return fov >= 360 || (fov > 180 && closed) ? sl_view_all_round(eye) : cone;
}

bool sl_view_usable(const sl_view *view) {
    if (!isfinite(view->eye.x) || !isfinite(view->eye.y)) return false;
    if (view->full) return true;
    return isfinite(view->left.x) && isfinite(view->left.y) && isfinite(view->right.x) &&
           isfinite(view->right.y) && !sl_same_point(view->eye, view->left) &&
           !sl_same_point(view->eye, view->right);
}

bool sl_view_holds(const sl_view *view, sl_point point) {
    sl_pivot pivot = {.eye = view->eye};
    const sl_cone cone = sl_cone_of(&pivot, view);
    return sl_cone_holds(&pivot, &cone, point);
}

bool sl_view_meets_segment(const sl_view *view, sl_segment segment) {
    sl_pivot pivot = {.eye = view->eye};
    const sl_cone cone = sl_cone_of(&pivot, view);
    return sl_cone_meets_segment(&pivot, &cone, segment.a, segment.b);
}

bool sl_view_meets_polygon(const sl_view *view, const sl_point *corners, size_t count) {
    sl_pivot pivot = {.eye = view->eye};
    const sl_cone cone = sl_cone_of(&pivot, view);
    return sl_cone_meets_polygon(&pivot, &cone, corners, count);
}
