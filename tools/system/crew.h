/// The processes that share one bake. The command `sightline` is one process. `sightline-mpi` is as
/// many as mpirun starts: each runs the whole command on its share of the work. The first one
/// gathers the results, writes and reports.
#ifndef CREW_H
#define CREW_H

#include "sightline/cell_to_cell.h"

void crew_begin(int *argc, char ***argv);
void crew_end(void);

uint32_t crew_rank(void); ///< from 0
uint32_t crew_size(void);

/// Tells the others of the interruptions that came to this process, and hears of theirs. The main
/// thread calls it often while it works.
void crew_listen(void);

/// The outcome of a step in all processes: SL_OK where it went well everywhere. All must call it.
sl_status crew_agree(sl_context *context, sl_status mine);

/// Joins the partial results of all processes by OR, in the first one. All must call it.
sl_status crew_join(sl_context *context, sl_partial *partial);

#endif
