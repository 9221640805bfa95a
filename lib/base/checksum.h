/// The checksum of baked files: CRC-32 with the polynomial of ISO 3309, as in zlib, PNG and gzip.
#ifndef SL_CHECKSUM_H
#define SL_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/// A sum that grows. sl_checksum_begin() makes it, sl_checksum_value() gives it.
typedef struct sl_checksum {
    uint32_t table[16][256];
    uint32_t state;
} sl_checksum;

void sl_checksum_begin(sl_checksum *sum);
void sl_checksum_add(sl_checksum *sum, const void *bytes, size_t count);
uint32_t sl_checksum_value(const sl_checksum *sum);

#endif
