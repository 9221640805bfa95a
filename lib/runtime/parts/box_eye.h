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
