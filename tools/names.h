/// Things to choose from by name.
#ifndef NAMES_H
#define NAMES_H

#include "sightline/stab.h"

/// `count` structures of `stride` bytes, each starting with a pointer to its name; or names by
/// their number.
typedef struct name_table {
    const char *kind; ///< "method", for messages
    const void *items;
    size_t stride, count;
    const char *(*at)(size_t index); ///< instead of `items`
} name_table;

const char *name_table_at(const name_table *table, size_t index);

enum { NAME_LIST = 256 };

/// All names with commas between, for messages: those that there is room for, "..." for the others,
/// "none" where there are none. A name that is there twice, one behind the other, is told once.
void name_list(const name_table *table, char text[NAME_LIST]);

/// The name of the table that a word was most likely meant to be; NULL where none is near.
const char *nearest_name(const name_table *table, const char *word);

/// "closed" and "open", numbered as sl_sight is.
name_table sight_table(void);
/// As they are numbered in the library's tables.
name_table method_table(void);
name_table effect_table(void);
name_table subdivision_table(void);
/// As solver_at() numbers them.
name_table solver_table(void);

const char *sight_name(sl_sight sight);

#endif
