/// What clang-tidy cannot know: a function that reports a failure never returns SL_OK. Included
/// before every source but the one that defines these functions (check.py).
#ifndef SIGHTLINE_STRUCTURE_TIDY_H
#define SIGHTLINE_STRUCTURE_TIDY_H

#include "sightline/support.h"

#define sl_fail(context, status, ...) ((void)(sl_fail)(context, status, __VA_ARGS__), (status))
#define sl_fail_at(context, file, line, ...)                                                       \
    ((void)(sl_fail_at)(context, file, line, __VA_ARGS__), SL_BAD_INPUT)
#define sl_fail_memory(context) ((void)(sl_fail_memory)(context), SL_NO_MEMORY)

#endif
