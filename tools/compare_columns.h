/// What is told of a run, column by column: the same in CSV and in JSON.
#ifndef COMPARE_COLUMNS_H
#define COMPARE_COLUMNS_H

#include "compare_report.h"

typedef enum sl_value_kind {
    SL_VALUE_NONE,
    SL_VALUE_TEXT,
    SL_VALUE_REAL,
    SL_VALUE_COUNT
} sl_value_kind;

typedef struct sl_value {
    sl_value_kind kind;
    const char *text;
    double real;
    uint64_t count;
} sl_value;

typedef struct sl_compare_column {
    const char *name, *what;
    sl_value (*value)(const sl_comparison *comparison, const sl_compare_run *run);
} sl_compare_column;

const sl_compare_column *sl_compare_columns(size_t *count);

#endif
