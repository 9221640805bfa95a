// DXF drawings as programs write them: faulty entities, binary files, code pages, clips.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "sightline/io.h"

#include <unistd.h>

#define HEAD                 "0\nSECTION\n2\nENTITIES\n"
#define TAIL                 "0\nENDSEC\n0\nEOF\n"
#define LINE(x0, y0, x1, y1) "0\nLINE\n8\nw\n10\n" #x0 "\n20\n" #y0 "\n11\n" #x1 "\n21\n" #y1 "\n"
#define GOOD                 LINE(0, 0, 4, 3)
#define WALL                 "wall 0 0 4 3\n"

// --- faulty entities

/// One entity behind a good one, from line 17 on.
static void assert_passed(const char *entity, const char *note) {
    char text[4096];
    snprintf(text, sizeof text, HEAD GOOD "%s" GOOD TAIL, entity);
    assert_noted_of(sli_map_read_dxf, NULL, text, strlen(text), WALL WALL, note);
}

static void test_faults(void **state) {
    (void)state;
    assert_passed("", "");
#define ONE(what) "f: passed over 1 faulty part: 1 " what
#define NUMBER    ONE("entity with a wrong number (line ")
#define MISSING   ONE("entity without a number that it needs (line 18)")
#define RADIUS    ONE("arc or circle without a radius (line 18)")
#define CORNERS   ONE("polyline of fewer than two corners (line 18)")
    assert_passed("0\nLINE\n10\nten\n20\n0\n11\n1\n21\n0\n", NUMBER "20)");
    assert_passed("0\nLINE\n10\n1e200\n20\n0\n11\n1\n21\n0\n", NUMBER "20)");
    assert_passed("0\nLINE\n10\n1\n20\n0\n11\n1\n", MISSING);
    assert_passed("0\nLINE\n67\nno\n", NUMBER "20)");
    assert_passed("0\nCIRCLE\n10\n5\n20\n5\n40\n0.0\n", RADIUS);
    assert_passed("0\nCIRCLE\n10\n5\n20\n5\n40\n-1\n", RADIUS);
    assert_passed("0\nARC\n10\n5\n20\n5\n40\n0\n50\n0\n51\n90\n", RADIUS);
    assert_passed("0\nARC\n10\n5\n20\n5\n40\n1\n50\n0\n", MISSING);
    assert_passed("0\nARC\n10\n5\n20\n5\n40\n1\n50\n0\n51\n1e90\n",
                  ONE("arc whose angles make no sense (line 18)"));
    assert_passed("0\nELLIPSE\n10\n5\n20\n5\n11\n0\n21\n0\n40\n1\n", ONE("ellipse without a size"));
    assert_passed("0\nELLIPSE\n10\n5\n20\n5\n11\n1\n21\n0\n40\n0\n", ONE("ellipse without a size"));
    assert_passed("0\nLWPOLYLINE\n90\n1\n70\n1\n10\n0\n20\n0\n", CORNERS);
    assert_passed("0\nPOLYLINE\n70\n1\n0\nSEQEND\n", CORNERS);
    // The good corners before the bad one are of the same wall: none of it is drawn.
    assert_passed("0\nLWPOLYLINE\n90\n3\n10\n0\n20\n0\n10\n1\n20\n0\n10\n2\n20\nx\n", NUMBER "32)");
    assert_passed("0\nLWPOLYLINE\n70\n1.5\n", NUMBER "20)");
    assert_passed("0\nSPLINE\n71\n3\n40\n0\n40\n1\n10\n0\n20\n0\n10\n1\n20\n0\n",
                  ONE("spline whose knots do not fit its points"));
    assert_passed("0\nINSERT\n2\nnone\n10\n0\n20\n0\n",
                  ONE("insertion of a block that is not there (line 18)"));
    assert_passed("0\nCIRCLE\n10\n9e149\n20\n0\n40\n9e149\n",
                  ONE("entity with a coordinate out of range"));
    assert_passed(
        "0\nCIRCLE\n10\n5\n20\n5\n40\n0\n0\nINSERT\n2\nnone\n0\nCIRCLE\n10\n5\n20\n5\n40\n0\n",
        "f: passed over 3 faulty parts: 2 arcs and circles without a radius (the first in "
        "line 18), 1 insertion of a block that is not there (line 26)");
}

/// A faulty entity of a block counts as often as it is drawn; the rest of the block stays.
static void test_faults_in_blocks(void **state) {
    (void)state;
    static const char text[] = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nb\n10\n0\n20\n0\n" LINE(
        0, 0, 1, 0) "0\nCIRCLE\n10\n0\n20\n0\n40\n0\n" LINE(0, 0, 0,
                                                            1) "0\nENDBLK\n0\nENDSEC\n" HEAD
                                                               "0\nINSERT\n2\nb\n10\n5\n20\n0\n0\nI"
                                                               "NSERT\n2\nb\n10\n9\n20\n0\n" TAIL;
    assert_noted_of(sli_map_read_dxf, NULL, text, sizeof text - 1,
                    "wall 5 0 6 0\nwall 5 0 5 1\nwall 9 0 10 0\nwall 9 0 9 1\n",
                    "2 arcs and circles without a radius (the first in line 26)");
}

/// What is doubtful about the whole file stays an error.
static void test_file_faults(void **state) {
    (void)state;
    const char *const cut = HEAD GOOD "0\nENDSEC\n";
    assert_refused_of(sli_map_read_dxf, NULL, cut, strlen(cut), SL_BAD_INPUT,
                      "f:18: the drawing ends without an EOF");
    const char *const open =
        HEAD "0\nLWPOLYLINE\n8\nsightline-solid\n10\n0\n20\n0\n10\n1\n20\n0\n" TAIL;
    assert_refused_of(sli_map_read_dxf, NULL, open, strlen(open), SL_BAD_INPUT,
                      "f:6: layer sightline-solid: expected a closed outline");
}

// --- binary files

static size_t put_bytes(char *to, uint64_t value, size_t bytes) {
    for (size_t i = 0; i < bytes; i++) to[i] = (char)(value >> (8 * i));
    return bytes;
}

static size_t put_real(char *to, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return put_bytes(to, bits, 8);
}

/// A drawing as the programs write it in binary; codes of two bytes, or as before release 13.
static size_t make_binary(const char *text, bool wide, char *to) {
    static const char begin[] = "AutoCAD Binary DXF\r\n\x1a";
    size_t size = sizeof begin;
    memcpy(to, begin, size);
    while (*text) {
        char *value, line[256];
        const unsigned code = (unsigned)strtoul(text, &value, 10);
        const size_t length = strcspn(++value, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, value);
        text = value + length + 1;
        if (!wide && code > 254) to[size++] = (char)0xff;
        size += put_bytes(to + size, code, wide || code > 254 ? 2 : 1);
        if ((code >= 10 && code <= 59) || (code >= 1010 && code <= 1059) ||
            (code >= 210 && code <= 239))
            size += put_real(to + size, strtod(line, NULL));
        else if ((code >= 60 && code <= 79) || code == 1070 || code / 10 == 28)
            size += put_bytes(to + size, (uint64_t)strtoll(line, NULL, 10), 2);
        else if ((code >= 90 && code <= 99) || code == 1071)
            size += put_bytes(to + size, (uint64_t)strtoll(line, NULL, 10), 4);
        else if (code / 10 == 16)
            size += put_bytes(to + size, (uint64_t)strtoll(line, NULL, 10), 8);
        else if (code / 10 == 29)
            to[size++] = (char)atoi(line);
        else if (code == 310 || code == 1004)
            size += put_bytes(to + size, 0x00ff0004, 1 + 4);
        else
            size += (size_t)snprintf(to + size, 256, "%s", line) + 1;
    }
    return size;
}

/// All kinds of values, and numbers that no short text has.
#define KINDS                                                                                      \
    "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n" HEAD                                 \
    "0\nLINE\n8\nw\n90\n-7\n160\n-8\n280\n1\n290\n1\n310\n00\n370\n-3\n420\n255\n10\n0.1\n20\n-"   \
    "1e-3\n11\n12345.678901234567\n21\n0.30000000000000004\n210\n0\n220\n0\n230\n1\n"              \
    "1000\ntext\n1004\n00\n1010\n1\n1070\n-1\n1071\n70000\n"                                       \
    "0\nLWPOLYLINE\n8\nw\n90\n3\n70\n1\n10\n0\n20\n0\n42\n0\n10\n4\n20\n0\n10\n4\n20\n2\n" TAIL

static void test_binary(void **state) {
    (void)state;
    // 5 units, each of the rounding of the largest number.
    static const char walls[] = "precision 2.741291394155924e-11\n"
                                "wall 0.1 -0.001 12345.678901234567 0.30000000000000004\n"
                                "wall 0 0 4 0\nwall 4 0 4 2\nwall 4 2 0 0\n";
    static const char text[] = "999\nby hand\n" KINDS;
    static char bytes[4096];
    // 370 and 420 are of two and of four bytes.
    for (int wide = 0; wide < 2; wide++) {
        for (int comment = 0; comment < 2; comment++) {
            char plain[2048];
            snprintf(plain, sizeof plain, "%s", comment ? text : KINDS);
            char *gone = strstr(plain, "370\n-3\n420\n255\n");
            memmove(gone, gone + 15, strlen(gone + 15) + 1);
            const size_t size = make_binary(plain, wide, bytes);
            assert_noted_of(sli_map_read_dxf, NULL, bytes, size, walls, "unit: metres");
            assert_walls_of(sli_map_read_dxf, NULL, plain, strlen(plain), walls);
            // Each file that is cut short is refused: it has no EOF, or ends within a value.
            for (size_t cut = sizeof "AutoCAD Binary DXF\r\n\x1a"; cut < size; cut++) {
                char *shorter = malloc(cut); // so that a sanitizer sees a step beyond
                assert_non_null(shorter);
                memcpy(shorter, bytes, cut);
                assert_refused_of(sli_map_read_dxf, NULL, shorter, cut, SL_BAD_INPUT, "f");
                free(shorter);
            }
        }
    }
}

static void test_binary_faults(void **state) {
    (void)state;
    char bytes[1024];
    // The line is that of the text that the drawing would be.
    size_t size = make_binary(HEAD "0\nCIRCLE\n10\n1\n20\n1\n40\n0\n" GOOD TAIL, true, bytes);
    assert_noted_of(sli_map_read_dxf, NULL, bytes, size, WALL, "without a radius (line 6)");
    size = make_binary(HEAD "0\nLINE\n10\nnan\n20\n1\n11\n0\n21\n0\n" GOOD TAIL, true, bytes);
    assert_noted_of(sli_map_read_dxf, NULL, bytes, size, WALL, "wrong number (line 8)");
    // Only what has all first bytes is such a drawing.
    assert_refused_of(sli_map_read_dxf, NULL, "AutoCAD Binary DXF\r\n", 20, SL_BAD_INPUT,
                      "f:1: expected a group code");
}

// --- code pages

/// A drawing of this release and code page whose only layer has this name.
static void assert_layer(const char *version, const char *page, const char *name,
                         const char *expected) {
    char text[1024];
    snprintf(text, sizeof text,
             "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\n%s\n9\n$DWGCODEPAGE\n3\n%s\n0\nENDSEC\n" HEAD
             "0\nLINE\n8\n%s\n10\n0\n20\n0\n11\n4\n21\n3\n" TAIL,
             version, page, name);
    sl_context *context = testing_context(NULL);
    sl_drawing_layers layers = {0};
    assert_ok(context, sl_drawing_layers_dxf(context, "f", text, strlen(text), &layers));
    assert_int_equal(layers.count, 1);
    assert_string_equal(layers.items[0].name, expected);
    sl_drawing_layers_destroy(context, &layers);
    sl_context_destroy(context);
    sl_import_options options = sl_import_options_default();
    options.layers = expected;
    assert_walls_of(sli_map_read_dxf, &options, text, strlen(text), WALL);
}

static void test_code_pages(void **state) {
    (void)state;
    assert_layer("AC1015", "ANSI_1252", "W\xe4nde", "W\xc3\xa4nde");
    assert_layer("AC1015", "ansi_1252", "\x80", "\xe2\x82\xac");
    assert_layer("AC1018", "ANSI_1250", "\x8a\x9d", "\xc5\xa0\xc5\xa5");
    assert_layer("AC1018", "ANSI_1251", "\xd1\xf2\xe5\xed\xfb",
                 "\xd0\xa1\xd1\x82\xd0\xb5\xd0\xbd\xd1\x8b");
    assert_layer("AC1018", "ANSI_1253", "\xd4\xef\xdf", "\xce\xa4\xce\xbf\xce\xaf");
    assert_layer("AC1018", "ANSI_1254", "\xdd", "\xc4\xb0");
    assert_layer("AC1018", "ANSI_1255", "\xf7\xe9\xf8", "\xd7\xa7\xd7\x99\xd7\xa8");
    assert_layer("AC1018", "ANSI_1256", "\xcc\xcf", "\xd8\xac\xd8\xaf");
    assert_layer("AC1018", "ANSI_1257", "\xf0", "\xc5\xa1");
    assert_layer("AC1018", "ANSI_1258", "\xd2", "\xcc\x89");
    assert_layer("AC1018", "ANSI_1258", "\xd3", "\xc3\x93");
    // UTF-8 since release 2007, and where an older drawing has it all the same.
    assert_layer("AC1021", "ANSI_1252", "W\xc3\xa4nde", "W\xc3\xa4nde");
    assert_layer("AC1015", "ANSI_1252", "W\xc3\xa4nde", "W\xc3\xa4nde");
    assert_layer("AC1015", "ANSI_936", "\xe5\xa2\x99", "\xe5\xa2\x99");
    // No page, and one that nobody knows.
    assert_layer("AC1009", "", "W\xe4nde", "W\xc3\xa4nde");
    assert_layer("AC1009", "ASCII", "W\xe4nde", "W\xc3\xa4nde");
    assert_layer("AC1015", "KLINGON_7", "W\xe4nde", "W\xc3\xa4nde");
    // Escapes, in any release; what is none stays.
    assert_layer("AC1015", "ANSI_1252", "W\\U+00e4nde", "W\xc3\xa4nde");
    assert_layer("AC1027", "ANSI_1252", "\\U+58c1", "\xe5\xa3\x81");
    assert_layer("AC1027", "ANSI_1252", "\\U+D83D\\U+DEAA", "\xf0\x9f\x9a\xaa");
    assert_layer("AC1027", "ANSI_1252", "a\\U+D83D\\U+00g1\\U+12", "a\\U+D83D\\U+00g1\\U+12");
    assert_layer("AC1027", "ANSI_1252", "\\U+000A", "\\U+000A");
}

/// Pages of two bytes are those of libxml2, where it has them; else their characters are escaped.
static void assert_wide_layer(const char *page, const char *name, const char *utf8,
                              const char *escaped) {
    char text[1024], notes[4096] = "";
    snprintf(text, sizeof text,
             "0\nSECTION\n2\nHEADER\n9\n$DWGCODEPAGE\n3\n%s\n0\nENDSEC\n" HEAD
             "0\nLINE\n8\n%s\n10\n0\n20\n0\n11\n4\n21\n3\n" TAIL,
             page, name);
    const sl_hooks hooks = {.user = notes, .note = import_keep_notes};
    sl_context *context = sl_context_create(&hooks);
    assert_non_null(context);
    const sl_import_options options = sl_import_options_default();
    sl_drawing_layers layers = {0};
    sl_map map = {0};
    assert_ok(context, sl_drawing_layers_dxf(context, "f", text, strlen(text), &layers));
    assert_ok(context, sli_map_read_dxf(context, "f", text, strlen(text), &options, &map));
    const bool read = strcmp(layers.items[0].name, utf8) == 0;
    if (!read) assert_string_equal(layers.items[0].name, escaped);
    assert_true(read == !strstr(notes, "cannot be read here"));
    sl_map_destroy(context, &map);
    sl_drawing_layers_destroy(context, &layers);
    sl_context_destroy(context);
}

static void test_wide_code_pages(void **state) {
    (void)state;
    assert_wide_layer("ANSI_932", "\x95\xc7", "\xe5\xa3\x81", "\\M+195C7");
    assert_wide_layer("ANSI_936", "A\xc7\xbd", "A\xe5\xa2\x99", "A\\M+5C7BD");
    assert_wide_layer("ANSI_949", "\xba\xae", "\xeb\xb2\xbd", "\\M+3BAAE");
    assert_wide_layer("ANSI_950", "\xc0\xf0", "\xe7\x89\x86", "\\M+2C0F0");
    // No page is named: Japanese by its look. Curly quotes about a Western name are not.
    assert_wide_layer("ASCII", "\x95\xc7", "\xe5\xa3\x81", "\xe2\x80\xa2\xc3\x87");
    assert_wide_layer("ASCII", "\x92\xca\x82\xe8\x90\x63", "\xe9\x80\x9a\xe3\x82\x8a\xe8\x8a\xaf",
                      "\xe2\x80\x99\xc3\x8a\xe2\x80\x9a\xc3\xa8\x90\x63");
    assert_layer("AC1009", "ASCII", "\x93W\xe4nde\x94", "\xe2\x80\x9cW\xc3\xa4nde\xe2\x80\x9d");
    assert_layer("AC1009", "ASCII", "l\x92\xe9tage", "l\xe2\x80\x99\xc3\xa9tage");
    // The second byte of a character may be that of a backslash.
    assert_wide_layer("ANSI_932", "\x95\x5c", "\xe8\xa1\xa8", "\\M+1955C");
    // A byte alone is no character: all of the name is escaped, and that is said in notes alone.
    FILE *told = tmpfile();
    const int before = dup(STDERR_FILENO);
    assert_true(told && before >= 0 && dup2(fileno(told), STDERR_FILENO) >= 0);
    assert_wide_layer("ANSI_936", "\xc7", "", "\\M+500C7");
    assert_wide_layer("ANSI_936", "A\xff B", "", "A\\M+5FF20B");
    assert_true(dup2(before, STDERR_FILENO) >= 0);
    assert_int_equal(lseek(fileno(told), 0, SEEK_END), 0);
    assert_int_equal(close(before), 0);
    assert_int_equal(fclose(told), 0);
}

// --- clips

/// A block of a long line and a short one, inserted with a clip in its dictionary.
#define CLIPPED(insert, corners, rest)                                                             \
    "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nb\n10\n0\n20\n0\n" LINE(0, 1, 10, 1) LINE(4, 4, 5, 5)     \
        LINE(20, 0, 20,                                                                            \
             9) "0\nENDBLK\n0\nENDSEC\n" HEAD                                                      \
                "0\nINSERT\n2\nb\n102\n{ACAD_XDICTIONARY\n360\nA1\n102\n}\n" insert GOOD           \
                "0\nENDSEC\n0\nSECTION\n2\nOBJECTS\n"                                              \
                "0\nDICTIONARY\n5\nA1\n3\nACAD_FILTER\n360\nB2\n"                                  \
                "0\nDICTIONARY\n5\nB2\n3\nSPATIAL\n360\nC3\n"                                      \
                "0\nSPATIAL_FILTER\n5\nC3\n" corners "210\n0\n220\n0\n230\n1\n11\n0\n"             \
                "21\n0\n31\n0\n" rest TAIL
#define MATRIX(x, y)                                                                               \
    "40\n1\n40\n0\n40\n0\n40\n" #x "\n40\n0\n40\n1\n40\n0\n40\n" #y "\n40\n0\n40\n0\n40\n1\n40\n0" \
    "\n"
#define BOX "70\n2\n10\n2\n20\n0\n10\n6\n20\n8\n"

static void assert_clipped(const char *text, const char *walls, const char *note) {
    assert_noted_of(sli_map_read_dxf, NULL, text, strlen(text), walls, note);
}

static void test_clips(void **state) {
    (void)state;
    const char *const all = "wall 0 1 10 1\nwall 4 4 5 5\nwall 20 0 20 9\n" WALL;
    assert_clipped(
        CLIPPED("10\n0\n20\n0\n", BOX, "71\n1\n72\n0\n73\n0\n" MATRIX(0, 0) MATRIX(0, 0)),
        "wall 2 1 6 1\nwall 4 4 5 5\n" WALL, "");
    // The polygon goes with the block, and turns with it.
    assert_clipped(CLIPPED("10\n100\n20\n0\n50\n90\n", BOX, "71\n1\n" MATRIX(0, 0) MATRIX(0, 0)),
                   "wall 99 2 99 6\nwall 96 4 95 5\n" WALL, "");
    // It was made where the block was elsewhere: the first matrix leads back. The second one leads
    // from there to the polygon's own places. The distance of the front plane is no part of them.
    assert_clipped(CLIPPED("10\n0\n20\n0\n", "70\n2\n10\n102\n20\n0\n10\n106\n20\n8\n",
                           "71\n1\n72\n1\n40\n5\n73\n0\n" MATRIX(-100, 0) MATRIX(0, 0)),
                   "wall 2 1 6 1\nwall 4 4 5 5\n" WALL, "");
    assert_clipped(CLIPPED("10\n0\n20\n0\n", BOX, "71\n1\n" MATRIX(0, 0) MATRIX(-1, 0)),
                   "wall 3 1 7 1\nwall 4 4 5 5\n" WALL, "");
    // A polygon that shows a wall twice.
    assert_clipped(CLIPPED("10\n0\n20\n0\n",
                           "70\n8\n10\n1\n20\n0\n10\n2\n20\n0\n10\n2\n20\n3\n10\n4\n20\n3\n10\n4\n"
                           "20\n0\n10\n6\n20\n0\n10\n6\n20\n4.5\n10\n1\n20\n4.5\n",
                           "71\n1\n" MATRIX(0, 0) MATRIX(0, 0)),
                   "wall 1 1 2 1\nwall 4 1 6 1\nwall 4 4 4.5 4.5\n" WALL, "");
    // Switched off; hides its inside; not complete.
    assert_clipped(CLIPPED("10\n0\n20\n0\n", BOX, "71\n0\n" MATRIX(0, 0) MATRIX(0, 0)), all, "");
    assert_clipped(CLIPPED("10\n0\n20\n0\n", "102\n{ACAD_XDICTIONARY\n360\nD\n102\n}\n" BOX,
                           "71\n1\n" MATRIX(0, 0) MATRIX(0, 0)),
                   all, "clip whose inside is hidden");
    assert_clipped(CLIPPED("10\n0\n20\n0\n", BOX, "71\n1\n" MATRIX(0, 0)), all,
                   "clip that is not complete");
    assert_clipped(CLIPPED("10\n0\n20\n0\n", "10\n0\n20\nx\n", MATRIX(0, 0) MATRIX(0, 0)), all,
                   "clip that is not complete");
}

static void test_memory(void **state) {
    (void)state;
    assert_memory_of(sli_map_read_dxf, NULL,
                     CLIPPED("10\n0\n20\n0\n", BOX, "71\n1\n1\n\xe4\n" MATRIX(0, 0) MATRIX(0, 0)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_faults),        cmocka_unit_test(test_faults_in_blocks),
        cmocka_unit_test(test_file_faults),   cmocka_unit_test(test_binary),
        cmocka_unit_test(test_binary_faults), cmocka_unit_test(test_code_pages),
        cmocka_unit_test(test_clips),         cmocka_unit_test(test_wide_code_pages),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
