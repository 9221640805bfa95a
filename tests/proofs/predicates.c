// The exact predicates' integers: factors of a product have 53 bits, its exponent lies in the range
// that the limbs are made for, and a sum of products stays within the limbs, with shifts below the
// width of a word. For all doubles; of the loop over the limbs the first four turns.
//
// unwind 6
#include "proof.h"

#include "geometry/orient.c"

static product any_product(void) {
    product p = {.negative = nondet_bool()};
    p.magnitude.high = nondet_ulong();
    p.magnitude.low = nondet_ulong();
    p.exponent = nondet_int();
    ASSUME(p.magnitude.high < UINT64_C(1) << 42); // 2^106 in all
    ASSUME(p.exponent >= -2148 && p.exponent <= 1942 + 128 * MISSING);
    return p;
}

void factors_have_53_bits(void) {
    int a, b;
    const uint64_t from_a = integer_part(nondet_double(), &a);
    const uint64_t from_b = integer_part(nondet_double(), &b);
    PROVE(from_a < UINT64_C(1) << 53 && from_b < UINT64_C(1) << 53);
    PROVE(a + b >= -2148 && a + b <= 1942 + 2 - MISSING * 3);
}

void limbs_are_enough(void) {
    const product p = any_product(), q = any_product();
    const int range = p.exponent - q.exponent;
    ASSUME(range >= 0);
    // As sign_of_sum counts them, and where its calls of add_product() begin.
    const int count = (range + 106 + 8) / 64 + 1;
    PROVE(count <= LIMBS && range / 64 < count);
}

/// The loop takes the same steps for more limbs.
void adding_stays_in_the_limbs(void) {
    const product p = any_product();
    const int shift = nondet_int(), count = nondet_int();
    uint64_t limbs[4] = {0};
    ASSUME(count > 0 && count <= 4 + MISSING && shift >= 0 && shift / 64 < count);
    add_product(limbs, count, &p, shift);
}

void products_are_compared_in_range(void) {
    const product p = any_product(), q = any_product();
    int order = 2;
    if (compare_products(&p, &q, &order)) PROVE(order >= -1 && order <= 1 - MISSING);
}

void shifts_are_below_64(void) {
    const sli_wide a = {nondet_ulong(), nondet_ulong()};
    const int shift = nondet_int();
    ASSUME(shift >= 0 && shift < 64 + MISSING);
    const sli_wide shifted = sli_wide_shifted(a, shift);
    PROVE(sli_wide_compare(shifted, shifted) == 0);
}
