/// Streams that are written to memory, by open_memstream() of POSIX.
#include "base/file_system.h"

#include <stdlib.h>

bool sli_memory_open(sli_memory_stream *memory) {
    *memory = (sli_memory_stream){0};
    memory->stream = open_memstream(&memory->text, &memory->size);
    return memory->stream != NULL;
}

bool sli_memory_close(sli_memory_stream *memory) {
    const bool failed = ferror(memory->stream) != 0;
    const bool kept = fclose(memory->stream) == 0 && !failed;
    if (!kept) free(memory->text);
    if (!kept) memory->text = NULL;
    return kept;
}
