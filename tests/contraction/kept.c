// Compiled as all of the project is.
#include "contraction/expansion.h"

int orient_kept(sl_point a, sl_point b, sl_point c) {
    return orient_by_expansion(a, b, c);
}
