/// A program that leaks: the sanitizer must say so.
#include <stdlib.h>

// Volatile, so that no compiler takes the unused block away.
static void *volatile kept;

int main(void) {
    kept = malloc(16);
    kept = NULL;
    return 0;
}
