/// The processes that work on one bake together. One alone, but in sightline-mpi: there as many as
/// mpirun starts, each of which runs the whole command on its share of the work; the first one
/// gathers what they find, and reports and writes.
#ifndef CREW_H
#define CREW_H

#include "sightline/cell_to_cell.h"

void crew_begin(int *argc, char ***argv);
void crew_end(void);

uint32_t crew_rank(void); ///< from 0
uint32_t crew_size(void);

/// What came of a step in all processes: SL_OK where it went well everywhere. To be called by all.
sl_status crew_agree(sl_context *context, sl_status mine);

/// Joins the partial results of all processes, by OR, into those of the first one. To be called by
/// all.
sl_status crew_join(sl_context *context, sl_partial *partial);

#endif
