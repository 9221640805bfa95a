/// The processes of mpirun. MPI's own waiting keeps a core busy, and hears of no signal. So whoever
/// waits here looks whether its message has come, and sleeps a little. Between looks it listens for
/// interruptions (crew_listen), as it does while it works.
///
///     signal --> rank 2: one came here --> ranks 0, 1, 3: one came to rank 2
///
/// Each process tells all others how many signals came to it, and acts on the largest number that
/// it knows of. So one signal to all processes, which mpirun sends, is one interruption.
#include "system/crew.h"

#include "sightline/support.h"
#include "system/console.h"

#include <mpi.h>
#include <time.h>

enum { TAG = 1, TAG_READY, MOST_AT_ONCE = 1 << 30 };

/// Seconds between two looks for messages.
#define PAUSE 5e-4

/// Whether all know that a step failed somewhere; there is nothing to agree on then. At file scope,
/// as the process is one of MPI's only once. So is what it has told of signals, and heard.
static bool failed;

static struct {
    MPI_Comm talk; ///< of signals alone
    bool over;     ///< no more messages are sent
    int told;      ///< signals: a message for each went to each other process
    int heard;     ///< messages
    double last;   ///< when it listened, by sl_seconds()
} signals = {.talk = MPI_COMM_NULL};

// --- signals

/// Who listens may be at work for long: no message is waited for.
static void tell(int count) {
    static const int counts[] = {1, 2};
    const int rank = (int)crew_rank(), size = (int)crew_size();
    for (; signals.told < count && signals.told < 2; signals.told++)
        for (int to = 0; to < size; to++) {
            MPI_Request request;
            if (to == rank) continue;
            MPI_Isend(&counts[signals.told], 1, MPI_INT, to, TAG, signals.talk, &request);
            MPI_Request_free(&request);
        }
}

static void hear(void) {
    for (;;) {
        int there, count;
        MPI_Iprobe(MPI_ANY_SOURCE, TAG, signals.talk, &there, MPI_STATUS_IGNORE);
        if (!there) return;
        MPI_Recv(&count, 1, MPI_INT, MPI_ANY_SOURCE, TAG, signals.talk, MPI_STATUS_IGNORE);
        signals.heard++;
        console_hear_interruptions(count);
    }
}

void crew_listen(void) {
    const double now = sl_seconds();
    if (signals.talk == MPI_COMM_NULL || now < signals.last + PAUSE) return;
    signals.last = now;
    if (!signals.over) tell(console_interruptions());
    hear();
}

// --- waiting

static void wait_a_little(void) {
    const struct timespec pause = {0, (long)(PAUSE * 1e9)};
    nanosleep(&pause, NULL);
    crew_listen();
}

static void wait_for(MPI_Request *request) {
    for (int done = 0;; wait_a_little()) {
        MPI_Test(request, &done, MPI_STATUS_IGNORE);
        if (done) return;
    }
}

/// Until a message is there.
static void wait_for_message(int from, int tag) {
    for (int there = 0;; wait_a_little()) {
        MPI_Iprobe(from, tag, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
        if (there) return;
    }
}

static int reduce(int mine, MPI_Op operation) {
    MPI_Request request;
    int all;
    MPI_Iallreduce(&mine, &all, 1, MPI_INT, operation, MPI_COMM_WORLD, &request);
    wait_for(&request);
    return all;
}

// --- the crew

void crew_begin(int *argc, char ***argv) {
    int provided;
    // Threads look; the one that began all talks to the others.
    MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_dup(MPI_COMM_WORLD, &signals.talk);
}

/// Every message that was sent is received before.
void crew_end(void) {
    signals.over = true;
    const int others = reduce(signals.told, MPI_SUM) - signals.told;
    while (signals.heard < others) wait_a_little();
    MPI_Comm_free(&signals.talk);
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
    const int first = reduce(mine == SL_OK ? size : rank, MPI_MIN);
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

/// Once the other has time for it: then no message waits for long.
static void send_partial(const sl_partial *partial, int to) {
    int ready;
    wait_for_message(to, TAG_READY);
    MPI_Recv(&ready, 1, MPI_INT, to, TAG_READY, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
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

/// If it cannot be merged, this process goes on without it: others wait for its own.
static sl_status take_from(sl_context *context, sl_partial *partial, int from) {
    const int ready = 1;
    sl_partial other = {0};
    MPI_Send(&ready, 1, MPI_INT, from, TAG_READY, MPI_COMM_WORLD);
    wait_for_message(from, TAG);
    if (receive_partial(context, partial, from, &other) != SL_OK) {
        // The others cannot be told in the midst of a message.
        fprintf(stderr, "sightline: %s\n", sl_context_message(context));
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    const sl_status status = sl_partial_merge(context, partial, &other);
    sl_partial_destroy(context, &other);
    return status;
}

/// In pairs, in pairs of pairs and so on, so that it takes as many rounds as the size has bits.
sl_status crew_join(sl_context *context, sl_partial *partial) {
    const int rank = (int)crew_rank(), size = (int)crew_size();
    sl_status status = SL_OK;
    for (int step = 1; step < size; step *= 2) {
        if (rank % (2 * step)) {
            send_partial(partial, rank - step);
            return status;
        }
        if (rank + step >= size) continue;
        const sl_status taken = take_from(context, partial, rank + step);
        if (status == SL_OK) status = taken;
    }
    return status;
}
