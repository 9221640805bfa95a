/// Point to point.

/// Whether a point is within the range of the eye: the sign of an exact sum. Numbers are scaled, so
/// that no product overflows, and the range is more than any distance where it is left out.
static bool slrt_is_within(const slrt_search *s, double x, double y) {
    const double largest = slrt_larger(slrt_larger(s->x, s->y), slrt_larger(x, y));
    const double scale = slrt_scale_of(largest), range = scale * s->range;
    const double from[2] = {scale * s->x, scale * s->y}, to[2] = {scale * x, scale * y};
    double parts[14];
    int count = 0, i;
    if (range > 8) return true;
    for (i = 0; i < 2; i++) {
        count = slrt_add_product(parts, count, to[i], to[i]);
        count = slrt_add_product(parts, count, -2 * to[i], from[i]);
        count = slrt_add_product(parts, count, from[i], from[i]);
    }
    count = slrt_add_product(parts, count, -range, range);
    return !count || parts[count - 1] <= 0;
}

/// Whether a search's eye sees a point.
static bool slrt_sees_point(slrt_search *s, double point_x, double point_y) {
    const double x = slrt_no_dust(point_x), y = slrt_no_dust(point_y);
    const slrt_arm way = slrt_make_arm(s->x, s->y, x, y);
    slrt_finding found;
    if (!slrt_in_bounds(s->rt, x, y) || (s->range > 0 && !slrt_is_within(s, x, y))) return false;
    found = slrt_follow_within(s, &way);
    return found == SLRT_TOUCHES ? slrt_follow(s, &way) : found == SLRT_ARRIVES;
}

SL_RUNTIME_API bool sl_runtime_sees(const sl_runtime *runtime, double x0, double y0, double x1,
                                    double y1, const unsigned char *shut, double range,
                                    uint32_t *scratch) {
    const sl_runtime_view view = sl_runtime_view_all_round(x0, y0);
    slrt_search s;
    return slrt_start_search(&s, runtime, &view, shut, range, scratch) &&
           slrt_sees_point(&s, x1, y1);
}
