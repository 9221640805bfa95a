/// Frame times of a walk, with all layers on and software rendering.
#ifndef VIEWER_BENCH_H
#define VIEWER_BENCH_H

#include "app.h"

/// Walks, turns and pans through the map that is open and prints a CSV line a part of it:
/// map,cells,walls,part,frames,mean_ms,median_ms,p95_ms,worst_ms,processor_ms,machine
sl_status bench_run(app_state *app, unsigned frames);

#endif
