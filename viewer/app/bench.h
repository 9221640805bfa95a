/// Runs without a user: frame times with all layers on and software rendering, and random events
/// that look for crashes.
#ifndef VIEWER_BENCH_H
#define VIEWER_BENCH_H

#include "app/app.h"

/// Walks, turns and pans through the open map. Prints one CSV line for each part:
/// map,cells,walls,part,frames,mean_ms,median_ms,p95_ms,worst_ms,processor_ms,late,machine
sl_status bench_run(app_state *app, unsigned frames);

/// Sends random keys, clicks, drags, sizes and maps for a number of seconds, without a window.
sl_status soak_run(app_state *app, double seconds, uint64_t seed);

#endif
