/// Things to choose from by name.
#ifndef NAMES_H
#define NAMES_H

#include "sightline/stab.h"

/// `count` structures of `stride` bytes, each starting with a pointer to its name.
typedef struct sl_name_table {
    const char *kind; ///< "method", for messages
    const void *items;
    size_t stride, count;
} sl_name_table;

const char *sl_name_table_at(const sl_name_table *table, size_t index);

enum { SL_NAME_LIST = 256 };

/// All names with commas between, for messages: those that there is room for, "..." for the others,
/// "none" where there are none. A name that is there twice, one behind the other, is told once.
void sl_name_list(const sl_name_table *table, char text[SL_NAME_LIST]);

/// The name of the table that a word was most likely meant to be; NULL where none is near.
const char *sl_nearest_name(const sl_name_table *table, const char *word);

/// "closed" and "open", numbered as sl_sight is.
sl_name_table sl_sight_table(void);
const char *sl_sight_name(sl_sight sight);

#endif
