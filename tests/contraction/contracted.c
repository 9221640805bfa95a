// Compiled with contraction by force (tests/CMakeLists.txt).
#include "contraction/expansion.h"

int orient_contracted(sl_point a, sl_point b, sl_point c) {
    return orient_by_expansion(a, b, c);
}

bool orient_contracts(void) {
#if defined(__x86_64__) && defined(__FMA__)
    return __builtin_cpu_supports("fma");
#elif defined(__aarch64__)
    return true;
#else
    return false;
#endif
}
