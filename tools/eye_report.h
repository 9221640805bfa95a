/// What one viewpoint sees, as a table and as JSON.
#ifndef EYE_REPORT_H
#define EYE_REPORT_H

#include "eye_objects.h"

void sl_eye_print(const sl_baked *baked, const sl_eye_run *run);
sl_status sl_eye_print_json(sl_context *context, const sl_baked *baked, const sl_eye_run *run,
                            const sl_eye_objects *objects);

#endif
