#include "sizes.h"

#include <stdio.h>
#include <sys/resource.h>
#include <sys/stat.h>

void sl_size_write(uint64_t bytes, char text[SL_SIZE_TEXT]) {
    static const char *const units[] = {"KiB", "MiB", "GiB", "TiB"};
    if (bytes < 1024) {
        snprintf(text, SL_SIZE_TEXT, "%u bytes", (unsigned)bytes);
        return;
    }
    double size = (double)bytes / 1024;
    unsigned unit = 0;
    for (; size >= 1000 && unit < 3; unit++) size /= 1024;
    snprintf(text, SL_SIZE_TEXT, "%.*f %s", size < 100 ? 1 : 0, size, units[unit]);
}

uint64_t sl_size_of_file(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 ? (uint64_t)status.st_size : 0;
}

uint64_t sl_size_of_peak_memory(void) {
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
    return (uint64_t)usage.ru_maxrss;
#else
    return (uint64_t)usage.ru_maxrss * 1024; // Linux and the BSDs count KiB
#endif
}
