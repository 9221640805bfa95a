#include "camera.h"

#include <math.h>

plan_camera camera_fit(sl_box bounds, double width, double height) {
    const double wide = fmax(bounds.max.x - bounds.min.x, 1e-100);
    const double high = fmax(bounds.max.y - bounds.min.y, 1e-100);
    const double scale = 0.94 * fmin(width / wide, height / high);
    return (plan_camera){.middle = {bounds.min.x + wide / 2, bounds.min.y + high / 2},
                         .scale = scale,
                         .least = scale / 8,
                         .most = scale * 4096};
}

void camera_pan(plan_camera *camera, double dx, double dy) {
    camera->middle.x -= dx / camera->scale;
    camera->middle.y += dy / camera->scale;
}

void camera_zoom(plan_camera *camera, double factor, sl_point offset) {
    const double scale = fmin(fmax(camera->scale * factor, camera->least), camera->most);
    camera->middle.x += offset.x / camera->scale - offset.x / scale;
    camera->middle.y -= offset.y / camera->scale - offset.y / scale;
    camera->scale = scale;
}

sl_frame camera_frame(const plan_camera *camera, sl_box pane, double unit) {
    const double width = pane.max.x - pane.min.x, height = pane.max.y - pane.min.y;
    return (sl_frame){.corner = {camera->middle.x - width / 2 / camera->scale,
                                 camera->middle.y - height / 2 / camera->scale},
                      .scale = camera->scale,
                      .left = pane.min.x,
                      .top = pane.min.y,
                      .width = width,
                      .height = height,
                      .unit = unit};
}

sl_point camera_point(const plan_camera *camera, sl_box pane, sl_point page) {
    const double x = page.x - (pane.min.x + pane.max.x) / 2;
    const double y = page.y - (pane.min.y + pane.max.y) / 2;
    return (sl_point){camera->middle.x + x / camera->scale, camera->middle.y - y / camera->scale};
}
