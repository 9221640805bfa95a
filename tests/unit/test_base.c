/// Numbers as text, files, threads.
#include "testing.h"

#include "sightline/support.h"
#include "sightline/version.h"

#include <math.h>
#include <sched.h>
#include <stdatomic.h>
#include <sys/stat.h>
#include <unistd.h>

static void one_version_everywhere(void **state) {
    (void)state;
    char text[64];
    snprintf(text, sizeof text, "%d.%d.%d", SL_VERSION_MAJOR, SL_VERSION_MINOR, SL_VERSION_PATCH);
    assert_string_equal(SL_VERSION, text);
    assert_string_equal(sl_version(), text);
    assert_string_equal(SIGHTLINE_PROJECT_VERSION, text); // what CMake read
}

static void numbers_read_back_to_the_same_double(void **state) {
    (void)state;
    sl_random random = {1};
    for (int i = 0; i < 200000; i++) {
        const uint64_t bits = sl_random_next(&random);
        double value, back;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value)) continue;
        char text[SL_NUMBER_TEXT];
        sl_number_write(value, text);
        assert_true(sl_number_read(text, strlen(text), &back));
        assert_memory_equal(&value, &back, sizeof value);
    }
}

static void numbers_are_short(void **state) {
    (void)state;
    const struct {
        double value;
        const char *text;
    } cases[] = {{0, "0"},       {0.1, "0.1"},      {1040, "1040"},
                 {-2.5, "-2.5"}, {1e150, "1e+150"}, {1.0 / 3, "0.3333333333333333"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[SL_NUMBER_TEXT];
        sl_number_write(cases[i].value, text);
        assert_string_equal(text, cases[i].text);
    }
}

/// Numbers are those of printf, 15 to 17 digits: the first text that reads back.
static void check_number(double value) {
    char text[SL_NUMBER_TEXT], expected[SL_NUMBER_TEXT];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(expected, sizeof expected, "%.*g", digits, value);
        if (strtod(expected, NULL) == value) break;
    }
    sl_number_write(value, text);
    assert_string_equal(text, expected);
}

static void numbers_are_those_of_printf(void **state) {
    (void)state;
    sl_random random = {2};
    const double wholes[] = {0, 1e-5, 1e-4, 1, 10, 1e14, 1e15, 1e16, 0x1p49, 0x1p50};
    for (size_t i = 0; i < sizeof wholes / sizeof *wholes; i++) {
        check_number(wholes[i]);
        check_number(nextafter(wholes[i], 0));
        check_number(-nextafter(wholes[i], INFINITY));
        check_number(-wholes[i]);
    }
    for (int exponent = -20; exponent <= 55; exponent++) { // steps between doubles change here
        check_number(ldexp(1, exponent));
        check_number(nextafter(ldexp(1, exponent), 0));
    }
    for (int i = 0; i < 300000; i++) {
        const double unit = sl_random_unit(&random);
        const int exponent = (int)sl_random_below(&random, 70) - 16;
        check_number(ldexp(unit, exponent));
        check_number(-round(unit * 1e6) / pow(10, (double)(i % 9))); // few digits
        check_number(round(unit * 0x1p53) / 0x1p8);                  // ties between 15 digits
    }
}

static void only_decimals_are_numbers(void **state) {
    (void)state;
    const char *good[] = {"0", "-0", "+1", "1.", ".5", "1e3", "1E-3", "00012", "1e999"};
    const char *bad[] = {"",    "nan", "inf", "-inf", "infinity", "0x10", "1e", "1e+", ".",
                         "1,5", "1 ",  " 1",  "--1",  "1.2.3",    "e5",   "1f", "1_0"};
    double value;
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        assert_true(sl_number_read(good[i], strlen(good[i]), &value));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        if (sl_number_read(bad[i], strlen(bad[i]), &value)) fail_msg("'%s' was read", bad[i]);
}

/// The first line of a table decides what stands between fields, and so what a comma is.
static void numbers_of_tables(void **state) {
    (void)state;
    static const struct {
        const char *line;
        char separator;
    } lines[] = {{"1,2", ','}, {"3,5;4", ';'},    {"3,5\t4", '\t'},
                 {"3.5", ','}, {"a\tb,c;d", ';'}, {"", ','}};
    double value;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        assert_int_equal(sl_table_separator(lines[i].line, strlen(lines[i].line)),
                         lines[i].separator);
    assert_true(sl_table_number_read(';', "3,5", 3, &value) && value == 3.5);
    assert_true(sl_table_number_read('\t', "-3.5e1", 6, &value) && value == -35);
    assert_true(sl_table_number_read(',', "3.5", 3, &value) && value == 3.5);
    assert_false(sl_table_number_read(',', "3,5", 3, &value));
    assert_false(sl_table_number_read(';', "3,5,1", 5, &value));
    assert_false(sl_table_number_read(';', "3,5.1", 5, &value));
    assert_false(sl_table_number_read(';', "", 0, &value));
}

static void a_failed_write_leaves_the_old_file(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    char folder[] = "/tmp/sightline-test-XXXXXX";
    assert_non_null(mkdtemp(folder));
    char path[64];
    snprintf(path, sizeof path, "%s/file", folder);
    for (int round = 0; round < 2; round++) {
        sl_output output;
        assert_ok(context, sl_output_open(context, path, &output));
        fputs(round ? "second, given up" : "first", output.stream);
        const sl_status status = sl_output_close(context, &output, round ? SL_CANCELLED : SL_OK);
        assert_int_equal(status, round ? SL_CANCELLED : SL_OK);
    }
    sl_bytes bytes;
    assert_ok(context, sl_file_read(context, path, &bytes));
    assert_string_equal(bytes.data, "first");
    sl_free(context, bytes.data);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(folder), 0); // nothing else was left there
    sl_context_destroy(context);
}

static void a_file_larger_than_memory_is_refused_unread(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    char path[] = "/tmp/sightline-test-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    const uint64_t size = sl_machine_memory() / 4 + 1;
    const bool large = size < SIZE_MAX / 2 && ftruncate(descriptor, (off_t)size) == 0;
    assert_int_equal(close(descriptor), 0);
    sl_bytes bytes;
    const sl_status status = large ? sl_file_read(context, path, &bytes) : SL_BAD_INPUT;
    assert_int_equal(unlink(path), 0);
    assert_int_equal(status, SL_BAD_INPUT);
    if (large) assert_non_null(strstr(sl_context_message(context), "has more than the "));
    sl_context_destroy(context);
    if (!large) skip(); // files here, or addresses, cannot be as large
}

static void trying_an_output_leaves_nothing(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    char folder[] = "/tmp/sightline-test-XXXXXX";
    assert_non_null(mkdtemp(folder));
    char path[64];
    snprintf(path, sizeof path, "%s/none/file", folder);
    assert_int_equal(sl_output_try(context, path), SL_IO);
    snprintf(path, sizeof path, "%s/file", folder);
    assert_ok(context, sl_output_try(context, path));
    assert_int_equal(sl_output_try(context, folder), SL_BAD_ARGUMENT);
    // Opening a pipe that nobody reads would wait, and closing it would end who does.
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_ok(context, sl_output_try(context, path));
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(folder), 0); // nothing was left there
    sl_context_destroy(context);
}

enum { UNITS = 1000 };

typedef struct counting_job {
    atomic_int done[UNITS];
    atomic_int begun, ended;
    size_t fails; ///< from this unit on; UNITS for none
} counting_job;

static sl_status begin_counting(sl_context *context, void *job, void **state) {
    (void)context;
    *state = job;
    atomic_fetch_add(&((counting_job *)job)->begun, 1);
    return SL_OK;
}

static void end_counting(sl_context *context, void *job, void *state) {
    (void)context;
    (void)state;
    atomic_fetch_add(&((counting_job *)job)->ended, 1);
}

static sl_status count_unit(sl_context *context, void *job, void *state, size_t unit) {
    counting_job *counting = job;
    assert_ptr_equal(job, state);
    if (unit >= counting->fails) return sl_fail(context, SL_BAD_INPUT, "unit %zu", unit);
    atomic_fetch_add(&counting->done[unit], 1);
    return SL_OK;
}

static void every_unit_of_work_is_done_once(void **state) {
    (void)state;
    for (unsigned threads = 1; threads <= 8; threads *= 2) {
        sl_context *context = testing_context(NULL);
        counting_job job = {.fails = UNITS};
        const sl_work work = {
            .job = &job, .begin = begin_counting, .unit = count_unit, .end = end_counting};
        assert_ok(context, sl_work_run(context, &work, UNITS, threads));
        for (size_t i = 0; i < UNITS; i++) assert_int_equal(job.done[i], 1);
        assert_int_equal(job.begun, job.ended);
        sl_context_destroy(context);
    }
}

static void the_first_failure_of_work_is_told(void **state) {
    (void)state;
    for (int round = 0; round < 100; round++) {
        sl_context *context = testing_context(NULL);
        counting_job job = {.fails = 500};
        const sl_work work = {
            .job = &job, .begin = begin_counting, .unit = count_unit, .end = end_counting};
        assert_int_equal(sl_work_run(context, &work, UNITS, 4), SL_BAD_INPUT);
        assert_string_equal(sl_context_message(context), "unit 500");
        assert_int_equal(job.begun, job.ended);
        sl_context_destroy(context);
    }
}

enum { TOGETHER = 3 };

/// Fails once all threads have a unit.
static sl_status fail_together(sl_context *context, void *job, void *state, size_t unit) {
    atomic_int *arrived = job;
    (void)state;
    atomic_fetch_add(arrived, 1);
    while (atomic_load(arrived) < TOGETHER) sched_yield();
    return sl_fail(context, SL_BAD_INPUT, "unit %zu", unit);
}

static void of_failures_that_of_the_lowest_unit_is_told(void **state) {
    (void)state;
    for (int round = 0; round < 100; round++) {
        sl_context *context = testing_context(NULL);
        atomic_int arrived = 0;
        const sl_work work = {.job = &arrived, .unit = fail_together};
        assert_int_equal(sl_work_run(context, &work, UNITS, TOGETHER), SL_BAD_INPUT);
        assert_string_equal(sl_context_message(context), "unit 0");
        sl_context_destroy(context);
    }
}

static void a_path_ends_in_a_name(void **state) {
    (void)state;
    assert_string_equal(sl_path_name("/maps/a.b/office.map"), "office.map");
    assert_string_equal(sl_path_name("office.map"), "office.map");
    assert_string_equal(sl_path_name("maps/"), "");
#ifdef _WIN32
    assert_string_equal(sl_path_name("C:\\maps/a.b\\office.map"), "office.map");
    assert_string_equal(sl_path_name("C:office.map"), "office.map");
#else
    assert_string_equal(sl_path_name("a/C:\\office.map"), "C:\\office.map");
#endif
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_version_everywhere),
        cmocka_unit_test(a_path_ends_in_a_name),
        cmocka_unit_test(numbers_read_back_to_the_same_double),
        cmocka_unit_test(numbers_of_tables),
        cmocka_unit_test(numbers_are_short),
        cmocka_unit_test(numbers_are_those_of_printf),
        cmocka_unit_test(only_decimals_are_numbers),
        cmocka_unit_test(a_failed_write_leaves_the_old_file),
        cmocka_unit_test(a_file_larger_than_memory_is_refused_unread),
        cmocka_unit_test(trying_an_output_leaves_nothing),
        cmocka_unit_test(every_unit_of_work_is_done_once),
        cmocka_unit_test(the_first_failure_of_work_is_told),
        cmocka_unit_test(of_failures_that_of_the_lowest_unit_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
