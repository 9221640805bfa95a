/// The writer of GeoJSON: form, closed rings, points that are there twice, shapes with holes.
#include "sightline/json.h"
#include "testing.h"

/// What is between the brackets of a collection. The caller frees it.
static char *written(void (*put)(sl_geojson_writer *out)) {
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    sl_geojson_writer out = sl_geojson_begin(stream, NULL);
    put(&out);
    sl_geojson_end(&out);
    assert_int_equal(fclose(stream), 0);
    const char lead[] = "{\"type\": \"FeatureCollection\", \"crs\": null, \"features\": [",
               tail[] = "]}\n";
    assert_memory_equal(text, lead, strlen(lead));
    assert_string_equal(text + size - strlen(tail), tail);
    text[size - strlen(tail)] = '\0';
    memmove(text, text + strlen(lead), strlen(text + strlen(lead)) + 1);
    return text;
}

static void assert_written(void (*put)(sl_geojson_writer *out), const char *expected) {
    char *text = written(put);
    assert_string_equal(text, expected);
    free(text);
}

static void put_none(sl_geojson_writer *out) {
    (void)out;
}

static void put_point_and_line(sl_geojson_writer *out) {
    sl_geojson_put_point(out, "start", (sl_point){1, -0.5});
    sl_geojson_add_text(out, "name", "a \"b\"");
    sl_geojson_add_flag(out, "open", true);
    sl_geojson_end_feature(out);
    sl_geojson_put_line(out, "wall", (sl_point){0, 0}, (sl_point){1e100, 3});
    sl_geojson_add_count(out, "count", 7);
    sl_geojson_add_real(out, "area", 2);
    sl_geojson_end_feature(out);
}

static void test_points_and_lines(void **state) {
    (void)state;
    assert_written(put_none, "");
    assert_written(
        put_point_and_line,
        "\n{\"type\":\"Feature\",\"geometry\":{\"type\":\"Point\",\"coordinates\":[1.0,-0.5]},"
        "\"properties\":{\"kind\":\"start\",\"name\":\"a \\\"b\\\"\",\"open\":true}},\n"
        "{\"type\":\"Feature\",\"geometry\":{\"type\":\"LineString\",\"coordinates\":"
        "[[0.0,0.0],[1e100,3.0]]},"
        "\"properties\":{\"kind\":\"wall\",\"count\":7,\"area\":2.0}}");
}

#define FEATURE(geometry)                                                                          \
    "\n{\"type\":\"Feature\",\"geometry\":" geometry ",\"properties\":{\"kind\":\"k\"}}"
#define POLYGON(rings) FEATURE("{\"type\":\"Polygon\",\"coordinates\":[" rings "]}")
#define CORNERS        "[[0.0,0.0],[4.0,0.0],[4.0,4.0],[0.0,0.0]]"

static const sl_point corners[] = {{0, 0}, {0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 0}};

static void put_repeated(sl_geojson_writer *out) {
    sl_geojson_put_polygon(out, "k", corners + 1, 5);
    sl_geojson_end_feature(out);
}

static void put_plain(sl_geojson_writer *out) {
    const sl_point plain[] = {{0, 0}, {4, 0}, {4, 4}};
    sl_geojson_put_polygon(out, "k", plain, 3);
    sl_geojson_end_feature(out);
}

static void put_flat(sl_geojson_writer *out) {
    sl_geojson_put_polygon(out, "k", corners, 4);
    sl_geojson_end_feature(out);
}

static void put_empty(sl_geojson_writer *out) {
    sl_geojson_put_polygon(out, "k", NULL, 0);
    sl_geojson_end_feature(out);
}

static void test_polygons(void **state) {
    (void)state;
    assert_written(put_plain, POLYGON(CORNERS));
    assert_written(put_repeated, POLYGON("[[4.0,0.0],[4.0,4.0],[0.0,0.0],[4.0,0.0]]"));
    assert_written(put_flat, FEATURE("null"));
    assert_written(put_empty, FEATURE("null"));
}

/// Three shapes: a polygon with a hole, two polygons, none.
static void put_shapes(sl_geojson_writer *out) {
    sl_point points[] = {{0, 0}, {4, 0}, {4, 4}, {3, 1}, {3, 2}, {3.5, 2}, {5, 5}, {6, 5}, {6, 6}};
    uint32_t rings[] = {0, 3, 6, 9, 12}, polygons[] = {0, 2, 3}, shapes[] = {0, 1, 2, 2};
    const sl_shapes some = {points, rings, polygons, shapes, 3};
    uint32_t both[] = {0, 2};
    const sl_shapes several = {points, rings, polygons, both, 1};
    for (uint32_t i = 0; i < some.count; i++) {
        sl_geojson_put_shape(out, "k", &some, i);
        sl_geojson_end_feature(out);
    }
    sl_geojson_put_shape(out, "k", &several, 0);
    sl_geojson_end_feature(out);
}

static void test_shapes(void **state) {
    (void)state;
#define HOLE  "[[3.0,1.0],[3.0,2.0],[3.5,2.0],[3.0,1.0]]"
#define OTHER "[[5.0,5.0],[6.0,5.0],[6.0,6.0],[5.0,5.0]]"
    assert_written(put_shapes,
                   POLYGON(CORNERS "," HOLE) "," POLYGON(OTHER) "," FEATURE("null") "," FEATURE(
                       "{\"type\":\"MultiPolygon\",\"coordinates\":[[" CORNERS "," HOLE "],[" OTHER
                       "]]}"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points_and_lines),
        cmocka_unit_test(test_polygons),
        cmocka_unit_test(test_shapes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
