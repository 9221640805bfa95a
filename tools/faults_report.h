/// What sightline check prints.
#ifndef FAULTS_REPORT_H
#define FAULTS_REPORT_H

#include "sightline/faults.h"

typedef struct sl_faults_report {
    const char *input;
    const sl_map *map;
    const sl_space *space;
    const sl_faults *faults;
    double gap, thin;
    const char *mended; ///< the file written; NULL for none
    sl_snap_account snap;
    uint32_t left[SL_FAULT_KINDS]; ///< what the mended map has, by kind
    uint64_t most;                 ///< of a kind, in the text
} sl_faults_report;

sl_status sl_faults_print(const sl_faults_report *report);
sl_status sl_faults_print_json(sl_context *context, const sl_faults_report *report);

#endif
