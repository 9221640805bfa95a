#include "draw/chart_axis.h"

#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MICRO "\xc2\xb5"

/// How long the linear part of a symmetric logarithm is, to either side, in decades.
#define LINEAR_PART 0.5

static double scaled(sl_chart_scale scale, double value) {
    switch (scale) {
    case SL_CHART_LOG:
        return log10(value);
    case SL_CHART_SYMLOG:
        return fabs(value) < 1 ? LINEAR_PART * value
                               : copysign(LINEAR_PART + log10(fabs(value)), value);
    case SL_CHART_LINEAR:
        break;
    }
    return value;
}

/// The least length of an axis: a decade, so that it has ticks; or what doubles can tell apart.
static double least_length(sl_chart_scale scale, double low, double high) {
    const double most = fmax(fabs(low), fabs(high));
    if (scale == SL_CHART_SYMLOG && most <= LINEAR_PART) return LINEAR_PART; // 0 is there
    if (scale != SL_CHART_LINEAR) return 1;
    return most > 0 ? 1e-6 * most : 1;
}

sl_axis sl_axis_fit(const sl_chart_axis *what, double least, double most) {
    double low = scaled(what->scale, least), high = scaled(what->scale, most);
    if (what->over && what->under) {
        high = fmax(fabs(low), fabs(high));
        // Up to 10 at least: a chart whose values are all 0 shows how far off they could have been.
        if (what->scale == SL_CHART_SYMLOG) high = fmax(high, LINEAR_PART + 1);
        if (!(high > 0)) high = 1;
        low = -high;
    }
    const double missing = least_length(what->scale, low, high) - (high - low);
    if (missing > 0) {
        low -= missing / 2;
        high += missing / 2;
    }
    const double around = 0.06 * (high - low);
    return (sl_axis){.what = what, .low = low - around, .high = high + around, .to = 1};
}

double sl_axis_place(const sl_axis *axis, double value) {
    const double share = (scaled(axis->what->scale, value) - axis->low) / (axis->high - axis->low);
    return axis->from + (axis->to - axis->from) * share;
}

// --- ticks

/// `digits` times ten to `power`, as the nearest double.
static double decimal(long long digits, int power) {
    char text[48];
    double value = 0;
    const int length = snprintf(text, sizeof text, "%llde%d", digits, power);
    sl_number_read(text, (size_t)length, &value);
    return value;
}

static void write_number(long long digits, int power, const char *unit, char *text) {
    char number[SL_COUNT_TEXT];
    const double value = decimal(digits, power);
    if (fabs(value) < 1e6 && value == trunc(value)) {
        sl_text_count((uint64_t)fabs(value), "", number);
        snprintf(text, SL_COUNT_TEXT, "%s%.*s%s", value < 0 ? "-" : "", SL_COUNT_TEXT - 8, number,
                 unit);
        return;
    }
    char plain[SL_NUMBER_TEXT];
    if (llabs(digits) < 10 && (power >= 6 || power < -4))
        snprintf(plain, sizeof plain, "%llde%d", digits, power);
    else
        sl_number_write(value, plain);
    snprintf(text, SL_COUNT_TEXT, "%s%s", plain, unit);
}

/// In the unit that suits a power of ten.
static void write_seconds(long long digits, int power, int unit_power, char *text) {
    static const char *const units[] = {" s", " ms", " " MICRO "s", " ns"};
    int unit = 0;
    while (unit < 3 && unit_power < -3 * unit) unit++;
    write_number(digits, power + 3 * unit, digits ? units[unit] : "", text);
}

static void write_tick(const sl_axis *axis, long long digits, int power, int unit_power,
                       char *text) {
    const bool plain = axis->what->over && axis->what->under && digits < 0;
    if (digits == 0 && axis->what->zero)
        sl_text_copy(axis->what->zero, strlen(axis->what->zero), text, SL_COUNT_TEXT);
    else if (axis->what->seconds)
        write_seconds(plain ? -digits : digits, power, unit_power, text);
    else
        write_number(plain ? -digits : digits, power, "", text);
}

typedef struct tick_list {
    const sl_axis *axis;
    sl_tick *items;
    size_t count;
} tick_list;

static void add(tick_list *list, long long digits, int power, int unit_power, bool minor) {
    const sl_axis *axis = list->axis;
    const double value = decimal(digits, power), at = scaled(axis->what->scale, value);
    if (!(at >= axis->low && at <= axis->high) || list->count == SL_TICKS_MOST) return;
    sl_tick *tick = &list->items[list->count++];
    *tick = (sl_tick){.value = value, .minor = minor};
    if (!minor) write_tick(axis, digits, power, unit_power, tick->text);
}

/// Every decade that fits, or every second or third ...; on short axes 2 and 5 between them too.
static void add_decades(tick_list *list, double low, double high, int sign) {
    const int first = (int)floor(low), last = (int)ceil(high), step = 1 + (last - first) / 11;
    const bool few = high - low < 2.5, fine = step == 1 && last - first <= 10;
    for (int n = 0; n <= last - first; n++) {
        const int power = sign > 0 ? first + n : last - n;
        for (int m = 1; m <= 9; m++) {
            const int digit = sign > 0 ? m : 10 - m;
            const bool major = digit == 1 ? power % step == 0 : few && (digit == 2 || digit == 5);
            if (major || fine) add(list, sign * digit, power, power, !major);
        }
    }
}

static void add_symlog(tick_list *list) {
    const sl_axis *axis = list->axis;
    if (axis->low < -LINEAR_PART)
        add_decades(list, fmax(-axis->high - LINEAR_PART, 0), -axis->low - LINEAR_PART, -1);
    add(list, 0, 0, 0, false);
    if (axis->high > LINEAR_PART)
        add_decades(list, fmax(axis->low - LINEAR_PART, 0), axis->high - LINEAR_PART, 1);
}

/// At 1, 2 or 5 times a power of ten: about six of them.
static void add_linear(tick_list *list) {
    const sl_axis *axis = list->axis;
    const double wanted = (axis->high - axis->low) / 6;
    const int power = (int)floor(log10(wanted));
    const double most = fmax(fabs(axis->low), fabs(axis->high));
    const int unit_power = most > 0 ? (int)floor(log10(most)) : 0;
    static const int leads[] = {1, 2, 5, 10};
    int i = 0;
    while (i < 3 && leads[i] * pow(10, power) < wanted) i++;
    const double step = leads[i] * pow(10, power);
    const long long last = (long long)floor(axis->high / step);
    for (long long n = (long long)ceil(axis->low / step); n <= last; n++)
        add(list, n * leads[i], power, unit_power, false);
}

size_t sl_axis_ticks(const sl_axis *axis, sl_tick ticks[SL_TICKS_MOST]) {
    tick_list list = {.axis = axis, .items = ticks};
    switch (axis->what->scale) {
    case SL_CHART_LOG:
        add_decades(&list, axis->low, axis->high, 1);
        break;
    case SL_CHART_SYMLOG:
        add_symlog(&list);
        break;
    case SL_CHART_LINEAR:
        add_linear(&list);
        break;
    }
    return list.count;
}
