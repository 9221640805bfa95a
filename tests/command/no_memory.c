/// Commands whose memory fails once: at their Nth allocation, or from there on. For each N a
/// command fails, or does as it does otherwise, and in both cases it leaves nothing behind.
///
/// The program is linked in. The linker (--wrap) begins with __wrap_main() in place of its main().
/// It sends calls for memory, of the program and of our libraries, to the functions below; other
/// libraries keep theirs.
#include "testing.h"

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

int __real_main(int argc, char **argv); // the program's
int __wrap_main(void);

enum { BLOCKS_MOST = 1 << 16, WORDS_MOST = 16 };

/// What the program holds. At file scope: functions for memory are given no more than a size.
static struct {
    pthread_mutex_t lock;
    void *blocks[BLOCKS_MOST];
    size_t count;
    long calls, fail_at;
    bool once;
    long leaks_at; ///< the first failure after which blocks were left; 0: none
} memory = {.lock = PTHREAD_MUTEX_INITIALIZER, .fail_at = -1};

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __wrap_free(void *block);

static bool refuses(void) {
    pthread_mutex_lock(&memory.lock);
    const long call = ++memory.calls, at = memory.fail_at;
    pthread_mutex_unlock(&memory.lock);
    return at > 0 && (memory.once ? call == at : call >= at);
}

/// Blocks that others have given are passed over.
static void leave(const void *block) {
    pthread_mutex_lock(&memory.lock);
    for (size_t i = memory.count; i-- > 0;)
        if (memory.blocks[i] == block) {
            memory.blocks[i] = memory.blocks[--memory.count];
            break;
        }
    pthread_mutex_unlock(&memory.lock);
}

static void *enter(void *block) {
    pthread_mutex_lock(&memory.lock);
    if (block && memory.count < BLOCKS_MOST) memory.blocks[memory.count++] = block;
    pthread_mutex_unlock(&memory.lock);
    return block;
}

void *__wrap_malloc(size_t size) {
    return refuses() ? NULL : enter(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size) {
    return refuses() ? NULL : enter(__real_calloc(count, size));
}

void *__wrap_realloc(void *block, size_t size) {
    if (refuses()) return NULL;
    leave(block);
    return enter(__real_realloc(block, size));
}

void __wrap_free(void *block) {
    leave(block);
    __real_free(block);
}

/// Runs a command, given by its words.
static int run(const char *line, long fail_at, bool once) {
    char words[512], *argv[WORDS_MOST] = {"sightline"};
    int argc = 1;
    snprintf(words, sizeof words, "%s", line);
    for (char *word = strtok(words, " "); word; word = strtok(NULL, " ")) argv[argc++] = word;
    const size_t before = memory.count;
    optind = 0; // getopt begins anew
    memory.calls = 0;
    memory.once = once;
    memory.fail_at = fail_at;
    const int code = __real_main(argc, argv);
    memory.fail_at = -1;
    if (memory.count != before && !memory.leaks_at) memory.leaks_at = fail_at;
    return code;
}

static void check(const char *line) {
    // Standard output is looked at by other tests.
    const int out = dup(1), errors = dup(2), nowhere = open("/dev/null", O_WRONLY);
    fflush(stdout);
    dup2(nowhere, 1);
    const int usual = run(line, -1, false);
    const long needed = memory.calls;
    dup2(nowhere, 2);
    long refused = 0, odd = 0;
    for (long at = 1; at <= needed; at++)
        for (int once = 0; once < 2; once++) {
            const int code = run(line, at, once);
            refused += code == 1;
            odd += code != 1 && code != usual;
        }
    fflush(stdout);
    dup2(out, 1);
    dup2(errors, 2);
    close(out);
    close(errors);
    close(nowhere);
    if (memory.leaks_at)
        fail_msg("'%s' leaves blocks when allocation %ld fails", line, memory.leaks_at);
    assert_int_equal(usual, 0);
    assert_true(refused > 0);
    assert_int_equal(odd, 0);
}

#define MAPS SIGHTLINE_SOURCE_DIR "/maps/"

/// Two storeys of one small plan.
static void write_building(void) {
    FILE *plan = fopen("no_memory.map", "w"), *building = fopen("no_memory.storeys", "w");
    assert_true(plan && building);
    fputs("sightline 1\nwalls 0 0 4 0 4 3 0 3 0 0\nwall 2 0 2 2\nstart 1 1 0\n", plan);
    fputs("storeys 1\nstorey a no_memory.map\nstorey b no_memory.map\nlink up a 1,1 b 1,1 3\n",
          building);
    assert_int_equal(fclose(plan), 0);
    assert_int_equal(fclose(building), 0);
}

static void test_commands_leave_nothing_where_memory_fails(void **state) {
    (void)state;
    write_building();
    check("path no_memory.storeys --from a:3,1 --to b:3,1 --json");
    check("vga no_memory.storeys --grid 1 --from a:3,1 --threads 1 -o no_memory.csv --quiet");
    check("rooms no_memory.map --json --from 1,1 --grid 1 --threads 1");
    check("bake --json --threads 1 -o no_memory.slv " MAPS "effects/chambers.map");
    check("info --json no_memory.slv");
    check("eye --json --at 2,5 --object 1,1,2,2 no_memory.slv");
    check("info --json " MAPS "effects/doors.map");
    check("check --json " MAPS "effects/doors.map");
}

static char folder[] = "/tmp/sightline-no-memory-XXXXXX";

/// Commands write into a folder of their own.
static int set_up(void **state) {
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int tear_down(void **state) {
    static const char *const files[] = {"no_memory.map", "no_memory.storeys", "no_memory.csv",
                                        "no_memory.slv"};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) remove(files[i]);
    return chdir("/") == 0 && rmdir(folder) == 0 ? 0 : -1;
}

int __wrap_main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_commands_leave_nothing_where_memory_fails)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
