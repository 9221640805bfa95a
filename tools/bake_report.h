/// What a bake did and how long it took, as text for people and as JSON for programs.
#ifndef BAKE_REPORT_H
#define BAKE_REPORT_H

#include "bake_parts.h"

typedef struct bake_report {
    const char *input, *output;
    const sl_baked *baked;
    sl_bake_account account;
    bake_parts_account parts;
    struct {
        double read; ///< cleaning included
        double see, write;
    } seconds;
} bake_report;

/// What cleaning did, if anything: the rest of a line, and a line on welding.
void cleaning_print(const sl_clean_account *account);

sl_status bake_report_print(sl_context *context, const bake_report *report);
sl_status bake_report_print_json(sl_context *context, const bake_report *report);

#endif
