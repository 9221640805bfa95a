/// Files by Windows, where paths are UTF-16 and an open file cannot be replaced.
#include "base/file_system.h"

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

enum { PATH_ROOM = 4096 };

/// A path as Windows takes it. False where it is too long, or no UTF-8.
static bool widen(const char *path, wchar_t wide[PATH_ROOM]) {
    if (MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, wide, PATH_ROOM) > 0)
        return true;
    errno = strlen(path) >= PATH_ROOM ? ENAMETOOLONG : ENOENT;
    return false;
}

/// errno for why Windows refused the last call.
static bool refuse(void) {
    switch (GetLastError()) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
        errno = ENOENT;
        break;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION: // open elsewhere
    case ERROR_LOCK_VIOLATION:
        errno = EACCES;
        break;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL:
        errno = ENOSPC;
        break;
    default:
        errno = EIO;
    }
    return false;
}

sl_path_kind sl_path_look(const char *path) {
    wchar_t wide[PATH_ROOM];
    struct _stat64 there;
    errno = 0;
    if (!widen(path, wide) || _wstat64(wide, &there) != 0) return SL_PATH_NOTHING;
    if (there.st_mode & _S_IFDIR) return SL_PATH_FOLDER;
    return there.st_mode & _S_IFREG ? SL_PATH_FILE : SL_PATH_STREAM;
}

bool sli_path_is_stdout(const char *path) {
    return _stricmp(path, "CON") == 0 || _stricmp(path, "CONOUT$") == 0;
}

/// Links are followed by the system itself.
char *sli_path_target(sl_context *context, const char *path) {
    return sl_copy_text(context, path, strlen(path));
}

FILE *sli_file_open(const char *path, const char *mode) {
    wchar_t wide[PATH_ROOM], how[8] = {0};
    if (!widen(path, wide)) return NULL;
    for (size_t i = 0; mode[i] && i < 7; i++) how[i] = (wchar_t)mode[i];
    return _wfopen(wide, how);
}

bool sli_file_is_whole(FILE *stream, uint64_t *size) {
    struct _stat64 file;
    if (_fstat64(_fileno(stream), &file) != 0 || !(file.st_mode & _S_IFREG)) return false;
    *size = (uint64_t)file.st_size;
    return true;
}

FILE *sli_file_make_beside(const char *path, char *temporary) {
    enum { TRIES = 100 };
    wchar_t wide[PATH_ROOM];
    temporary[0] = '\0';
    if (!widen(path, wide)) return NULL;
    if (sl_path_look(path) == SL_PATH_FILE && _waccess(wide, 2) != 0) return NULL;
    for (unsigned i = 0; i < TRIES; i++) {
        const unsigned number = (unsigned)(GetCurrentProcessId() * 7919 + GetTickCount() + i);
        sprintf(temporary, "%s.%06x", path, number & 0xffffff);
        if (!widen(temporary, wide)) break;
        const int file =
            _wopen(wide, _O_CREAT | _O_EXCL | _O_WRONLY | _O_BINARY, _S_IREAD | _S_IWRITE);
        if (file >= 0) return _fdopen(file, "wb");
        if (errno != EEXIST) break;
    }
    temporary[0] = '\0';
    return NULL;
}

bool sli_file_to_disk(FILE *stream) {
    return _commit(_fileno(stream)) == 0 || errno == EINVAL || errno == EBADF;
}

bool sli_file_replace(const char *from, const char *to) {
    wchar_t source[PATH_ROOM], target[PATH_ROOM];
    if (!widen(from, source) || !widen(to, target)) return false;
    return MoveFileExW(source, target, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) ||
           refuse();
}

void sli_file_remove(const char *path) {
    wchar_t wide[PATH_ROOM];
    if (widen(path, wide)) _wunlink(wide);
}

/// Windows has no streams to memory: a temporary file stands for it. The C library would make it in
/// the root of the drive, where users may not write.
bool sli_memory_open(sli_memory_stream *memory) {
    wchar_t folder[MAX_PATH + 1], path[MAX_PATH + 1];
    *memory = (sli_memory_stream){0};
    const DWORD length = GetTempPathW(MAX_PATH + 1, folder);
    if (!length || length > MAX_PATH || !GetTempFileNameW(folder, L"slv", 0, path)) return false;
    const int file = _wopen(path, _O_RDWR | _O_BINARY | _O_TEMPORARY | _O_SHORT_LIVED);
    if (file < 0) _wunlink(path);
    memory->stream = file < 0 ? NULL : _fdopen(file, "w+b");
    if (file >= 0 && !memory->stream) _close(file);
    return memory->stream != NULL;
}

static bool read_back(sli_memory_stream *memory) {
    const long size = fseek(memory->stream, 0, SEEK_END) == 0 ? ftell(memory->stream) : -1;
    if (size < 0 || fseek(memory->stream, 0, SEEK_SET) != 0) return false;
    memory->size = (size_t)size;
    memory->text = malloc(memory->size + 1);
    if (!memory->text) return false;
    memory->text[memory->size] = '\0';
    return fread(memory->text, 1, memory->size, memory->stream) == memory->size;
}

bool sli_memory_close(sli_memory_stream *memory) {
    const bool kept = !ferror(memory->stream) && read_back(memory);
    fclose(memory->stream);
    if (!kept) free(memory->text);
    if (!kept) memory->text = NULL;
    return kept;
}
