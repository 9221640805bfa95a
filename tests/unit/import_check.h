/// Short cuts for tests of importers: the walls that a text gives, and the message that it gets.
#ifndef SL_TEST_IMPORT_CHECK_H
#define SL_TEST_IMPORT_CHECK_H

#include "io/io_formats.h"
#include "map_same.h"

typedef sl_status import_reader(sl_context *context, const char *name, const char *text,
                                size_t size, const sl_import_options *options, sl_map *map);

/// The text's walls are those of the map text, its first line left out.
static inline void assert_walls_of(import_reader *read, const sl_import_options *options,
                                   const char *input, size_t size, const char *expected) {
    sl_context *context = testing_context(NULL);
    const sl_import_options usual = sl_import_options_default();
    sl_map map = {0};
    assert_ok(context, read(context, "f", input, size, options ? options : &usual, &map));
    char *text = map_walls_text(&map);
    assert_string_equal(text + strlen("sightline 1\n"), expected);
    free(text);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static inline void import_keep_notes(void *user, const char *message) {
    char *notes = user;
    const size_t used = strlen(notes);
    snprintf(notes + used, 4096 - used, "%s\n", message);
}

/// The text's walls are those of the map text, and what is said of it has this in it; "" for
/// nothing that was passed over.
static inline void assert_noted_of(import_reader *read, const sl_import_options *options,
                                   const char *input, size_t size, const char *expected,
                                   const char *note) {
    char notes[4096] = "";
    const sl_hooks hooks = {.user = notes, .note = import_keep_notes};
    sl_context *context = sl_context_create(&hooks);
    const sl_import_options usual = sl_import_options_default();
    sl_map map = {0};
    assert_non_null(context);
    assert_ok(context, read(context, "f", input, size, options ? options : &usual, &map));
    char *text = map_walls_text(&map);
    assert_string_equal(text + strlen("sightline 1\n"), expected);
    if (*note ? !strstr(notes, note) : strstr(notes, "passed over") != NULL)
        fail_msg("'%s' is not in '%s'", note, notes);
    free(text);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// The map that the text gives is in this unit, also when it is copied and clean.
static inline void assert_unit_of(import_reader *read, const sl_import_options *options,
                                  const char *input, const char *unit) {
    sl_context *context = testing_context(NULL);
    const sl_import_options usual = sl_import_options_default();
    sl_map map = {0}, copy = {0};
    assert_ok(context, read(context, "f", input, strlen(input), options ? options : &usual, &map));
    assert_ok(context, sl_map_copy(context, &map, &copy));
    assert_ok(context, sl_map_clean(context, &copy, NULL, NULL));
    assert_string_equal(map.unit, unit);
    assert_string_equal(copy.unit, unit);
    sl_map_destroy(context, &map);
    sl_map_destroy(context, &copy);
    assert_string_equal(map.unit, "");
    sl_context_destroy(context);
}

/// The text is refused, with a message that starts with `message`, and the map stays empty.
static inline void assert_refused_of(import_reader *read, const sl_import_options *options,
                                     const char *input, size_t size, sl_status status,
                                     const char *message) {
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    const sl_import_options usual = sl_import_options_default();
    const long live = memory.live;
    sl_map map = {0};
    assert_int_equal(read(context, "f", input, size, options ? options : &usual, &map), status);
    if (strncmp(sl_context_message(context), message, strlen(message)) != 0)
        fail_msg("'%s' is not '%s'", sl_context_message(context), message);
    assert_int_equal(map.wall_count, 0);
    assert_int_equal(memory.live, live);
    sl_context_destroy(context);
}

/// Each allocation of a reading fails once: nothing is left behind. The options may be NULL.
static inline void assert_memory_of(import_reader *read, const sl_import_options *options,
                                    const char *text) {
    const sl_import_options usual = sl_import_options_default();
    sl_status status = SL_NO_MEMORY;
    for (long fail_at = 1; status != SL_OK; fail_at++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        memory.fail_at = memory.calls + fail_at;
        sl_map map = {0};
        status = read(context, "f", text, strlen(text), options ? options : &usual, &map);
        if (status != SL_OK) assert_int_equal(status, SL_NO_MEMORY);
        if (status != SL_OK) assert_true(map_is_empty(&map));
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
        assert_true(fail_at >= 1 && fail_at <= 200);
    }
}

static inline void import_write_file(const char *path, const char *text) {
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(text, stream);
    assert_int_equal(fclose(stream), 0);
}

/// What is said of a DXF drawing, and how many walls it has.
static inline size_t import_noted_dxf(const char *text, const char *layers, char notes[4096]) {
    const sl_hooks hooks = {.user = notes, .note = import_keep_notes};
    sl_context *context = sl_context_create(&hooks);
    sl_import_options options = sl_import_options_default();
    sl_map map = {0};
    options.layers = layers;
    *notes = 0;
    assert_non_null(context);
    assert_ok(context, sli_map_read_dxf(context, "f", text, strlen(text), &options, &map));
    const size_t walls = map.wall_count;
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return walls;
}

#endif
