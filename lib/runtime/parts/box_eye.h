/// What the parts need that the library has in common with this header: box_envelope.h says what.

typedef struct slrt_point {
    double x, y;
} slrt_point;
typedef slrt_search slrt_eye;
typedef slrt_arm slrt_ray;
typedef struct slrt_polygon slrt_sight;
typedef sl_runtime_box slrt_box_list;

static slrt_point slrt_eye_at(const slrt_eye *eye) {
    slrt_point at;
    at.x = eye->x;
    at.y = eye->y;
    return at;
}

static slrt_arm slrt_ray_to(const slrt_eye *eye, slrt_point at) {
    return slrt_make_arm(eye->x, eye->y, at.x, at.y);
}

static int slrt_turn_to(const slrt_eye *eye, const slrt_arm *ray, slrt_point at) {
    const slrt_arm to = slrt_ray_to(eye, at);
    return slrt_side(ray, &to);
}

static int slrt_point_turn(const slrt_eye *eye, slrt_point a, slrt_point b) {
    const slrt_arm ray = slrt_ray_to(eye, a);
    return slrt_turn_to(eye, &ray, b);
}

static int slrt_ray_sign(const slrt_eye *eye, const slrt_arm *ray, int axis) {
    const double from = axis ? ray->from_y : ray->from_x, to = axis ? ray->to_y : ray->to_x;
    (void)eye;
    return (to > from) - (to < from);
}

static int slrt_way_turn(const slrt_eye *eye, const slrt_arm *ray, slrt_point a, slrt_point b) {
    const slrt_arm way = slrt_make_arm(a.x, a.y, b.x, b.y);
    (void)eye;
    return slrt_side(&way, ray);
}

static slrt_point slrt_vertex(const slrt_eye *eye, uint32_t number) {
    slrt_point at;
    sl_runtime_get_vertex(eye->rt, number, &at.x, &at.y);
    return at;
}

static void slrt_read_box(const sl_runtime_box *boxes, uint32_t number, double *box) {
    box[0] = boxes[number].min_x;
    box[1] = boxes[number].min_y;
    box[2] = boxes[number].max_x;
    box[3] = boxes[number].max_y;
}

/// As slrt_side_meets, without rounding.
static int slrt_side_meets_exact(const slrt_eye *eye, const slrt_arm *u, slrt_point a, slrt_point b,
                                 int axis, double value) {
    const double place =
        slrt_scale_of(slrt_larger(slrt_larger(slrt_larger(a.x, a.y), slrt_larger(b.x, b.y)),
                                  slrt_larger(value, slrt_larger(eye->x, eye->y))));
    const double length = slrt_scale_of(
        slrt_larger(slrt_larger(u->to_x, u->to_y), slrt_larger(u->from_x, u->from_y)));
    const double a_x = place * a.x, a_y = place * a.y, b_x = place * b.x, b_y = place * b.y;
    const double e_x = place * eye->x, e_y = place * eye->y;
    const double t_x = length * u->to_x, t_y = length * u->to_y;
    const double f_x = length * u->from_x, f_y = length * u->from_y;
    double turn[16], cross[16], parts[128];
    int turns = 0, crosses = 0, count = 0;
    turns = slrt_add_product(turn, turns, b_x, a_y);
    turns = slrt_add_product(turn, turns, b_x, -e_y);
    turns = slrt_add_product(turn, turns, a_x, e_y);
    turns = slrt_add_product(turn, turns, b_y, -a_x);
    turns = slrt_add_product(turn, turns, b_y, e_x);
    turns = slrt_add_product(turn, turns, a_y, -e_x);
    crosses = slrt_add_product(cross, crosses, b_x, t_y);
    crosses = slrt_add_product(cross, crosses, b_x, -f_y);
    crosses = slrt_add_product(cross, crosses, a_x, -t_y);
    crosses = slrt_add_product(cross, crosses, a_x, f_y);
    crosses = slrt_add_product(cross, crosses, b_y, -t_x);
    crosses = slrt_add_product(cross, crosses, b_y, f_x);
    crosses = slrt_add_product(cross, crosses, a_y, t_x);
    crosses = slrt_add_product(cross, crosses, a_y, -f_x);
    count = slrt_add_times(parts, count, turn, turns, axis ? t_y : t_x);
    count = slrt_add_times(parts, count, turn, turns, axis ? -f_y : -f_x);
    count = slrt_add_times(parts, count, cross, crosses, place * -value);
    count = slrt_add_times(parts, count, cross, crosses, axis ? e_y : e_x);
    return count ? (parts[count - 1] > 0) - (parts[count - 1] < 0) : 0;
}

/// The rounded number decides if it is large enough.
static int slrt_side_meets(const slrt_eye *eye, const slrt_arm *u, slrt_point a, slrt_point b,
                           int axis, double value) {
    const double s_x = b.x - a.x, s_y = b.y - a.y;
    const double one = s_x * (a.y - eye->y), two = s_y * (a.x - eye->x);
    const double three = s_x * u->y, four = s_y * u->x;
    const double part = axis ? u->y : u->x, away = value - (axis ? eye->y : eye->x);
    const double sum = part * (one - two) - (three - four) * away;
    const double bound = 4e-15 * slrt_larger(part, 0) * slrt_size(one, two) +
                         4e-15 * slrt_size(three, four) * (away < 0 ? -away : away) + 1e-150;
    if (sum > bound) return 1;
    if (-sum > bound) return -1;
    return slrt_side_meets_exact(eye, u, a, b, axis, value);
}
