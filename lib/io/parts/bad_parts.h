/// Faults: parts of a drawing that are wrong, without which the rest is still good. A reader passes
/// over them, counts them by kind, and says in one line how many there were and where the first one
/// of each kind stands. What makes the whole file doubtful stays an error.
#ifndef SL_FAULTS_H
#define SL_FAULTS_H

#include "sightline/context.h"

/// A kind of fault, in the singular and the plural: "circle without a radius". It outlives the
/// reader.
typedef struct sli_fault {
    const char *one, *several;
} sli_fault;

enum { SLI_FAULT_KINDS = 16 };

/// Zeroed, there are none.
typedef struct sli_faults {
    struct {
        const sli_fault *kind;
        size_t count;
        uint32_t line; ///< of the first
    } items[SLI_FAULT_KINDS];
    size_t kinds;
} sli_faults;

void sli_faults_add(sli_faults *faults, const sli_fault *kind, uint32_t line);

/// "FILE: passed over 3 faulty parts: 2 circles without a radius (the first in line 5), ...";
/// nothing without faults.
void sli_faults_note(sl_context *context, const char *name, const sli_faults *faults);

#endif
