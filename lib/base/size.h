/// Counts of 64 bits as sizes of memory, which have 32 bits on some machines.
///
/// Rows of a large plan may take more than 4 GB once they are spread out, though what they are made
/// of fits into memory. There a cast would keep the low bits: a block that is too small, and no
/// message. Here such a count becomes a size that no allocation gives.
#ifndef SL_SIZE_H
#define SL_SIZE_H

#include <stddef.h>
#include <stdint.h>

/// The size to allocate for a count. For what is in memory already it is the count itself.
static inline size_t sli_size(uint64_t count) {
    const size_t size = (size_t)count;
    return size == count ? size : SIZE_MAX;
}

#endif
