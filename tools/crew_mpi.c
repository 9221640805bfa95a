#include "crew.h"

#include "sightline/support.h"

#include <mpi.h>

enum { TAG = 1, MOST_AT_ONCE = 1 << 30 };

/// Whether all know that a step failed somewhere; there is nothing to agree on then. At file scope,
/// as the process is one of MPI's only once.
static bool failed;

void crew_begin(int *argc, char ***argv) {
    int provided;
    // Threads look; the one that began all talks to the others.
    MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
}

void crew_end(void) {
    MPI_Finalize();
}

uint32_t crew_rank(void) {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return (uint32_t)rank;
}

uint32_t crew_size(void) {
    int size = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return (uint32_t)size;
}

sl_status crew_agree(sl_context *context, sl_status mine) {
    if (failed) return mine;
    const int rank = (int)crew_rank(), size = (int)crew_size();
    int first = mine == SL_OK ? size : rank;
    MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (first == size) return SL_OK;
    failed = true;
    // The first process that failed has said why.
    if (first != rank) return sl_fail(context, mine == SL_OK ? SL_CANCELLED : mine, "%s", "");
    return mine;
}

// --- partial results as messages

static void send_bytes(const void *bytes, uint64_t count, int to) {
    const char *at = bytes;
    for (uint64_t left = count; left;) {
        const int part = left < MOST_AT_ONCE ? (int)left : MOST_AT_ONCE;
        MPI_Send(at, part, MPI_BYTE, to, TAG, MPI_COMM_WORLD);
        at += part;
        left -= (uint64_t)part;
    }
}

static void receive_bytes(void *bytes, uint64_t count, int from) {
    char *at = bytes;
    for (uint64_t left = count; left;) {
        const int part = left < MOST_AT_ONCE ? (int)left : MOST_AT_ONCE;
        MPI_Recv(at, part, MPI_BYTE, from, TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        at += part;
        left -= (uint64_t)part;
    }
}

static void send_rows(const sl_pvs *rows, int to) {
    send_bytes(rows->offsets, ((uint64_t)rows->cell_count + 1) * sizeof *rows->offsets, to);
    send_bytes(rows->bytes, rows->offsets[rows->cell_count], to);
}

static sl_status receive_rows(sl_context *context, uint32_t cell_count, int from, sl_pvs *rows) {
    rows->cell_count = cell_count;
    rows->offsets = sl_alloc_array(context, (size_t)cell_count + 1, sizeof *rows->offsets);
    if (!rows->offsets) return SL_NO_MEMORY;
    receive_bytes(rows->offsets, ((uint64_t)cell_count + 1) * sizeof *rows->offsets, from);
    rows->bytes = sl_alloc_array(context, rows->offsets[cell_count] + 1, 1);
    if (!rows->bytes) return SL_NO_MEMORY;
    receive_bytes(rows->bytes, rows->offsets[cell_count], from);
    return SL_OK;
}

static void send_partial(const sl_partial *partial, int to) {
    send_bytes(partial->done, sl_bits_words(partial->unit_count) * sizeof *partial->done, to);
    send_rows(&partial->sure, to);
    send_rows(&partial->doubtful, to);
}

/// Partial results of the same work as `like`.
static sl_status receive_partial(sl_context *context, const sl_partial *like, int from,
                                 sl_partial *out) {
    const size_t words = sl_bits_words(like->unit_count);
    out->unit_count = like->unit_count;
    out->inside_only = like->inside_only;
    out->done = sl_alloc_array(context, words, sizeof *out->done);
    if (!out->done) return SL_NO_MEMORY;
    receive_bytes(out->done, words * sizeof *out->done, from);
    SL_TRY(receive_rows(context, like->sure.cell_count, from, &out->sure));
    return receive_rows(context, like->doubtful.cell_count, from, &out->doubtful);
}

static sl_status take_from(sl_context *context, sl_partial *partial, int from) {
    sl_partial other = {0};
    sl_status status = receive_partial(context, partial, from, &other);
    if (status == SL_OK) status = sl_partial_merge(context, partial, &other);
    sl_partial_destroy(context, &other);
    return status;
}

/// In pairs, in pairs of pairs and so on, so that it takes as many rounds as the size has bits.
sl_status crew_join(sl_context *context, sl_partial *partial) {
    const int rank = (int)crew_rank(), size = (int)crew_size();
    for (int step = 1; step < size; step *= 2) {
        if (rank % (2 * step)) {
            send_partial(partial, rank - step);
            return SL_OK;
        }
        if (rank + step >= size) continue;
        // The others cannot be told in the midst of a message.
        if (take_from(context, partial, rank + step) != SL_OK) {
            fprintf(stderr, "sightline: %s\n", sl_context_message(context));
            MPI_Abort(MPI_COMM_WORLD, 1);
        }
    }
    return SL_OK;
}
