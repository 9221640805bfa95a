/// Memory of the oracles.
#ifndef SL_TESTS_ORACLE_MUST_H
#define SL_TESTS_ORACLE_MUST_H

#include <stdio.h>
#include <stdlib.h>

/// The block, if there is one: without memory an oracle says nothing.
static inline void *must(void *block) {
    if (!block) {
        fputs("out of memory\n", stderr);
        abort();
    }
    return block;
}

#endif
