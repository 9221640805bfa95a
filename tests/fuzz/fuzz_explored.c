// Explored areas: whatever is read can be asked, added to and written, and what is written is read.
#include "fuzz.h"

#include "sightline/explored.h"

static void use(sl_context *context, sl_explored *explored) {
    static const sl_point corners[] = {{0, 0}, {4, 0}, {4, 4}};
    const size_t end = 3;
    const sl_shape more = {corners, &end, 1};
    sl_explored *again = NULL;
    sl_bytes bytes;
    bool holds;
    if (sl_explored_add(context, explored, &more) != SL_OK) return;
    if (sl_explored_holds(context, explored, (sl_point){2, 1}, &holds) != SL_OK) return;
    if (sl_explored_write(context, explored, &bytes) != SL_OK) return;
    const sl_status status = sl_explored_read(context, "back", bytes.data, bytes.size, &again);
    FUZZ_CHECK(status == SL_OK || status == SL_UNSUPPORTED || status == SL_NO_MEMORY);
    sl_free(context, bytes.data);
    sl_explored_destroy(context, again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_explored *explored = NULL;
    if (sl_explored_read(context, "input", (const char *)data, size, &explored) == SL_OK)
        use(context, explored);
    sl_explored_destroy(context, explored);
    sl_context_destroy(context);
    return 0;
}
