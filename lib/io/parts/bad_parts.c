/// Faults by kind, and the one line that tells of them.
#include "io/parts/bad_parts.h"

#include "sightline/support.h"

#include <assert.h>
#include <stdio.h>

void sli_faults_add(sli_faults *faults, const sli_fault *kind, uint32_t line) {
    size_t i = 0;
    while (i < faults->kinds && faults->items[i].kind != kind) i++;
    assert(i < SLI_FAULT_KINDS);
    if (i == faults->kinds) {
        faults->kinds++;
        faults->items[i].kind = kind;
        faults->items[i].line = line;
    }
    faults->items[i].count++;
}

void sli_faults_note(sl_context *context, const char *name, const sli_faults *faults) {
    char text[1024] = "";
    size_t used = 0, total = 0;
    for (size_t i = 0; i < faults->kinds; i++) {
        const sli_fault *kind = faults->items[i].kind;
        const size_t count = faults->items[i].count;
        total += count;
        if (used >= sizeof text) continue;
        used +=
            (size_t)snprintf(text + used, sizeof text - used, "%s%zu %s (%sline %u)",
                             used ? ", " : "", count, count == 1 ? kind->one : kind->several,
                             count == 1 ? "" : "the first in ", (unsigned)faults->items[i].line);
    }
    if (total)
        sl_note(context, "%s: passed over %zu faulty part%s: %s", name, total,
                total == 1 ? "" : "s", text);
}
