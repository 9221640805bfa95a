// Pictures: each kind of file, thresholds, scale, ROS' map.yaml, and what is refused.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "sightline/io.h"

#include <png.h>
#include <unistd.h>

static void assert_walls(const char *text, size_t size, double threshold, const char *expected) {
    sl_import_options options = sl_import_options_default();
    options.threshold = threshold;
    assert_walls_of(sli_map_read_image, &options, text, size, expected);
}

static void assert_refused(const char *text, size_t size, const char *message) {
    assert_refused_of(sli_map_read_image, NULL, text, size, SL_BAD_INPUT, message);
}

// The two lower pixels of the left column of 3 x 3, and the one in the upper right corner.
#define SHAPE                                                                                      \
    "wall 2 3 3 3\nwall 2 2 2 3\nwall 3 2 3 3\nwall 2 2 3 2\n"                                     \
    "wall 0 2 1 2\nwall 0 0 0 2\nwall 1 0 1 2\nwall 0 0 1 0\n"

static int compare_lines(const void *left, const void *right) {
    return strcmp(*(char *const *)left, *(char *const *)right);
}

/// The lines of a text in one order, whatever the order of the walls.
static void sort_lines(char *text) {
    char *lines[64], copy[4096];
    size_t count = 0;
    snprintf(copy, sizeof copy, "%s", text);
    for (char *line = strtok(copy, "\n"); line; line = strtok(NULL, "\n")) lines[count++] = line;
    qsort(lines, count, sizeof *lines, compare_lines);
    for (size_t i = 0; i < count; i++) text += sprintf(text, "%s\n", lines[i]);
}

static void assert_shape(const char *bytes, size_t size, double threshold, bool is) {
    sl_context *context = testing_context(NULL);
    sl_import_options options = sl_import_options_default();
    options.threshold = threshold;
    sl_map map = {0};
    assert_ok(context, sli_map_read_image(context, "f", bytes, size, &options, &map));
    char *text = map_walls_text(&map), expected[] = SHAPE;
    sort_lines(text + strlen("sightline 1\n"));
    sort_lines(expected);
    if (is)
        assert_string_equal(text + strlen("sightline 1\n"), expected);
    else
        assert_string_not_equal(text + strlen("sightline 1\n"), expected);
    free(text);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_portable(void **state) {
    (void)state;
    static const char bits[] = "P1 3 3\n001 100\n# a comment\n1 00";
    assert_shape(bits, sizeof bits - 1, 0, true);
    static const char packed[] = "P4\n3 3\n\x20\x80\x80";
    assert_shape(packed, sizeof packed - 1, 0, true);
    static const char grey[] = "P2\n# made by hand\n3 3 10\n9 9 4\n4 9 9\n4 9 9\n";
    assert_shape(grey, sizeof grey - 1, 0, true);
    assert_shape(grey, sizeof grey - 1, 0.7, false);
    assert_shape(grey, sizeof grey - 1, 0.05, false);
    static const char bytes[] = "P5 3 3 255\n\xff\xff\x10\x10\xff\xff\x10\xff\xff";
    assert_shape(bytes, sizeof bytes - 1, 0, true);
    static const char wide[] = "P5 3 3 65535\n\xff.\xff.\x10.\x10.\xff.\xff.\x10.\xff.\xff.";
    assert_shape(wide, sizeof wide - 1, 0, true);
    // A colour is as dark as the mean of its channels: 127 is dark, 128 is not.
    static const char plain_colours[] = "P3 3 3 255 128 1 255  255 255 255  0 255 126\n"
                                        "0 127 254  9 255 255  255 128 2\n"
                                        "0 0 0  255 255 1  255 0 255\n";
    assert_shape(plain_colours, sizeof plain_colours - 1, 0, true);
    static const char colours[] = "P6 3 3 9\n\x9\x9\1\x9\x9\x9\1\x9\1"
                                  "\1\x9\1\x9\x9\x9\x9\1\x9"
                                  "\1\1\1\x9\x9\x9\x9\x9\1";
    assert_shape(colours, sizeof colours - 1, 0, true);
    assert_walls("P1 2 2 00 00", 12, 0, "");
}

static void test_png(void **state) {
    (void)state;
    // Grey with alpha: what is transparent is white, however dark.
    static const unsigned char pixels[] = {255, 255, 0, 0,   0,   255, 20,  255, 255,
                                           255, 90,  0, 100, 255, 255, 255, 200, 255};
    png_image image = {
        .version = PNG_IMAGE_VERSION, .width = 3, .height = 3, .format = PNG_FORMAT_GA};
    char bytes[1024];
    png_alloc_size_t size = sizeof bytes;
    assert_true(png_image_write_to_memory(&image, bytes, &size, 0, pixels, 0, NULL));
    assert_shape(bytes, size, 0, true);
    assert_refused(bytes, size - 20, "f: PNG: ");
    assert_refused(bytes, 20, "f: PNG: ");
    bytes[20] ^= 1;
    assert_refused(bytes, size, "f: PNG: ");
}

static void test_refused(void **state) {
    (void)state;
#define REFUSED(text, message) assert_refused(text, sizeof(text) - 1, message)
    REFUSED("", "f: neither PNG nor");
    REFUSED("RIFF\1\1\1\1WEBPVP8 ", "f: a WebP picture, whatever its name says: save it as PNG");
    REFUSED("\xFF\xD8\xFF\xE0", "f: a JPEG picture");
    REFUSED("BM\1", "f: a BMP picture");
    REFUSED("P7 1 1 1 0 0 0", "f: neither PNG nor");
    REFUSED("P6\n3 3 255\n\1\2", "f: 3 x 3 pixels need 27 bytes; the file has 2");
    REFUSED("P5 3", "f:1: expected a number, found the end");
    REFUSED("P5 3 x", "f:1: expected a number, found something else");
    REFUSED("P5\n3 3 255\n\1\2", "f: 3 x 3 pixels need 9 bytes; the file has 2");
    REFUSED("P5 0 3 255\n", "f: a picture without pixels");
    REFUSED("P5 3 3 0\n", "f:1: the largest value is 0");
    REFUSED("P5 3 3 70000\n", "f:1: the largest value is 70000");
    REFUSED("P2\n1 1\n7 8", "f:3: a pixel of 8: at most 7");
    REFUSED("P5 100000 100000 255\n",
            "f: 100000 x 100000 pixels need at least 1250000000 bytes; the file has 1");
    REFUSED("P5 99999999999999999999999 1 255\n", "f:1: a number is too large: over 16777216");
    REFUSED("P2\n1 1 255\n167772160", "f:3: a number is too large");
}

// --- ROS

/// A picture of an obstacle, unknown ground and free ground.
static void read_ros(const char *yaml, double threshold, const char *expected,
                     const char *message) {
    char folder[] = "/tmp/sightline-ros-XXXXXX", path[64], picture[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/m.yaml", folder);
    snprintf(picture, sizeof picture, "%s/m.pgm", folder);
    import_write_file(picture, "P2 3 1 255 0 205 254");
    sl_context *context = testing_context(NULL);
    sl_import_options options = sl_import_options_default();
    options.threshold = threshold;
    sl_map map = {0};
    const sl_status status = sli_map_read_ros(context, path, yaml, strlen(yaml), &options, &map);
    if (expected) {
        assert_ok(context, status);
        char *text = map_walls_text(&map);
        sort_lines(text);
        assert_string_equal(text, expected);
        free(text);
    } else {
        assert_int_equal(status, SL_BAD_INPUT);
        if (!strstr(sl_context_message(context), message))
            fail_msg("'%s' has not '%s'", sl_context_message(context), message);
        assert_int_equal(map.wall_count, 0);
    }
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    unlink(picture);
    assert_int_equal(rmdir(folder), 0);
}

static void test_ros(void **state) {
    (void)state;
    char obstacle[] = "sightline 1\nwall -0.5 2 -0.5 2.5\nwall -1 2 -0.5 2\n"
                      "wall -1 2 -1 2.5\nwall -1 2.5 -0.5 2.5\n";
    char free_ground[] = "sightline 1\nwall 0 2 0 2.5\nwall 0 2 0.5 2\n"
                         "wall 0.5 2 0.5 2.5\nwall 0 2.5 0.5 2.5\n";
    sort_lines(obstacle);
    sort_lines(free_ground);
    // Unknown ground is solid, unless a threshold takes it as free.
    const char *yaml = "image: m.pgm\nresolution: 0.5\norigin: [-1, 2, 0.0]\nnegate: 0\n"
                       "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    read_ros(yaml, 0, free_ground, NULL);
    read_ros(yaml, 0.65, obstacle, NULL);
    // Grey 205 is unknown to those who write such pictures, also beside a threshold over it.
    const char *newer = "image: m.pgm\nresolution: 0.5\norigin: [-1, 2, 0.0]\nnegate: 0\n"
                        "mode: trinary\noccupied_thresh: 0.65\nfree_thresh: 0.25\n";
    read_ros(newer, 0, free_ground, NULL);
    read_ros(newer, 0.25, obstacle, NULL);
    // Renamed, and in another style.
    read_ros("{image: other.pgm, resolution: 0.5, origin: [-1, 2, 0], mode: trinary}", 0,
             free_ground, NULL);
    // Negated, light pixels are the dark ones: none is dark enough here.
    read_ros("image: m.pgm\nresolution: 1\nnegate: 1\n", 1, "sightline 1\n", NULL);
    read_ros("image: m.pgm\n", 0, NULL, "m.yaml: 'resolution' is missing or not positive");
    read_ros("resolution: 1\n", 0, NULL, "m.yaml: no 'image' is named");
    read_ros("image: m.pgm\nresolution: thin\n", 0, NULL,
             "m.yaml:2: resolution: expected a number");
    // Turned about the origin, by a quarter as far as the digits go.
    char quarter[] = "sightline 1\nwall -1 2 -1 2.5\nwall -1 2 -1.5 2\n"
                     "wall -1 2.5 -1.5 2.5\nwall -1.5 2 -1.5 2.5\n";
    sort_lines(quarter);
    read_ros("image: m.pgm\nresolution: 0.5\norigin: [-1, 2, 1.5707963]\n", 0.65, quarter, NULL);
    // Occupied comes before free: what lies over both thresholds is an obstacle.
    char both[] = "sightline 1\nwall -0.5 2 -0.5 2.5\nwall -0.5 2 0.5 2\n"
                  "wall -0.5 2.5 0.5 2.5\nwall 0.5 2 0.5 2.5\n";
    sort_lines(both);
    read_ros("image: m.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\noccupied_thresh: 0.5\n"
             "free_thresh: 1\n",
             0, both, NULL);
    // Thresholds of 0 cannot be meant, but an occupied_thresh of 0 takes what is white as free.
    read_ros("image: m.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\noccupied_thresh: 0\n"
             "free_thresh: 0\n",
             0, free_ground, NULL);
    read_ros("image: m.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\noccupied_thresh: 0\n"
             "negate: 1\n",
             0, obstacle, NULL);
    read_ros("image: m.pgm\nresolution: 1\noccupied_thresh: 65\n", 0, NULL,
             "m.yaml:3: occupied_thresh: expected a number from 0 to 1, found '65'");
    read_ros("image: m.pgm\nresolution: 1\nfree_thresh: -0.1\n", 0, NULL,
             "m.yaml:3: free_thresh: expected a number from 0 to 1");
    for (const char *const *origin = (const char *const[]){"7", "", "[]", "[0]", "[0, 1]", NULL};
         *origin; origin++) {
        char wrong[100];
        snprintf(wrong, sizeof wrong, "image: m.pgm\nresolution: 1\norigin: %s\n", *origin);
        read_ros(wrong, 0, NULL, "m.yaml:3: origin: expected [x, y, yaw]");
    }
    read_ros("image: m.pgm\nresolution: 1\norigin: [0, 0, 1e9]\n", 0, NULL,
             "m.yaml:3: origin: the yaw is no angle");
    read_ros("image: m.pgm\nresolution: 1\norigin: [0, 0, 0, 0]\n", 0, NULL,
             "m.yaml:3: origin: more");
    read_ros("image: [m.pgm\n", 0, NULL, "m.yaml:2: YAML: ");
    read_ros("image: {a: b}\n", 0, NULL, "m.yaml:1: expected 'key: value'");
    read_ros("image: m.pgm\nresolution: 1\nmode: raw\n", 0, NULL, "m.yaml:3: mode: only trinary");
    read_ros("image: m.pgm\nresolution: 1\nmode: Scale\n", 0, NULL, "m.yaml:3: mode: only trinary");
}

static void test_ros_without_a_picture(void **state) {
    (void)state;
    static const char yaml[] = "resolution: 1\nimage: /nowhere/m.pgm\n";
    assert_refused_of(sli_map_read_ros, NULL, yaml, sizeof yaml - 1, SL_BAD_INPUT,
                      "f:2: image: there is no picture '/nowhere/m.pgm'");
    static const char device[] = "resolution: 1\nimage: /dev/zero\n";
    assert_refused_of(sli_map_read_ros, NULL, device, sizeof device - 1, SL_BAD_INPUT,
                      "f:2: image: there is no picture '/dev/zero'");
}

/// The place that a start is proposed in, in a picture. It is looked for only then.
static sl_point likely_start(const char *picture) {
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    const sl_import_options options = sl_import_options_default();
    const sl_clean_options clean = sl_clean_options_default();
    sl_map map = {0};
    sl_point at;
    assert_ok(context, sli_map_read_image(context, "f", picture, strlen(picture), &options, &map));
    assert_ok(context, sl_map_clean(context, &map, &clean, NULL));
    assert_ok(context, sl_map_find_inside(context, &map, &clean, NULL));
    assert_true(isnan(map.interior.roomiest.x));
    assert_ok(context, sl_map_find_roomiest(context, &map, &at));
    assert_int_equal(map.interior.place_count, 0);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
    return at;
}

/// A plan with two rooms, each with a door to a yard that is open at its top. A start is in a room,
/// and not in the roomier yard; nor in a roomier shut room, as the two have more area together.
static void test_likely_start(void **state) {
    (void)state;
    static const char *const pictures[] = {"P1 17 9\n"
                                           "00000000000000000\n"
                                           "01111100000111110\n"
                                           "01000100000100010\n"
                                           "01000100000100010\n"
                                           "01000000000000010\n"
                                           "01000100000100010\n"
                                           "01000100000100010\n"
                                           "01111111111111110\n"
                                           "00000000000000000\n",
                                           "P1 24 9\n"
                                           "000000000000000000000000\n"
                                           "011111000001111101111110\n"
                                           "010001000001000101000010\n"
                                           "010001000001000101000010\n"
                                           "010000000000000101000010\n"
                                           "010001000001000101000010\n"
                                           "010001000001000101000010\n"
                                           "011111111111111101111110\n"
                                           "000000000000000000000000\n"};
    for (int i = 0; i < 2; i++) {
        const sl_point at = likely_start(pictures[i]);
        assert_true((at.x > 2 && at.x < 5) || (at.x > 12 && at.x < 15));
        assert_true(at.y > 2 && at.y < 8);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_portable),
        cmocka_unit_test(test_png),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_ros),
        cmocka_unit_test(test_ros_without_a_picture),
        cmocka_unit_test(test_likely_start),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
