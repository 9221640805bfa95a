/// Tables of names, and the name that a misspelt one most likely means.
#include "arguments/names.h"

#include "sightline/cell_to_cell.h"
#include "sightline/effects.h"
#include "sightline/space.h"
#include "system/built.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

bool name_ends_with(const char *path, const char *ending) {
    const size_t length = strlen(path), tail = strlen(ending);
    return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

const char *name_table_at(const name_table *table, size_t index) {
    if (table->at) return table->at(index);
    const char *item = (const char *)table->items + index * table->stride;
    const char *name;
    memcpy(&name, item, sizeof name);
    return name;
}

void name_list(const name_table *table, char text[NAME_LIST]) {
    static const char more[] = ", ...";
    const size_t room = NAME_LIST - sizeof more;
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < table->count; i++) {
        const char *name = name_table_at(table, i);
        if (i && strcmp(name, name_table_at(table, i - 1)) == 0) continue;
        const size_t length = strlen(name) + (used ? 2 : 0);
        if (used + length > room) {
            strcpy(text + used, used ? more : more + 2);
            return;
        }
        snprintf(text + used, NAME_LIST - used, "%s%s", used ? ", " : "", name);
        used += length;
    }
    if (!used) strcpy(text, "none");
}

/// Edit distance (Levenshtein 1966): the fewest letters to insert, drop or change that make one
/// word of the other. Words have less than `NEAR_LENGTH` letters.
enum { NEAR_LENGTH = 32 };

static size_t word_distance(const char *a, const char *b) {
    size_t row[NEAR_LENGTH];
    const size_t length = strlen(b);
    for (size_t j = 0; j <= length; j++) row[j] = j;
    for (size_t i = 0; a[i]; i++) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < length; j++) {
            const size_t changed = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            size_t least = changed < diagonal + 1 ? changed : diagonal + 1;
            if (row[j] + 1 < least) least = row[j] + 1;
            row[j + 1] = least;
        }
    }
    return row[length];
}

const char *nearest_name(const name_table *table, const char *word) {
    const size_t length = strlen(word);
    if (length >= NEAR_LENGTH) return NULL;
    const char *nearest = NULL;
    size_t least = length < 6 ? 2 : 3; // more changes than that and it is another word
    if (least >= length) least = length ? length - 1 : 0;
    for (size_t i = 0; i < table->count; i++) {
        const char *name = name_table_at(table, i);
        if (strlen(name) >= NEAR_LENGTH) continue;
        const size_t distance = word_distance(word, name);
        if (distance > least || (nearest && distance == least)) continue;
        nearest = name;
        least = distance;
    }
    return nearest;
}

// --- tables

static const char *const stopped[] = {"sight", "steps", "sound"};

static const char *const sights[] = {[SL_CLOSED] = "closed", [SL_OPEN] = "open"};

name_table sight_table(void) {
    return (name_table){"sight", sights, sizeof *sights, sizeof sights / sizeof *sights, NULL};
}

const char *sight_name(sl_sight sight) {
    return sights[sight];
}

name_table measure_table(sl_analysis analysis) {
    size_t count;
    const sl_measure *measures = sl_measures(analysis, &count);
    return (name_table){"measure", measures, sizeof *measures, count, NULL};
}

name_table method_table(void) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    return (name_table){"method", methods, sizeof *methods, count, NULL};
}

static const char *effect_name(size_t index) {
    return sl_effects(&(size_t){0})[index]->name;
}

name_table effect_table(void) {
    size_t count;
    sl_effects(&count);
    return (name_table){.kind = "effect", .count = count, .at = effect_name};
}

name_table subdivision_table(void) {
    size_t count;
    const sl_subdivision *subdivisions = sl_subdivisions(&count);
    return (name_table){"subdivision", subdivisions, sizeof *subdivisions, count, NULL};
}

static const char *solver_name(size_t index) {
    return built_solver(index)->name;
}

name_table solver_table(void) {
    name_table table = {.kind = "solver", .at = solver_name};
    while (built_solver(table.count)) table.count++;
    return table;
}

name_table stops_table(void) {
    return (name_table){"thing that walls stop", stopped, sizeof *stopped, 3, NULL};
}
