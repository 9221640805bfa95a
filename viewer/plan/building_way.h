/// The shortest way between two places of a building, over the links between its storeys. One of
/// them is shown at a time; the ends may be on others.
#ifndef VIEWER_BUILDING_WAY_H
#define VIEWER_BUILDING_WAY_H

#include "plan/view.h"
#include "sightline/building_route.h"

struct building_way {
    char *path;               ///< of the building
    sl_building building;     ///< the job's while it runs; likewise the rest
    document_source *sources; ///< by storey: how its plan is read
    double walker;
    sl_building_place ends[2];
    sl_building_route route;
    char unit[16]; ///< of the plans
    task *task;    ///< NULL: none runs
    int clicks;    ///< 1: the begin is there, 2: both ends
    bool made;
};

/// The ends are clicked, one after the other. Needs a building (view->building).
void building_way_click(view_state *view, sl_point at);
/// Takes the end of the work; finds it anew for another walker. Forgets a way of another building.
void building_way_update(view_state *view, bool wait);
job_progress building_way_progress(const view_state *view);
/// NULL: no end is there.
const struct building_way *building_way_shown(const view_state *view);
/// The number of the storey that is open; SL_NO_STOREY for none of the building.
size_t building_way_storey(const view_state *view);
void building_way_draw(const view_state *view, const sl_frame *frame);
bool building_way_clear(view_state *view); ///< false: there was nothing

#endif
