/// Points of a map in other coordinates, such as those of a screen with y down.

SL_RUNTIME_API bool sl_runtime_map_transform(const sl_runtime *runtime, sl_runtime_transform *out) {
    *out = runtime->transform;
    if (out->scale > 0) return true;
    out->scale = 1;
    return false;
}

SL_RUNTIME_API void sl_runtime_to_map(const sl_runtime_transform *transform, double *points,
                                      uint32_t count) {
    uint32_t i;
    for (i = 0; i < count; i++, points += 2) {
        const double y = points[1] / transform->scale;
        points[0] = transform->origin_x + points[0] / transform->scale;
        points[1] = transform->y_down ? transform->origin_y - y : transform->origin_y + y;
    }
}

SL_RUNTIME_API void sl_runtime_from_map(const sl_runtime_transform *transform, double *points,
                                        uint32_t count) {
    uint32_t i;
    for (i = 0; i < count; i++, points += 2) {
        points[0] = transform->scale * (points[0] - transform->origin_x);
        points[1] = transform->scale * (transform->y_down ? transform->origin_y - points[1]
                                                          : points[1] - transform->origin_y);
    }
}
