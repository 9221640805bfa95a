#include "sightline/view.h"
#include "geometry/orient.h"

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

/// Whether two points lie on one ray from the eye, given that they are in line with it.
static bool same_ray(sl_point eye, sl_point a, sl_point b) {
    const bool x = (a.x > eye.x) == (b.x > eye.x) && (a.x < eye.x) == (b.x < eye.x);
    const bool y = (a.y > eye.y) == (b.y > eye.y) && (a.y < eye.y) == (b.y < eye.y);
    return x && y;
}

bool sl_view_holds(const sl_view *view, sl_point point) {
    const sl_point eye = view->eye;
    if (view->full || (point.x == eye.x && point.y == eye.y)) return true;
    const int width = sl_orient(eye, view->right, view->left);
    const int from_right = sl_orient(eye, view->right, point);
    const int from_left = sl_orient(eye, view->left, point);
    if (width > 0) return from_right >= 0 && from_left <= 0;
    if (width < 0) return from_right >= 0 || from_left <= 0;
    if (same_ray(eye, view->right, view->left))
        return from_right == 0 && same_ray(eye, view->right, point);
    return from_right >= 0;
}
