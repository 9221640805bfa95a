/// Things to choose from by name, and the endings of names.
#ifndef NAMES_H
#define NAMES_H

#include "sightline/measures.h"
#include "sightline/stab.h"

/// `count` structures of `stride` bytes that each start with a pointer to their name. Or, without
/// them, a function that gives the names by number.
typedef struct name_table {
    const char *kind; ///< "method", for messages
    const void *items;
    size_t stride, count;
    const char *(*at)(size_t index); ///< instead of `items`
} name_table;

/// Whether the name of a file ends with `ending` (".slv"), in upper or lower case.
bool name_ends_with(const char *path, const char *ending);

const char *name_table_at(const name_table *table, size_t index);

enum { NAME_LIST = 256 };

/// All names with commas between, for messages. "..." stands for those that do not fit, "none" for
/// an empty table. A name that follows itself appears once.
void name_list(const name_table *table, char text[NAME_LIST]);

/// The name that a misspelt word most likely means; NULL where none is near.
const char *nearest_name(const name_table *table, const char *word);

/// "closed" and "open", numbered as sl_sight is.
name_table sight_table(void);
/// Numbered as in the tables of the library.
name_table measure_table(sl_analysis analysis);
name_table method_table(void);
name_table effect_table(void);
name_table subdivision_table(void);
/// Bit by bit as SL_STOPS_SIGHT ...
name_table stops_table(void);
/// Numbered as by built_solver().
name_table solver_table(void);

const char *sight_name(sl_sight sight);

#endif
