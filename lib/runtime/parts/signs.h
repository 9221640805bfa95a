/// Signs of determinants: exact.

/// A vector between two points: rounded, and the two points.
typedef struct slrt_arm {
    double x, y;
    double to_x, to_y, from_x, from_y;
} slrt_arm;

static slrt_arm slrt_make_arm(double from_x, double from_y, double to_x, double to_y) {
    slrt_arm arm;
    arm.x = to_x - from_x;
    arm.y = to_y - from_y;
    arm.to_x = to_x;
    arm.to_y = to_y;
    arm.from_x = from_x;
    arm.from_y = from_y;
    return arm;
}

/// Adds a number to an exact sum of parts that do not overlap, least first (Shewchuk 1997,
/// Grow-Expansion with zero elimination). Returns the new number of parts.
static int slrt_add(double *parts, int count, double number) {
    int i, kept = 0;
    for (i = 0; i < count; i++) {
        const double sum = number + parts[i], added = sum - number;
        const double lost = (number - (sum - added)) + (parts[i] - added);
        if (lost != 0) parts[kept++] = lost;
        number = sum;
    }
    if (number != 0) parts[kept++] = number;
    return kept;
}

/// Adds a product as two parts (Dekker's). Numbers are cut by their bits, so each step is exact,
/// also where a compiler fuses it with the next one.
static int slrt_add_product(double *parts, int count, double a, double b) {
    const double product = a * b;
    const double a_upper = slrt_upper(a), a_lower = a - a_upper;
    const double b_upper = slrt_upper(b), b_lower = b - b_upper;
    const double lost = a_lower * b_lower -
                        (((product - a_upper * b_upper) - a_lower * b_upper) - a_upper * b_lower);
    return slrt_add(parts, slrt_add(parts, count, lost), product);
}

static double slrt_larger(double a, double b) {
    if (a < 0) a = -a;
    if (b < 0) b = -b;
    return a > b ? a : b;
}

/// The points of an arm, scaled so that no product comes near underflow.
static void slrt_scaled(const slrt_arm *arm, double *to_x, double *to_y, double *from_x,
                        double *from_y) {
    const double largest =
        slrt_larger(slrt_larger(arm->to_x, arm->to_y), slrt_larger(arm->from_x, arm->from_y));
    const double scale = largest < 1e50 ? 8.749002899132048e+99 : 1; // 2^332
    *to_x = scale * arm->to_x;
    *to_y = scale * arm->to_y;
    *from_x = scale * arm->from_x;
    *from_y = scale * arm->from_y;
}

/// As slrt_side, without rounding.
static int slrt_side_exact(const slrt_arm *u, const slrt_arm *v) {
    double a_x, a_y, b_x, b_y, c_x, c_y, d_x, d_y, parts[16], sum;
    int count = 0;
    // Frequent: one point, and points on one axial line.
    if (u->to_x == v->to_x && u->to_y == v->to_y && u->from_x == v->from_x &&
        u->from_y == v->from_y)
        return 0;
    if (u->to_x == u->from_x && v->to_x == v->from_x) return 0;
    if (u->to_y == u->from_y && v->to_y == v->from_y) return 0;
    slrt_scaled(u, &a_x, &a_y, &b_x, &b_y);
    slrt_scaled(v, &c_x, &c_y, &d_x, &d_y);
    count = slrt_add_product(parts, count, a_x, c_y);
    count = slrt_add_product(parts, count, a_x, -d_y);
    count = slrt_add_product(parts, count, -b_x, c_y);
    count = slrt_add_product(parts, count, b_x, d_y);
    count = slrt_add_product(parts, count, -a_y, c_x);
    count = slrt_add_product(parts, count, a_y, d_x);
    count = slrt_add_product(parts, count, b_y, c_x);
    count = slrt_add_product(parts, count, -b_y, d_x);
    sum = count ? parts[count - 1] : 0;
    return (sum > 0) - (sum < 0);
}

/// The sign of u x v: 1 if v points to the left of u. The rounded product decides if it is large
/// enough (Shewchuk 1997, section 4.1: (3 + 16e)e of the sum of its parts, e = 2^-53).
static int slrt_side(const slrt_arm *u, const slrt_arm *v) {
    const double left = u->x * v->y, right = u->y * v->x;
    const double product = left - right;
    const double sum = (left < 0 ? -left : left) + (right < 0 ? -right : right);
    const double bound = 4e-16 * sum + 1e-300;
    if (product > bound) return 1;
    if (-product > bound) return -1;
    return slrt_side_exact(u, v);
}

/// Whether two vectors in one line point the same way; false if either is 0.
static bool slrt_same_way(const slrt_arm *u, const slrt_arm *v) {
    return (u->to_x > u->from_x && v->to_x > v->from_x) ||
           (u->to_x < u->from_x && v->to_x < v->from_x) ||
           (u->to_y > u->from_y && v->to_y > v->from_y) ||
           (u->to_y < u->from_y && v->to_y < v->from_y);
}

/// A power of two that brings a number to between 1 and 2.
static double slrt_scale_of(double number) {
    uint64_t bits;
    double scale;
    memcpy(&bits, &number, sizeof bits);
    bits = bits >> 52 & 0x7ff;
    if (bits < 1) bits = 1;
    if (bits > 2045) bits = 2045;
    bits = (2046 - bits) << 52;
    memcpy(&scale, &bits, sizeof scale);
    return scale;
}

/// Multiplies an exact sum by a number, and adds that to another one.
static int slrt_add_times(double *parts, int count, const double *factor, int factor_count,
                          double number) {
    int i;
    for (i = 0; i < factor_count; i++) count = slrt_add_product(parts, count, factor[i], number);
    return count;
}
