/// The operating system by POSIX.
#include "system/system.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static void set_handler(int number, void (*handler)(int)) {
    struct sigaction action = {.sa_handler = handler};
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, NULL);
}

/// Where a standard stream is closed, the next file opened would take its number and be written to
/// as if it were stdout. A descriptor open the wrong way round holds the place and fails instead.
static void hold_standard_streams(void) {
    for (int descriptor = 0; descriptor <= 2; descriptor++)
        if (fcntl(descriptor, F_GETFD) == -1)
            (void)!open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY);
}

void system_begin(int *argc, char ***argv) {
    (void)argc;
    (void)argv;
    hold_standard_streams();
    // If a reader goes away, or a file grows beyond its limit, writes then fail instead.
    set_handler(SIGPIPE, SIG_IGN);
    set_handler(SIGXFSZ, SIG_IGN);
}

bool system_is_terminal(FILE *stream) {
    return isatty(fileno(stream));
}

int system_terminal_width(void) {
    struct winsize size;
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

bool system_reader_is_gone(void) {
    struct pollfd out = {.fd = STDOUT_FILENO, .events = POLLOUT};
    return poll(&out, 1, 0) > 0 && (out.revents & POLLERR);
}

void system_on_interruption(void (*handler)(int number)) {
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        struct sigaction now;
        if (!handler)
            set_handler(numbers[i], SIG_DFL);
        else if (sigaction(numbers[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN)
            set_handler(numbers[i], handler);
    }
}

static bool find_file(const char *path, int stream, struct stat *file) {
    return path ? stat(path, file) == 0 : fstat(stream, file) == 0;
}

bool system_is_one_file(const char *a, int a_stream, const char *b, int b_stream) {
    struct stat first, second;
    return find_file(a, a_stream, &first) && find_file(b, b_stream, &second) &&
           first.st_dev == second.st_dev && first.st_ino == second.st_ino && S_ISREG(first.st_mode);
}

uint64_t system_file_size(const char *path) {
    struct stat file;
    return stat(path, &file) == 0 ? (uint64_t)file.st_size : 0;
}

bool system_is_link(const char *path) {
    struct stat here;
    return lstat(path, &here) == 0 && S_ISLNK(here.st_mode);
}

bool system_make_folder(char *path) {
    if (!mkdtemp(path)) return false;
    // mkdtemp makes folders private. Give this one the usual permissions.
    const mode_t mask = umask(0);
    umask(mask);
    (void)!chmod(path, 0777 & ~mask);
    return true;
}

bool system_move(const char *from, const char *to) {
    struct stat older;
    if (lstat(to, &older) == 0 && S_ISREG(older.st_mode)) (void)!chmod(from, older.st_mode & 0777);
    return rename(from, to) == 0;
}

void system_remove_file(const char *path) {
    unlink(path);
}

void system_remove_folder(const char *path) {
    rmdir(path);
}

FILE *system_open_scratch(void) {
    FILE *file = tmpfile();
    // Programs that are started meanwhile need not hold it.
    if (file) (void)fcntl(fileno(file), F_SETFD, FD_CLOEXEC);
    return file;
}

extern char **environ;

static int start(char *const *words, FILE *out, FILE *err, pid_t *process) {
    posix_spawn_file_actions_t files;
    int error = posix_spawn_file_actions_init(&files);
    if (error) return error;
    error = posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (!error) error = posix_spawn_file_actions_adddup2(&files, fileno(out), STDOUT_FILENO);
    if (!error) error = posix_spawn_file_actions_adddup2(&files, fileno(err), STDERR_FILENO);
    if (!error) error = posix_spawnp(process, words[0], &files, NULL, words, environ);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

bool system_run(char *const *words, FILE *out, FILE *err, bool (*stops)(void *user), void *user,
                int *exit_status) {
    pid_t process;
    const int error = start(words, out, err, &process);
    errno = error;
    if (error) return false;
    int state;
    bool ended = false;
    long wait = 1000000; // nanoseconds; grows to a twentieth of a second
    for (pid_t done; (done = waitpid(process, &state, WNOHANG)) != process;) {
        if (done < 0 && errno != EINTR) return false;
        if (!ended && stops(user)) ended = kill(process, SIGTERM) == 0;
        nanosleep(&(struct timespec){.tv_nsec = wait}, NULL);
        if (wait < 50000000) wait += wait / 4;
    }
    *exit_status = WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
    return true;
}

uint64_t system_peak_memory(void) {
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
    return (uint64_t)usage.ru_maxrss;
#else
    return (uint64_t)usage.ru_maxrss * 1024; // Linux and the BSDs count KiB
#endif
}
