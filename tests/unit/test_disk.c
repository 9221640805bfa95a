// What the system may refuse or cut short while a file is read or written: at every byte of a save
// the target is the old file or the new one, never neither, and nothing is left beside it. Reads
// come in pieces and are interrupted by signals.
//
// Sizes are limited by the system itself (RLIMIT_FSIZE). What it seldom refuses is refused here:
// the linker's --wrap puts calls of the library through the functions below. Only the C library of
// Linux has what that needs.
#include "testing.h"

#include "bake/export.h"
#include "io/io_formats.h"
#include "map/scan.h"
#include "sightline/bake.h"
#include "sightline/io.h"
#include "sightline/support.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

// --- calls that are refused

enum { FDOPEN, FSYNC, RENAME, FCLOSE, MKSTEMP, CALLS };
static const char *const names[CALLS] = {"fdopen", "fsync", "rename", "fclose", "mkstemp"};

/// The next so many calls fail, and why; `made` counts those that came here.
static struct { int times, reason, made; } refuse[CALLS];

static bool is_refused(int call) {
    refuse[call].made++;
    if (refuse[call].times <= 0) return false;
    refuse[call].times--;
    errno = refuse[call].reason;
    return true;
}

FILE *__real_fdopen(int descriptor, const char *mode);
FILE *__wrap_fdopen(int descriptor, const char *mode);
FILE *__wrap_fdopen(int descriptor, const char *mode) {
    return is_refused(FDOPEN) ? NULL : __real_fdopen(descriptor, mode);
}

int __real_fsync(int descriptor);
int __wrap_fsync(int descriptor);
int __wrap_fsync(int descriptor) {
    return is_refused(FSYNC) ? -1 : __real_fsync(descriptor);
}

int __real_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to) {
    return is_refused(RENAME) ? -1 : __real_rename(from, to);
}

/// It closes all the same, as the system does. Streams in memory have no number, and are passed by.
int __real_fclose(FILE *stream);
int __wrap_fclose(FILE *stream);
int __wrap_fclose(FILE *stream) {
    const bool refused = fileno(stream) >= 0 && is_refused(FCLOSE);
    const int reason = errno, closed = __real_fclose(stream);
    if (refused) errno = reason;
    return refused ? EOF : closed;
}

/// The name of mkstemp for files of any size: on machines of 32 bits it is another function.
int __real_mkstemp64(char *path);
int __wrap_mkstemp64(char *path);
int __wrap_mkstemp64(char *path) {
    return is_refused(MKSTEMP) ? -1 : __real_mkstemp64(path);
}

int __wrap_mkstemp(char *path);
int __wrap_mkstemp(char *path) {
    return __wrap_mkstemp64(path);
}

// --- a folder with an older file

static char folder[] = "/tmp/sightline-disk-XXXXXX";
static char target[64];
static const char older[] = "what was there before\n";

static int make_folder(void **state) {
    (void)state;
    signal(SIGXFSZ, SIG_IGN);
    assert_non_null(mkdtemp(folder));
    snprintf(target, sizeof target, "%s/target", folder);
    return 0;
}

static int remove_folder(void **state) {
    (void)state;
    remove(target);
    assert_int_equal(rmdir(folder), 0);
    return 0;
}

static void write_older(void) {
    FILE *stream = fopen(target, "wb");
    assert_non_null(stream);
    fputs(older, stream);
    assert_int_equal(__real_fclose(stream), 0);
}

/// The bytes of the target, for free(); nothing lies beside it.
static char *read_target(size_t *size) {
    FILE *stream = fopen(target, "rb");
    assert_non_null(stream);
    char *bytes = malloc(1 << 17);
    assert_non_null(bytes);
    *size = fread(bytes, 1, 1 << 17, stream);
    __real_fclose(stream);
    DIR *beside = opendir(folder);
    assert_non_null(beside);
    for (struct dirent *e; (e = readdir(beside));)
        if (e->d_name[0] != '.') assert_string_equal(e->d_name, "target");
    closedir(beside);
    return bytes;
}

static bool target_is(const void *bytes, size_t size) {
    size_t there = 0;
    char *found = read_target(&there);
    const bool same = there == size && memcmp(found, bytes, size) == 0;
    free(found);
    return same;
}

// --- saves

/// A map and what it bakes to.
typedef struct saved {
    sl_map map;
    sl_baked baked;
} saved;

static void make_saved(sl_context *context, saved *out) {
    static const char text[] =
        "sightline 1\nwalls 0 0 9 0 9 9 0 9 0 0\nwall 4 0 4 5\nstart 1 1 0\n";
    sl_map map = {0};
    *out = (saved){0};
    assert_ok(context, sl_io_use(context));
    assert_ok(context, sli_map_read_text(context, "t", text, sizeof text - 1, &out->map));
    assert_ok(context, sl_map_copy(context, &out->map, &map));
    assert_ok(context, sl_bake(context, &map, NULL, &out->baked, NULL));
}

static void free_saved(sl_context *context, saved *out) {
    sl_baked_destroy(context, &out->baked);
    sl_map_destroy(context, &out->map);
}

typedef sl_status save(sl_context *context, const saved *what);

static sl_status save_text(sl_context *context, const saved *what) {
    return sl_map_write(context, &what->map, NULL, target);
}

static sl_status save_baked(sl_context *context, const saved *what) {
    return sl_baked_write(context, &what->baked, target);
}

static sl_status save_json(sl_context *context, const saved *what) {
    const sl_export_options options = {0};
    return sli_export_json(context, &what->baked, &options, target);
}

static sl_status save_png(sl_context *context, const saved *what) {
    const sl_export_options options = {0};
    return sli_export_png(context, &what->baked, &options, target);
}

static save *const saves[] = {save_text, save_baked, save_json, save_png};
enum { SAVES = sizeof saves / sizeof *saves };

static void limit_files(rlim_t bytes) {
    struct rlimit limit;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    limit.rlim_cur = bytes == RLIM_INFINITY ? limit.rlim_max : bytes;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

static void a_save_may_end_at_any_byte(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    saved what;
    make_saved(context, &what);
    for (size_t i = 0; i < SAVES; i++) {
        size_t size = 0;
        write_older();
        assert_ok(context, saves[i](context, &what));
        char *whole = read_target(&size);
        // Under a sanitizer some of them.
        const size_t step = testing_seeds(size) == size ? 1 : size / 50 + 1;
        for (size_t at = 0; at < size; at += step) {
            write_older();
            limit_files(at);
            const sl_status status = saves[i](context, &what);
            limit_files(RLIM_INFINITY);
            assert_int_equal(status, SL_IO);
            assert_non_null(strstr(sl_context_message(context), "cannot write: File too large"));
            assert_true(target_is(older, strlen(older)));
        }
        limit_files(size);
        assert_ok(context, saves[i](context, &what));
        limit_files(RLIM_INFINITY);
        assert_true(target_is(whole, size));
        free(whole);
    }
    free_saved(context, &what);
    sl_context_destroy(context);
}

/// Each call on the way of a save fails once, as on a network or on a disk that fills late.
static void any_call_of_a_save_may_fail(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    saved what;
    make_saved(context, &what);
    memset(refuse, 0, sizeof refuse);
    write_older();
    assert_ok(context, save_baked(context, &what));
    if (!refuse[RENAME].made) {
        print_message("skipped: the library is linked where --wrap does not reach\n");
        skip();
    }
    for (size_t i = 0; i < SAVES; i++)
        for (int call = 0; call < CALLS; call++) {
            memset(refuse, 0, sizeof refuse);
            refuse[call].times = 1;
            refuse[call].reason = ENOSPC;
            write_older();
            const sl_status status = saves[i](context, &what);
            if (status != SL_IO) fail_msg("save %zu goes on though %s failed", i, names[call]);
            assert_int_equal(refuse[call].times, 0);
            assert_non_null(strstr(sl_context_message(context), "target: cannot write: No space"));
            assert_true(target_is(older, strlen(older)));
        }
    free_saved(context, &what);
    sl_context_destroy(context);
}

static void an_interrupted_fsync_is_asked_again(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    saved what;
    make_saved(context, &what);
    memset(refuse, 0, sizeof refuse);
    refuse[FSYNC].times = 3;
    refuse[FSYNC].reason = EINTR;
    write_older();
    assert_ok(context, save_text(context, &what));
    assert_false(target_is(older, strlen(older)));
    free_saved(context, &what);
    sl_context_destroy(context);
}

// --- reads

static void ignore(int number) {
    (void)number;
}

/// A signal each millisecond, whose handler lets system calls end early.
static void ring(bool on) {
    struct sigaction action = {.sa_handler = ignore};
    sigemptyset(&action.sa_mask);
    const struct itimerval often = {{0, 1000}, {0, 1000}}, never = {{0, 0}, {0, 0}};
    assert_int_equal(sigaction(SIGALRM, &action, NULL), 0);
    assert_int_equal(setitimer(ITIMER_REAL, on ? &often : &never, NULL), 0);
}

typedef struct feed {
    const char *path, *bytes;
    size_t size;
} feed;

static void rest(long milliseconds) {
    const struct timespec time = {.tv_nsec = milliseconds * 1000000};
    nanosleep(&time, NULL);
}

/// Opens the pipe late, and gives its bytes one at a time, now and then after a rest.
static void *feed_pipe(void *user) {
    const feed *f = user;
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, NULL);
    rest(20);
    const int pipe = open(f->path, O_WRONLY);
    if (pipe < 0) return NULL;
    for (size_t i = 0; i < f->size; i++) {
        if (i % 16 == 0) rest(3);
        if (write(pipe, f->bytes + i, 1) != 1) break;
    }
    close(pipe);
    return NULL;
}

static void a_read_comes_in_pieces_and_is_interrupted(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    char path[80], bytes[400];
    snprintf(path, sizeof path, "%s/pipe", folder);
    assert_int_equal(mkfifo(path, 0600), 0);
    for (size_t i = 0; i < sizeof bytes; i++) bytes[i] = (char)(i * 7);
    feed f = {path, bytes, sizeof bytes};
    pthread_t feeder;
    assert_int_equal(pthread_create(&feeder, NULL, feed_pipe, &f), 0);
    ring(true);
    sl_bytes out = {0};
    const sl_status status = sl_file_read(context, path, &out);
    ring(false);
    if (status != SL_OK) {
        // Lets the feeder end.
        const int end = open(path, O_RDONLY | O_NONBLOCK);
        pthread_join(feeder, NULL);
        close(end);
        remove(path);
        fail_msg("%s", sl_context_message(context));
    }
    pthread_join(feeder, NULL);
    assert_int_equal(out.size, sizeof bytes);
    assert_memory_equal(out.data, bytes, sizeof bytes);
    sl_free(context, out.data);
    remove(path);
    sl_context_destroy(context);
}

static bool is_over(void *user) {
    int *left = user;
    return --*left < 0;
}

/// Who waits for a pipe that no one opens can still be stopped.
static void waiting_for_a_pipe_is_cancelled(void **state) {
    (void)state;
    int left = 5;
    const sl_hooks hooks = {.user = &left, .cancelled = is_over};
    sl_context *context = sl_context_create(&hooks);
    char path[80];
    snprintf(path, sizeof path, "%s/pipe", folder);
    assert_int_equal(mkfifo(path, 0600), 0);
    sl_bytes out = {0};
    ring(true);
    const sl_status status = sl_file_read(context, path, &out);
    ring(false);
    assert_int_equal(status, SL_CANCELLED);
    assert_null(out.data);
    remove(path);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_save_may_end_at_any_byte),
        cmocka_unit_test(any_call_of_a_save_may_fail),
        cmocka_unit_test(an_interrupted_fsync_is_asked_again),
        cmocka_unit_test(a_read_comes_in_pieces_and_is_interrupted),
        cmocka_unit_test(waiting_for_a_pipe_is_cancelled),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
