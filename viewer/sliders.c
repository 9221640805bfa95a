#include "sliders.h"

#include "layers.h"
#include "mirrors.h"
#include "range.h"
#include "shelf.h"

#include <math.h>
#include <stdio.h>

// --- the view cone: finer where it is narrow

static bool always(const sl_app *app) {
    (void)app;
    return true;
}

static double cone_share(const sl_app *app) {
    return sqrt((app->eye.fov - 1) / 359);
}

static void cone_text(const sl_app *app, char text[SL_SLIDER_TEXT]) {
    snprintf(text, SL_SLIDER_TEXT, "%.0f\xc2\xb0", app->eye.fov);
}

static void set_cone(sl_app *app, double share) {
    app->eye.fov = round(1 + 359 * share * share);
}

// --- the height at which a 3D model is cut

static bool is_model(const sl_app *app) {
    return app->document.source.highest > app->document.source.lowest;
}

static double cut_share(const sl_app *app) {
    const sl_document_source *s = &app->document.source;
    return (s->options.slice - s->lowest) / (s->highest - s->lowest);
}

static void cut_text(const sl_app *app, char text[SL_SLIDER_TEXT]) {
    snprintf(text, SL_SLIDER_TEXT, "%.5g", app->document.source.options.slice);
}

static void set_cut(sl_app *app, double share) {
    const sl_document_source *source = &app->document.source;
    sl_import_options options = source->options;
    options.slice = source->lowest + share * (source->highest - source->lowest);
    if (options.slice != source->options.slice) sl_shelf_open_again(app, &options);
}

// --- how deep splits are shown

static bool has_splits(const sl_app *app) {
    return app->document.baked && sl_layers_shows(app, SL_LAYER_NUMBER_SPLITS);
}

static double deepest_split(const sl_app *app) {
    return fmax(app->document.baked->space.tree_depth, 1);
}

static double split_share(const sl_app *app) {
    return app->split_depth / deepest_split(app);
}

static void split_text(const sl_app *app, char text[SL_SLIDER_TEXT]) {
    snprintf(text, SL_SLIDER_TEXT, "%.0f", fmin(app->split_depth, deepest_split(app)));
}

static void set_split(sl_app *app, double share) {
    app->split_depth = (uint32_t)fmax(1, round(share * deepest_split(app)));
}

// --- how far the stab tree is grown

static bool has_tree(const sl_app *app) {
    return app->show & SL_SHOW_TREE && app->tree;
}

static double tree_share(const sl_app *app) {
    return app->tree_depth / fmax(sl_scene_tree_depth(app->tree), 1);
}

static void tree_text(const sl_app *app, char text[SL_SLIDER_TEXT]) {
    snprintf(text, SL_SLIDER_TEXT, "%.0f", fmin(app->tree_depth, sl_scene_tree_depth(app->tree)));
}

static void set_tree(sl_app *app, double share) {
    app->tree_depth = (uint32_t)round(share * sl_scene_tree_depth(app->tree));
}

// --- the walk through the merge history: from one view cell to all elementary ones, finer where
// there are few

static bool has_views(const sl_app *app) {
    return app->show & SL_SHOW_VIEWS && sl_view_layer_most(app->views) > 1;
}

static double views_share(const sl_app *app) {
    return log(sl_view_layer_shown(app->views)) / log(sl_view_layer_most(app->views));
}

static void views_text(const sl_app *app, char text[SL_SLIDER_TEXT]) {
    snprintf(text, SL_SLIDER_TEXT, "%u", sl_view_layer_shown(app->views));
}

static void set_views(sl_app *app, double share) {
    const double most = sl_view_layer_most(app->views);
    sl_view_layer_go(app, (uint32_t)round(pow(most, share)));
}

// --- the view range, finer where it is short

static bool has_range(const sl_app *app) {
    return app->document.baked && app->document.map.range > 0;
}

static double range_share(const sl_app *app) {
    return sqrt(fmin(app->document.map.range / sl_range_most(app), 1));
}

static void range_text(const sl_app *app, char text[SL_SLIDER_TEXT]) {
    snprintf(text, SL_SLIDER_TEXT, "%.3g", app->document.map.range);
}

static void set_range(sl_app *app, double share) {
    sl_range_set(app, share * share * sl_range_most(app));
}

// --- how often a sightline is reflected

static bool has_mirrors(const sl_app *app) {
    return app->document.baked && app->document.map.mirror_count;
}

static double depth_share(const sl_app *app) {
    return (double)app->document.mirror_depth / SL_MIRROR_DEPTH_MOST;
}

static void depth_text(const sl_app *app, char text[SL_SLIDER_TEXT]) {
    snprintf(text, SL_SLIDER_TEXT, "%u", app->document.mirror_depth);
}

static void set_depth(sl_app *app, double share) {
    sl_mirror_set_depth(app, (uint32_t)round(share * SL_MIRROR_DEPTH_MOST));
}

static const sl_slider sliders[] = {
    {"View cone", always, cone_share, cone_text, set_cone, NULL, NULL},
    {"View range", has_range, range_share, range_text, set_range, sl_app_keep, sl_range_settle},
    {"Reflections", has_mirrors, depth_share, depth_text, set_depth, NULL, sl_mirror_settle_depth},
    {"Cut at", is_model, cut_share, cut_text, set_cut, NULL, NULL},
    {"Split depth", has_splits, split_share, split_text, set_split, NULL, NULL},
    {"Tree grown", has_tree, tree_share, tree_text, set_tree, NULL, NULL},
    {"View cells", has_views, views_share, views_text, set_views, NULL, NULL},
};

const sl_slider *sl_sliders(size_t *count) {
    *count = sizeof sliders / sizeof *sliders;
    return sliders;
}
