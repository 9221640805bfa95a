/// What the proofs share. CBMC looks at all values that a nondeterministic function may give, and
/// at all ways through the code up to a number of turns of each loop.
#ifndef SL_PROOF_H
#define SL_PROOF_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

unsigned char nondet_uchar(void);
uint32_t nondet_uint(void);
uint64_t nondet_ulong(void);
int nondet_int(void);
double nondet_double(void);
bool nondet_bool(void);

void __CPROVER_assume(bool holds);
void __CPROVER_assert(bool holds, const char *what);

#define ASSUME(condition) __CPROVER_assume(condition)
#define PROVE(condition)  __CPROVER_assert(condition, #condition)

/// With BROKEN the bytes stand one place too far: then a proof must fail.
#ifdef BROKEN
enum { MISSING = 1 };
#else
enum { MISSING = 0 };
#endif

/// The last `size` bytes of a block of `most`: who reads behind them leaves the block.
#define ANY_BYTES(name, most, size)                                                                \
    unsigned char name##_block[most];                                                              \
    const unsigned char *name = name##_block + (most) - (size) + MISSING

#endif
