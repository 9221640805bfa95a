/// Numbers as sums of two doubles: for lines that meet at a sharp angle.

// The header and the library have this part in common. Products of halves of numbers are exact, so
// that it does not matter which steps a compiler fuses.

/// The number high + low.
typedef struct slrt_pair {
    double high, low;
} slrt_pair;

/// The upper half of a number's bits, rounded. The rest has no more bits than that.
static double slrt_upper(double number) {
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    bits = (bits + (UINT64_C(1) << 26)) & ~((UINT64_C(1) << 27) - 1);
    memcpy(&number, &bits, sizeof number);
    return number;
}

/// The sum of a number and a smaller one: exact.
static slrt_pair slrt_quick_sum(double a, double b) {
    slrt_pair sum;
    sum.high = a + b;
    sum.low = b - (sum.high - a);
    return sum;
}

/// Exact (Shewchuk 1997, theorem 7).
static slrt_pair slrt_difference(double a, double b) {
    slrt_pair difference;
    double part;
    difference.high = a - b;
    part = a - difference.high;
    difference.low = (a - (difference.high + part)) + (part - b);
    return difference;
}

/// Good to about 2^-104 of it.
static slrt_pair slrt_product(slrt_pair a, slrt_pair b) {
    const double a_upper = slrt_upper(a.high), a_lower = a.high - a_upper;
    const double b_upper = slrt_upper(b.high), b_lower = b.high - b_upper;
    const double middle = a_upper * b_lower + a_lower * b_upper; // exact
    const slrt_pair sum = slrt_quick_sum(a_upper * b_upper, middle);
    const double rest = a_lower * b_lower + (a.high * b.low + a.low * b.high);
    return slrt_quick_sum(sum.high, sum.low + rest);
}

/// The cross product (u_x, u_y) x (v_x, v_y), off by no more than a unit in the last place and
/// 2^-100 of the two products.
static double slrt_cross(slrt_pair u_x, slrt_pair u_y, slrt_pair v_x, slrt_pair v_y) {
    const slrt_pair left = slrt_product(u_x, v_y), right = slrt_product(u_y, v_x);
    const slrt_pair sum = slrt_difference(left.high, right.high);
    return sum.high + (sum.low + (left.low - right.low));
}
