/// The text of `sightline explain`. Its JSON is the library's: sightline/explained.h.
#ifndef EXPLAIN_TEXT_H
#define EXPLAIN_TEXT_H

#include "sightline/explained.h"

/// `scratch` has a place for each door of the map.
void explanation_print(const sl_explained *a, bool *scratch);

#endif
