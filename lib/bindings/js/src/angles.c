/// How wasi-libc takes whole turns off angles of 10^5 and more for sin() and cos(), with a table of
/// digits of 2 / pi. The library's angles are at most one turn, so this takes its place in a module
/// that a page has to load: 2 kB less. It is compiled by itself, as the C library is: its name is
/// found only after the library was optimized as a whole.
int __rem_pio2_large(double *angle, double *turned, int exponent, int count, int precision);

int __rem_pio2_large(double *angle, double *turned, int exponent, int count, int precision) {
    (void)angle, (void)turned, (void)exponent, (void)count, (void)precision;
    __builtin_trap();
}
