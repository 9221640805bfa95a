/// The one process of `sightline` shares with nobody.
#include "system/crew.h"

void crew_begin(int *argc, char ***argv) {
    (void)argc;
    (void)argv;
}

void crew_end(void) {
}

void crew_listen(void) {
}

uint32_t crew_rank(void) {
    return 0;
}

uint32_t crew_size(void) {
    return 1;
}

sl_status crew_agree(sl_context *context, sl_status mine) {
    (void)context;
    return mine;
}

sl_status crew_join(sl_context *context, sl_partial *partial) {
    (void)context;
    (void)partial;
    return SL_OK;
}
