// The JSON writer against jansson, byte for byte; and the checksum against zlib.
#include "testing.h"

#include "base/base.h"
#include "sightline/json.h"
#include "sightline/support.h"

#include <jansson.h>
#include <math.h>
#include <zlib.h>

typedef struct written {
    char text[4096];
    size_t size;
} written;

static void keep(void *user, const char *text, size_t size) {
    written *to = user;
    assert_true(to->size + size < sizeof to->text);
    memcpy(to->text + to->size, text, size);
    to->size += size;
    to->text[to->size] = '\0';
}

static void assert_same(json_t *value, size_t flags, const char *text) {
    char *expected = json_dumps(value, flags | JSON_ENCODE_ANY);
    assert_non_null(expected);
    assert_string_equal(text, expected);
    free(expected);
    json_decref(value);
}

static void numbers(void **state) {
    (void)state;
    static const double some[] = {0, -0.0, 1, -1, 0.1, 1e15, 1e16, 1e17, 1e22, 1e-5, 5e-324, 1e300};
    const size_t count = sizeof some / sizeof *some;
    sl_random random = {1};
    for (size_t i = 0; i < 20000; i++) {
        const uint64_t bits = sl_random_next(&random);
        double value;
        memcpy(&value, &bits, sizeof value);
        if (i < count) value = some[i];
        if (!isfinite(value)) continue;
        written out = {.size = 0};
        sl_json_writer json = {.put = keep, .user = &out};
        sl_json_put_real(&json, value);
        // Since 2.15 jansson writes as few digits as tell numbers apart.
        if (JANSSON_VERSION_HEX < 0x020f00) assert_same(json_real(value), 0, out.text);
        json_t *back = json_loads(out.text, JSON_DECODE_ANY, NULL);
        assert_true(json_is_real(back) && json_real_value(back) == value);
        json_decref(back);
        assert_false(json.failed);
    }
    written out = {.size = 0};
    sl_json_writer json = {.put = keep, .user = &out};
    sl_json_put_real(&json, HUGE_VAL);
    assert_true(json.failed);
}

static void put_all(sl_json_writer *json) {
    sl_json_put_object(json);
    sl_json_put_key(json, "none");
    sl_json_put_null(json);
    sl_json_put_key(json, "list");
    sl_json_put_list(json);
    sl_json_put_list(json);
    sl_json_put_end(json, ']');
    sl_json_put_object(json);
    sl_json_put_end(json, '}');
    sl_json_put_integer(json, INT64_MIN);
    sl_json_put_flag(json, true);
    sl_json_put_end(json, ']');
    sl_json_put_key(json, "key \"\\");
    sl_json_put_text(json, "a/\x01\x1f\x7f\b\f\n\r\t\"\\ \xc3\xa9\xf0\x9f\x98\x80");
    sl_json_put_end(json, '}');
}

static json_t *make_all(void) {
    json_t *list = json_array(), *all = json_object();
    json_array_append_new(list, json_array());
    json_array_append_new(list, json_object());
    json_array_append_new(list, json_integer(INT64_MIN));
    json_array_append_new(list, json_true());
    json_object_set_new(all, "none", json_null());
    json_object_set_new(all, "list", list);
    json_object_set_new(all, "key \"\\",
                        json_string("a/\x01\x1f\x7f\b\f\n\r\t\"\\ \xc3\xa9\xf0\x9f\x98\x80"));
    return all;
}

static void layouts(void **state) {
    (void)state;
    written compact = {.size = 0};
    sl_json_writer json = {.put = keep, .user = &compact};
    put_all(&json);
    assert_same(make_all(), JSON_COMPACT, compact.text);
    for (unsigned indent = 1; indent < 5; indent++) {
        written out = {.size = 0}, again = {.size = 0};
        json = (sl_json_writer){.put = keep, .user = &out, .indent = indent};
        put_all(&json);
        assert_same(make_all(), JSON_INDENT(indent), out.text);
        // What was written without blanks gets them.
        json = (sl_json_writer){.put = keep, .user = &again, .indent = indent};
        sl_json_put_written(&json, compact.text, compact.size);
        assert_string_equal(again.text, out.text);
    }
}

static void utf8(void **state) {
    (void)state;
    sl_random random = {2};
    for (int i = 0; i < 200000; i++) {
        static const unsigned char bytes[] = {'a',  0x7f, 0x80, 0x8f, 0x90, 0x9f, 0xa0, 0xbf, 0xc0,
                                              0xc2, 0xdf, 0xe0, 0xed, 0xef, 0xf0, 0xf4, 0xf5, 0xff};
        char text[6] = "";
        for (int k = 0; k < 5; k++) text[k] = (char)bytes[sl_random_below(&random, sizeof bytes)];
        json_t *value = json_string(text);
        assert_int_equal(sl_text_is_utf8(text), value != NULL);
        json_decref(value);
    }
}

static void checksum(void **state) {
    (void)state;
    unsigned char bytes[300];
    sl_random random = {3};
    for (size_t i = 0; i < sizeof bytes; i++) bytes[i] = (unsigned char)sl_random_next(&random);
    for (size_t count = 0; count <= sizeof bytes; count++) {
        const size_t first = (size_t)sl_random_below(&random, count + 1);
        sli_checksum sum;
        sli_checksum_begin(&sum);
        sli_checksum_add(&sum, bytes, first);
        sli_checksum_add(&sum, bytes + first, count - first);
        assert_int_equal(sli_checksum_value(&sum), crc32(0, bytes, (uInt)count));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers),
        cmocka_unit_test(layouts),
        cmocka_unit_test(utf8),
        cmocka_unit_test(checksum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
