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
HOST(log10) double host_log10(double value);
HOST(acos) double host_acos(double value);
HOST(asinh) double host_asinh(double value);
HOST(atan2) double host_atan2(double y, double x);
HOST(fmod) double host_fmod(double value, double by);
HOST(number) double host_number(const char *text);

/// How wasi-libc takes whole turns off angles of 10^5 and more for sin() and cos(), with a table of
/// digits of 2 / pi: 2 kB. The library's angles are at most one turn.
int __rem_pio2_large(double *angle, double *turned, int exponent, int count, int precision) {
    (void)angle, (void)turned, (void)exponent, (void)count, (void)precision;
    __builtin_trap();
}

// JavaScript has these anyway: 7 kB. Measures ask for them, once a point or an edge.

double log(double value) {
    return host_log(value);
}

double log10(double value) {
    return host_log10(value);
}

double acos(double value) {
    return host_acos(value);
}

double asinh(double value) {
    return host_asinh(value);
}

double atan2(double y, double x) {
    return host_atan2(y, x);
}

double fmod(double value, double by) {
    return host_fmod(value, by);
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

/// The rounding error of a product, exactly: the library asks for nothing else. As two halves of
/// each number (Dekker 1971), cut by their bits. Without wasi-libc's sums of 128 bits: 1 kB.
double fma(double a, double b, double minus_product) {
    const double given[] = {a, b};
    double upper[2], lower[2];
    if (a * b < -minus_product || a * b > -minus_product) __builtin_trap();
    for (int i = 0; i < 2; i++) {
        unsigned long long bits;
        __builtin_memcpy(&bits, &given[i], sizeof bits);
        bits = (bits + (1ull << 26)) & ~((1ull << 27) - 1);
        __builtin_memcpy(&upper[i], &bits, sizeof bits);
        lower[i] = given[i] - upper[i];
    }
    return lower[0] * lower[1] +
           (((minus_product + upper[0] * upper[1]) + lower[0] * upper[1]) + upper[0] * lower[1]);
}

static void exchange(char *a, char *b, size_t size) {
    for (; size >= 8; size -= 8, a += 8, b += 8) {
        unsigned long long kept[2];
        __builtin_memcpy(&kept[0], a, 8);
        __builtin_memcpy(&kept[1], b, 8);
        __builtin_memcpy(a, &kept[1], 8);
        __builtin_memcpy(b, &kept[0], 8);
    }
    for (; size; size--, a++, b++) {
        const char kept = *a;
        *a = *b;
        *b = kept;
    }
}

/// Heapsort (Williams 1964), in place of wasi-libc's smoothsort: 2 kB.
void qsort(void *items, size_t count, size_t size, int (*compare)(const void *, const void *)) {
    char *const first = items;
    for (size_t unordered = count / 2, end = count; end > 1;) {
        if (unordered)
            unordered--;
        else
            exchange(first, first + --end * size, size);
        for (size_t at = unordered, child; (child = 2 * at + 1) < end; at = child) {
            char *const item = first + at * size;
            char *larger = first + child * size;
            if (child + 1 < end && compare(larger, larger + size) < 0) {
                larger += size;
                child++;
            }
            if (compare(item, larger) >= 0) break;
            exchange(item, larger, size);
        }
    }
}

// The library's texts are short: a character at a time does. 1 kB.

void *memccpy(void *restrict to, const void *restrict from, int last, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const char each = ((const char *)from)[i];
        ((char *)to)[i] = each;
        if (each == (char)last) return (char *)to + i + 1;
    }
    return NULL;
}

size_t strlen(const char *text) {
    const char *at = text;
    while (*at) at++;
    return (size_t)(at - text);
}

void *memchr(const void *bytes, int wanted, size_t count) {
    union {
        const void *given;
        char *at;
    } place = {bytes};
    for (; count; count--, place.at++)
        if (*place.at == (char)wanted) return place.at;
    return NULL;
}

char *__strchrnul(const char *text, int wanted);

/// strchr() and formatted output search by this.
char *__strchrnul(const char *text, int wanted) {
    union {
        const char *given;
        char *at;
    } place = {text};
    while (*place.at && *place.at != (char)wanted) place.at++;
    return place.at;
}

size_t strspn(const char *text, const char *set) {
    const char *at = text;
    while (*at && strchr(set, *at)) at++;
    return (size_t)(at - text);
}

size_t strcspn(const char *text, const char *set) {
    const char *at = text;
    while (*at && !strchr(set, *at)) at++;
    return (size_t)(at - text);
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
