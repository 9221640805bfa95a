/// Numbers in the file: copied, so that alignment and aliasing do not matter; little endian.

#if defined(__BYTE_ORDER__) && defined(__ORDER_BIG_ENDIAN__)
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define SLRT_BIG_ENDIAN
#endif
#endif

static uint32_t slrt_u32(const unsigned char *at) {
    uint32_t value;
#ifdef SLRT_BIG_ENDIAN
    int i;
    for (i = 3, value = 0; i >= 0; i--) value = value << 8 | at[i];
#else
    memcpy(&value, at, sizeof value);
#endif
    return value;
}

static int32_t slrt_i32(const unsigned char *at) {
    const uint32_t bits = slrt_u32(at);
    int32_t value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint64_t slrt_u64(const unsigned char *at) {
    uint64_t value;
#ifdef SLRT_BIG_ENDIAN
    int i;
    for (i = 7, value = 0; i >= 0; i--) value = value << 8 | at[i];
#else
    memcpy(&value, at, sizeof value);
#endif
    return value;
}

static double slrt_f64(const unsigned char *at) {
    const uint64_t bits = slrt_u64(at);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}
