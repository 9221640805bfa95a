/// Blocks of numbered places in one array that grows. Sizes are powers of two; a block that was
/// given back is taken again for the same size. So memory stays as it is where sizes come and go.
#ifndef SL_WORLD_BLOCKS_H
#define SL_WORLD_BLOCKS_H

#include <stdint.h>

enum { SLI_BLOCK_LEAST = 4, SLI_BLOCK_SIZES = 30 };

/// Zeroed, there are none. Free blocks of a size are a chain through an array of the caller's, at
/// the first place of each.
typedef struct sli_blocks {
    uint32_t used;                  ///< places
    uint32_t free[SLI_BLOCK_SIZES]; ///< 1 + the first place of the first free block; 0 for none
} sli_blocks;

static inline uint32_t sli_block_class(uint32_t count) {
    uint32_t k = 0;
    while ((uint32_t)SLI_BLOCK_LEAST << k < count) k++;
    return k;
}

/// How many places a block has that was taken for `count`.
static inline uint32_t sli_block_size(uint32_t count) {
    return (uint32_t)SLI_BLOCK_LEAST << sli_block_class(count);
}

/// The first place of a block. The array must have room for the block behind `used`.
static inline uint32_t sli_block_take(sli_blocks *blocks, const uint32_t *chain, uint32_t count) {
    const uint32_t k = sli_block_class(count), head = blocks->free[k];
    if (head) {
        blocks->free[k] = chain[head - 1];
        return head - 1;
    }
    blocks->used += (uint32_t)SLI_BLOCK_LEAST << k;
    return blocks->used - ((uint32_t)SLI_BLOCK_LEAST << k);
}

/// Gives back a block that was taken for `count`.
static inline void sli_block_give(sli_blocks *blocks, uint32_t *chain, uint32_t first,
                                  uint32_t count) {
    const uint32_t k = sli_block_class(count);
    chain[first] = blocks->free[k];
    blocks->free[k] = first + 1;
}

#endif
