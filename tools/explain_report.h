/// An explanation as text for people and as JSON for programs, and what the baked file says beside
/// it.
#ifndef EXPLAIN_REPORT_H
#define EXPLAIN_REPORT_H

#include "sightline/bake.h"
#include "sightline/explain.h"

void sl_explanation_print(const sl_baked *baked, const sl_explanation *explanation);
sl_status sl_explanation_print_json(sl_context *context, const sl_baked *baked,
                                    const sl_explanation *explanation);

#endif
