// Tables of numbers: whatever is read has whole rows of finite numbers or empty fields, rows in the
// order of their lines, and reads back the same from its own numbers.
#include "fuzz.h"

#include "../../tools/inputs/number_table.h"

#include <math.h>

static void check_rows(const number_table *table) {
    FUZZ_CHECK(!table->rows || table->columns);
    for (size_t i = 0; i < table->rows; i++) {
        FUZZ_CHECK(i == 0 || table->lines[i] > table->lines[i - 1]);
        for (size_t k = 0; k < table->columns; k++) {
            const double value = number_table_at(table, i, k);
            FUZZ_CHECK(isnan(value) || isfinite(value));
        }
    }
    for (size_t k = 0; table->names && k < table->columns; k++)
        FUZZ_CHECK(number_table_column(table, table->names[k]) <= k);
}

/// The table as text, for free(): numbers alone, and a word for each name.
static char *text_of(const number_table *table) {
    char *text = NULL, number[SL_NUMBER_TEXT];
    size_t size;
    FILE *out = open_memstream(&text, &size);
    FUZZ_CHECK(out);
    for (size_t k = 0; table->names && k < table->columns; k++)
        fprintf(out, "%sname%zu", k ? "," : "", k);
    if (table->names) putc('\n', out);
    for (size_t i = 0; i < table->rows; i++) {
        for (size_t k = 0; k < table->columns; k++) {
            const double value = number_table_at(table, i, k);
            number[0] = '\0';
            if (!isnan(value)) sl_number_write(value, number);
            fprintf(out, "%s%s", k ? "," : "", isnan(value) && !k ? "\"\"" : number);
        }
        putc('\n', out);
    }
    FUZZ_CHECK(fclose(out) == 0);
    return text;
}

static void read_back(sl_context *context, const number_table *table) {
    number_table back;
    char *text = text_of(table);
    FUZZ_CHECK(number_table_parse(context, "back", text, strlen(text), &back) == SL_OK);
    FUZZ_CHECK(back.rows == table->rows);
    FUZZ_CHECK(!table->rows || back.columns == table->columns);
    for (size_t i = 0; i < table->rows * table->columns; i++)
        FUZZ_CHECK(back.values[i] == table->values[i] ||
                   (isnan(back.values[i]) && isnan(table->values[i])));
    number_table_destroy(context, &back);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    number_table table;
    char *text = malloc(size + 1); // a 0 stands behind a file that is read
    FUZZ_CHECK(text);
    if (size) memcpy(text, data, size);
    text[size] = '\0';
    (void)number_table_begins(text, size, 4);
    const sl_status status = number_table_parse(context, "input", text, size, &table);
    if (status == SL_OK) {
        check_rows(&table);
        read_back(context, &table);
        number_table_destroy(context, &table);
    } else {
        FUZZ_CHECK(status == SL_BAD_INPUT && !table.values && !table.names && !table.columns);
        FUZZ_CHECK(strncmp(sl_context_message(context), "input:", 6) == 0);
    }
    free(text);
    sl_context_destroy(context);
    return 0;
}
