/// The operating system by Windows. Its own functions take paths in UTF-16.
#include "system/system.h"

#include <direct.h>
#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <psapi.h>
#include <shellapi.h>

enum { PATH_ROOM = 4096 };

static bool widen(const char *path, wchar_t wide[PATH_ROOM]) {
    return MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, wide, PATH_ROOM) > 0;
}

/// The arguments as UTF-8; the ones of main() have only the letters of the system's code page. They
/// stay as they are where memory runs out.
static void take_arguments(int *argc, char ***argv) {
    int count = 0;
    wchar_t **wide = CommandLineToArgvW(GetCommandLineW(), &count);
    char **arguments = wide ? calloc((size_t)count + 1, sizeof *arguments) : NULL;
    for (int i = 0; arguments && i < count; i++) {
        const int size = WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, NULL, 0, NULL, NULL);
        arguments[i] = malloc((size_t)size + 1);
        if (!arguments[i]) return;
        WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, arguments[i], size, NULL, NULL);
    }
    LocalFree(wide);
    if (!arguments) return;
    *argc = count;
    *argv = arguments;
}

void system_begin(int *argc, char ***argv) {
    take_arguments(argc, argv);
    SetConsoleOutputCP(CP_UTF8);
    // Bytes as they are: a baked file may come from a pipe, and lines end as on other machines.
    _setmode(_fileno(stdin), _O_BINARY);
    _setmode(_fileno(stdout), _O_BINARY);
}

bool system_is_terminal(FILE *stream) {
    return _isatty(_fileno(stream)) != 0;
}

int system_terminal_width(void) {
    CONSOLE_SCREEN_BUFFER_INFO screen;
    if (!GetConsoleScreenBufferInfo(GetStdHandle(STD_ERROR_HANDLE), &screen)) return 0;
    return screen.srWindow.Right - screen.srWindow.Left + 1;
}

bool system_reader_is_gone(void) {
    return false; // a write says so
}

void system_on_interruption(void (*handler)(int number)) {
    signal(SIGINT, handler ? handler : SIG_DFL);
    signal(SIGTERM, handler ? handler : SIG_DFL);
}

static HANDLE open_to_ask(const char *path) {
    wchar_t wide[PATH_ROOM];
    if (!widen(path, wide)) return INVALID_HANDLE_VALUE;
    return CreateFileW(wide, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
                       OPEN_EXISTING, 0, NULL);
}

static bool find_file(const char *path, int stream, BY_HANDLE_FILE_INFORMATION *file) {
    const HANDLE handle = path ? open_to_ask(path) : (HANDLE)_get_osfhandle(stream);
    if (handle == INVALID_HANDLE_VALUE) return false;
    const bool found =
        GetFileType(handle) == FILE_TYPE_DISK && GetFileInformationByHandle(handle, file);
    if (path) CloseHandle(handle);
    return found;
}

bool system_is_one_file(const char *a, int a_stream, const char *b, int b_stream) {
    BY_HANDLE_FILE_INFORMATION first, second;
    return find_file(a, a_stream, &first) && find_file(b, b_stream, &second) &&
           first.dwVolumeSerialNumber == second.dwVolumeSerialNumber &&
           first.nFileIndexHigh == second.nFileIndexHigh &&
           first.nFileIndexLow == second.nFileIndexLow;
}

uint64_t system_file_size(const char *path) {
    wchar_t wide[PATH_ROOM];
    struct _stat64 file;
    return widen(path, wide) && _wstat64(wide, &file) == 0 ? (uint64_t)file.st_size : 0;
}

bool system_is_link(const char *path) {
    (void)path;
    return false;
}

bool system_make_folder(char *path) {
    enum { TRIES = 100 };
    wchar_t wide[PATH_ROOM];
    char *end = path + strlen(path) - 6;
    for (unsigned i = 0; i < TRIES; i++) {
        const unsigned number = (unsigned)(GetCurrentProcessId() * 7919 + GetTickCount() + i);
        sprintf(end, "%06x", number & 0xffffff);
        if (!widen(path, wide)) break;
        if (CreateDirectoryW(wide, NULL)) return true;
        if (GetLastError() != ERROR_ALREADY_EXISTS) break;
    }
    errno = GetLastError() == ERROR_PATH_NOT_FOUND ? ENOENT : EACCES;
    return false;
}

bool system_move(const char *from, const char *to) {
    wchar_t source[PATH_ROOM], target[PATH_ROOM];
    if (widen(from, source) && widen(to, target) &&
        MoveFileExW(source, target, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH))
        return true;
    errno = EACCES;
    return false;
}

void system_remove_file(const char *path) {
    wchar_t wide[PATH_ROOM];
    if (widen(path, wide)) _wunlink(wide);
}

void system_remove_folder(const char *path) {
    wchar_t wide[PATH_ROOM];
    if (widen(path, wide)) _wrmdir(wide);
}

FILE *system_open_scratch(void) {
    wchar_t folder[PATH_ROOM], path[MAX_PATH];
    const DWORD length = GetTempPathW(PATH_ROOM, folder);
    errno = EACCES;
    if (!length || length >= PATH_ROOM || !GetTempFileNameW(folder, L"sl", 0, path)) return NULL;
    return _wfopen(path, L"w+bD"); // D: it goes when it is closed
}

/// Adds a word to a command line so that the program finds it again: quotes around it, a backslash
/// before each quote and each backslash that stands before a quote.
static bool add_word(wchar_t *line, size_t *used, size_t room, const char *word) {
    wchar_t wide[PATH_ROOM];
    if (!widen(word, wide) || *used + 2 * wcslen(wide) + 5 > room) return false;
    size_t slashes = 0;
    if (*used) line[(*used)++] = L' ';
    line[(*used)++] = L'"';
    for (const wchar_t *c = wide;; c++) {
        const bool quote = *c == L'"' || !*c;
        for (size_t i = 0; quote && i < slashes; i++) line[(*used)++] = L'\\';
        slashes = *c == L'\\' ? slashes + 1 : 0;
        if (!*c) break;
        if (quote) line[(*used)++] = L'\\';
        line[(*used)++] = *c;
    }
    line[(*used)++] = L'"';
    line[*used] = L'\0';
    return true;
}

static HANDLE to_inherit(FILE *file) {
    const HANDLE handle = (HANDLE)_get_osfhandle(_fileno(file));
    SetHandleInformation(handle, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
    return handle;
}

bool system_run(char *const *words, FILE *out, FILE *err, bool (*stops)(void *user), void *user,
                int *exit_status) {
    enum { LINE_ROOM = 32767 }; // the most that Windows takes
    wchar_t program[PATH_ROOM], *line = malloc(LINE_ROOM * sizeof *line);
    size_t used = 0;
    bool fits = line && GetModuleFileNameW(NULL, program, PATH_ROOM) < PATH_ROOM;
    for (size_t i = 0; fits && words[i]; i++) fits = add_word(line, &used, LINE_ROOM, words[i]);
    STARTUPINFOW start = {.cb = sizeof start,
                          .dwFlags = STARTF_USESTDHANDLES,
                          .hStdOutput = to_inherit(out),
                          .hStdError = to_inherit(err)};
    PROCESS_INFORMATION process;
    const bool runs =
        fits && CreateProcessW(program, line, NULL, NULL, TRUE, 0, NULL, NULL, &start, &process);
    free(line);
    errno = fits ? EACCES : E2BIG;
    if (!runs) return false;
    bool ended = false;
    while (WaitForSingleObject(process.hProcess, 50) == WAIT_TIMEOUT)
        if (!ended && stops(user)) ended = TerminateProcess(process.hProcess, 1) != 0;
    DWORD code = 1;
    GetExitCodeProcess(process.hProcess, &code);
    CloseHandle(process.hThread);
    CloseHandle(process.hProcess);
    *exit_status = (int)code;
    return true;
}

uint64_t system_peak_memory(void) {
    PROCESS_MEMORY_COUNTERS memory;
    if (!GetProcessMemoryInfo(GetCurrentProcess(), &memory, sizeof memory)) return 0;
    return memory.PeakWorkingSetSize;
}
