/// A box, a cell and a sector of directions about an eye: whether they have a point in common.

// All three are convex. So, by Helly's theorem, if any two of them meet, then all three meet unless
// a side of the cell, a border of the sector and a side of the box keep them apart:
//
//        side of the cell
//       -----.------------     The three half-planes have no point in common. The sign of one
//             .  empty  /      determinant says so, of the third degree as a box's sides are
//       box    .      /        axial.
//      --------.-.--/-----
//               ./  border
//
// The header and the library have this part in common. Beside slrt_point, slrt_eye and slrt_eye_at
// (box_envelope.h), slrt_ray, slrt_turn_to, slrt_ray_sign and slrt_side_meets (box_sieve.h), they
// say before it what these are:
//
//     slrt_vertex        a corner of a cell, by its number in the map
//     slrt_way_turn      which way a ray goes across the way from a to b: 1 to its left, -1 to its
//                        right, 0 along it; exact
//
// A box is min x, min y, max x, max y. A sector goes counter-clockwise from the ray u to the ray v,
// at most 180 degrees.

/// Whether a sector has a direction with a part upward along an axis (`up` 1), or downward (-1).
static bool slrt_sector_goes(const slrt_eye *eye, const slrt_ray *u, const slrt_ray *v, int axis,
                             int up) {
    const int of_u = up * slrt_ray_sign(eye, u, axis), of_v = up * slrt_ray_sign(eye, v, axis);
    const int turn = axis ? up : -up;
    if (of_u > 0 || of_v > 0) return true;
    return !of_u && !of_v && turn * slrt_ray_sign(eye, u, !axis) > 0 &&
           turn * slrt_ray_sign(eye, v, !axis) < 0;
}

/// Whether a box meets a sector. If not, a side of one of them lies between them.
static bool slrt_box_meets_sector(const slrt_eye *eye, const double box[4], const slrt_ray *u,
                                  const slrt_ray *v) {
    const slrt_point at = slrt_eye_at(eye);
    bool right = true, left = true;
    int k;
    if ((at.x < box[0] && !slrt_sector_goes(eye, u, v, 0, 1)) ||
        (at.x > box[2] && !slrt_sector_goes(eye, u, v, 0, -1)) ||
        (at.y < box[1] && !slrt_sector_goes(eye, u, v, 1, 1)) ||
        (at.y > box[3] && !slrt_sector_goes(eye, u, v, 1, -1)))
        return false;
    for (k = 0; k < 4 && (right || left); k++) {
        slrt_point corner;
        corner.x = box[k & 1 ? 2 : 0];
        corner.y = box[k & 2 ? 3 : 1];
        right = right && slrt_turn_to(eye, u, corner) < 0;
        left = left && slrt_turn_to(eye, v, corner) > 0;
    }
    return !right && !left;
}

/// Whether three half-planes have no point in common, any two of which have: left or right of a
/// ray (`of_ray` 1 or -1), left of a cell's side from a to b, and above or below a value along an
/// axis (`up` 1 or -1). By Farkas' lemma: the normals leave no direction free, and the corners
/// between the lines go around the wrong way.
static bool slrt_keep_apart(const slrt_eye *eye, const slrt_ray *ray, int of_ray, slrt_point a,
                            slrt_point b, int axis, int up, double value) {
    const int part = slrt_ray_sign(eye, ray, axis);
    const double from = axis ? a.y : a.x, to = axis ? b.y : b.x;
    return part && (to > from) - (to < from) == -of_ray * part &&
           slrt_way_turn(eye, ray, a, b) == -up * part &&
           part * slrt_side_meets(eye, ray, a, b, axis, value) > 0;
}

/// Whether a box has a point in common with a sector and with a cell that it meets, into which the
/// eye sees in the sector. The cell's corners are numbers from `first` on.
static bool slrt_box_meets_within(const slrt_eye *eye, const double box[4], uint32_t first,
                                  uint32_t count, const slrt_ray *u, const slrt_ray *v) {
    slrt_point a = slrt_vertex(eye, first + count - 1);
    uint32_t i;
    if (!slrt_box_meets_sector(eye, box, u, v)) return false;
    for (i = 0; i < count; i++) {
        const slrt_point b = slrt_vertex(eye, first + i);
        int axis;
        for (axis = 0; axis < 2; axis++)
            if (slrt_keep_apart(eye, u, 1, a, b, axis, 1, box[axis]) ||
                slrt_keep_apart(eye, u, 1, a, b, axis, -1, box[2 + axis]) ||
                slrt_keep_apart(eye, v, -1, a, b, axis, 1, box[axis]) ||
                slrt_keep_apart(eye, v, -1, a, b, axis, -1, box[2 + axis]))
                return false;
        a = b;
    }
    return true;
}
