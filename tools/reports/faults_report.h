/// What `sightline check` says of a map: its faults as text or JSON, and the next command to run.
#ifndef FAULTS_REPORT_H
#define FAULTS_REPORT_H

#include "inputs/pipeline.h"
#include "reports/json_print.h"
#include "sightline/faults.h"

/// A map with its space and its faults.
typedef struct checked {
    sl_map map;     ///< as read: walls with their lines
    sl_map counted; ///< with the walls that count, if some walls do not stop all; else empty
    sl_baked baked; ///< its space, and the rest of the map for the picture
    sl_faults faults;
    sl_strays strays;
    sl_inside inside;
    double gap;  ///< up to which gaps were looked for
    bool mended; ///< snapped: the map's own cells are gone
} checked;

typedef struct faults_report {
    const char *input;
    const checked *found;
    double thin;
    const char *mended; ///< the file written; NULL for none
    sl_mend_account snap;
    const checked *left;      ///< the mended map
    double helps;             ///< a larger gap that closes a leak; 0 for none
    doubtful_opening opening; ///< what to type where an opening is in doubt
    double inside;            ///< the share of the area that is inside with its entrance
    double weld;              ///< a tolerance that closes gaps of rounding; 0 for none
    uint64_t most;            ///< of a kind, in the text
    const char *picture;      ///< NULL for none
    const options_given *given;
} faults_report;

/// Whether --strict fails.
bool checked_has_fault(const checked *c);

sl_status faults_print(sl_context *context, const faults_report *report);
sl_status faults_print_json(sl_context *context, const faults_report *report);

/// One line: "E1M1: 475 walls, 250 cells; 2 leaks, 1 gap".
void faults_print_line(const char *name, const checked *c);
/// The same as the fields of an object.
void faults_add_line(json_fields *fields, const char *name, const checked *c);

#endif
