/// Sightline: 2D cell-and-portal visibility. All of the core library's public headers.
#ifndef SIGHTLINE_SIGHTLINE_H
#define SIGHTLINE_SIGHTLINE_H

#include "sightline/bake.h"
#include "sightline/cell_to_cell.h"
#include "sightline/context.h"
#include "sightline/dual.h"
#include "sightline/earth.h"
#include "sightline/effects.h"
#include "sightline/explain.h"
#include "sightline/explained.h"
#include "sightline/explored.h"
#include "sightline/faults.h"
#include "sightline/geometry.h"
#include "sightline/import.h"
#include "sightline/map.h"
#include "sightline/measures.h"
#include "sightline/overlay.h"
#include "sightline/pvs.h"
#include "sightline/query.h"
#include "sightline/region.h"
#include "sightline/space.h"
#include "sightline/stab.h"
#include "sightline/steps.h"
#include "sightline/storeys.h"
#include "sightline/version.h"
#include "sightline/view.h"
#include "sightline/world.h"

#endif
