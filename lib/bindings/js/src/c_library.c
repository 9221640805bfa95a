/// What takes the place of functions of wasi-libc in a module that a page has to load: theirs are
/// large, most by tables that no compression makes smaller. This is compiled by itself, as the C
/// library is: its names are found only after the library was optimized as a whole.
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int __rem_pio2_large(double *angle, double *turned, int exponent, int count, int precision);

#define HOST(name) __attribute__((import_module("host"), import_name(#name)))
HOST(log) double host_log(double value);
HOST(asinh) double host_asinh(double value);
HOST(atan2) double host_atan2(double y, double x);
HOST(number) double host_number(const char *text);

/// How wasi-libc takes whole turns off angles of 10^5 and more for sin() and cos(), with a table of
/// digits of 2 / pi: 2 kB. The library's angles are at most one turn.
int __rem_pio2_large(double *angle, double *turned, int exponent, int count, int precision) {
    (void)angle, (void)turned, (void)exponent, (void)count, (void)precision;
    __builtin_trap();
}

// JavaScript has these anyway: 6 kB. Measures ask for them, once a point or an edge.

double log(double value) {
    return host_log(value);
}

double asinh(double value) {
    return host_asinh(value);
}

double atan2(double y, double x) {
    return host_atan2(y, x);
}

/// JavaScript rounds a number as exactly, and has this anyway: 6 kB. The library has checked the
/// text, and does not ask where it ends. Up to 15 digits and their power of ten are exact doubles,
/// so that one division rounds once.
double strtod(const char *text, char **end) {
    if (end) __builtin_trap();
    const char *at = text + (*text == '-' || *text == '+');
    double digits = 0, unit = 1;
    int count = 0;
    for (bool fraction = false; *at == '.' || (*at >= '0' && *at <= '9'); at++) {
        if (*at == '.') {
            fraction = true;
            continue;
        }
        digits = 10 * digits + (*at - '0');
        if (fraction) unit *= 10;
        count++;
    }
    if (*at || count > 15) return host_number(text);
    return (*text == '-' ? -digits : digits) / unit;
}

// An instruction each, with which wasi-libc was not compiled.

void *memcpy(void *to, const void *from, size_t count) {
    return __builtin_memcpy(to, from, count);
}

void *memset(void *to, int value, size_t count) {
    return __builtin_memset(to, value, count);
}

/// Messages of the system, of which there is none: 2 kB.
char *strerror(int error) {
    static char none[] = "";
    (void)error;
    return none;
}

/// Of the machine nothing is known.
long sysconf(int name) {
    (void)name;
    return -1;
}

/// The library looks for short texts in short texts. Without wasi-libc's tables for long ones: 2
/// kB.
char *strstr(const char *text, const char *part) {
    for (;; text++) {
        size_t same = 0;
        while (part[same] && text[same] == part[same]) same++;
        union {
            const char *given;
            char *found;
        } at = {text};
        if (!part[same]) return at.found;
        if (!*text) return NULL;
    }
}
