/// Bytes: of files, of memory, as text.
#ifndef SIZES_H
#define SIZES_H

#include <stdint.h>

enum { SL_SIZE_TEXT = 32 };

/// "812 bytes", "3.4 MiB"
void sl_size_write(uint64_t bytes, char text[SL_SIZE_TEXT]);

/// Of a file, 0 where the system does not tell.
uint64_t sl_size_of_file(const char *path);

/// The most memory that this process has had, 0 where the system does not tell.
uint64_t sl_size_of_peak_memory(void);

#endif
