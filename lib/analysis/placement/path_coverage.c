/// The parts of a path that no viewpoint sees: cut by the viewpoints' regions, ranges and discs.
#include "sightline/coverage.h"

#include "analysis/placement/path_cut.h"
#include "analysis/placement/view_shapes.h"

typedef struct watch {
    sl_query *query;
    const sl_coverage *coverage;
    const sl_viewpoint *viewpoints;
    sl_view *views; ///< by viewpoint
} watch;

static sl_status cut(sli_path_cut *c, sl_point p, sl_point q) {
    const watch *w = c->of;
    for (size_t i = 0; i < w->coverage->count; i++) {
        const sl_viewpoint *v = &w->viewpoints[i];
        const sl_point eye = w->views[i].eye;
        SL_TRY(sli_cut_by_shape(c, p, q, &w->coverage->regions[i]));
        SL_TRY(sli_cut_by_circle(c, p, q, eye, sli_view_range(w->query, v)));
        SL_TRY(sli_cut_by_circle(c, p, q, eye, v->nearest));
        if (v->sign) SL_TRY(sli_cut_by_circle(c, p, q, sli_sign_middle(eye, v), v->range / 2));
    }
    return SL_OK;
}

static sl_status is_unseen(sli_path_cut *c, sl_point at, bool *out) {
    const watch *w = c->of;
    bool seen = false;
    for (size_t i = 0; i < w->coverage->count && !seen; i++) {
        sl_viewpoint v = w->viewpoints[i];
        if (!v.sign) v.range = sli_view_range(w->query, &v);
        if (!sli_viewpoint_holds(&v, &w->views[i], at)) continue;
        SL_TRY(sl_query_sees(c->context, w->query, w->views[i].eye, at, &seen));
    }
    *out = !seen;
    return SL_OK;
}

sl_status sl_coverage_of_path(sl_context *context, sl_query *query, const sl_coverage *coverage,
                              const sl_viewpoint *viewpoints, const sl_point *path, size_t count,
                              sl_path_parts *out) {
    watch w = {.query = query, .coverage = coverage, .viewpoints = viewpoints};
    sli_path_cut c = {.context = context, .cut = cut, .holds = is_unseen, .of = &w};
    *out = (sl_path_parts){0};
    SL_TRY(sl_query_space(context, query, &c.space, NULL));
    w.views = sl_alloc_array(context, coverage->count + 1, sizeof *w.views);
    if (!w.views) return SL_NO_MEMORY;
    for (size_t i = 0; i < coverage->count; i++) {
        const sl_viewpoint *v = &viewpoints[i];
        w.views[i] = sl_query_view(query, sli_viewpoint_eye(c.space, v), v->heading, v->fov);
    }
    const sl_status status = sli_path_parts(&c, path, count, out);
    sl_free(context, w.views);
    return status;
}
