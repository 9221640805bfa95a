// The visible region beside that of CGAL's exact triangular expansion: area for area, and time for
// time in one run.
//   compare_region MAP...    on map files with axial walls, as `sightline generate office` makes
//   them
// CSV: machine, map, corners, queries, of them on corners, on walls and in line with walls, those
// that CGAL has no answer to (free ends of walls), the largest relative difference of areas, how
// many are over 1e-12; then, for 2000 random eyes, each once: microseconds a query here and there,
// and their ratio. Exit status 1 on any difference over 1e-12.
// Timed is, here, location, region and polygon; there, with the location given, the region.
#include "sightline/io.h"
#include "sightline/sightline.h"
#include "sightline/support.h"

#include <CGAL/Arr_naive_point_location.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arr_trapezoid_ric_point_location.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangular_expansion_visibility_2.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <sys/utsname.h>
#include <vector>

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_2;
using Traits = CGAL::Arr_segment_traits_2<Kernel>;
using Arrangement = CGAL::Arrangement_2<Traits>;
using Face = Arrangement::Face_const_handle;
using Halfedge = Arrangement::Halfedge_const_handle;
using Vertex = Arrangement::Vertex_const_handle;
using Visibility = CGAL::Triangular_expansion_visibility_2<Arrangement, CGAL::Tag_true>;
using Location = CGAL::Arr_trapezoid_ric_point_location<Arrangement>;
using Clock = std::chrono::steady_clock;

namespace {

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Quarter turns from +x of an axial direction.
int quarter(const Point &from, const Point &to) {
    if (to.x() != from.x()) return to.x() > from.x() ? 0 : 2;
    return to.y() > from.y() ? 1 : 3;
}

/// A question to CGAL: the eye, and the face or the halfedge that it looks from.
struct Question {
    Point eye;
    Face face;
    Halfedge edge;
    bool on_edge = false;
};

/// Of an eye on walls the region is that of the quadrant where sl_space_locate finds it.
class Asker {
  public:
    Asker(const Arrangement &arrangement, const sl_box &bounds)
        : arrangement_(arrangement), location_(arrangement), bounds_(bounds) {
    }

    Question ask(sl_point eye) const {
        Question q{Point(eye.x, eye.y), {}, {}, false};
        const auto found = location_.locate(q.eye);
        if (const Face *face = boost::get<Face>(&found)) {
            q.face = *face;
            return q;
        }
        q.on_edge = true;
        const int home = quadrant(eye);
        if (const Halfedge *edge = boost::get<Halfedge>(&found))
            q.edge =
                holds(quarter(q.eye, (*edge)->target()->point()), home) ? *edge : (*edge)->twin();
        else
            q.edge = at_vertex(*boost::get<Vertex>(&found), home);
        return q;
    }

  private:
    /// Quadrant k lies between quarter k and quarter k + 1.
    int quadrant(sl_point eye) const {
        const bool left = eye.x == bounds_.max.x, lower = eye.y == bounds_.max.y;
        return lower ? (left ? 2 : 3) : (left ? 1 : 0);
    }

    /// Whether a quadrant lies to the left of a line in this direction.
    static bool holds(int direction, int quadrant) {
        return quadrant == direction || quadrant == (direction + 1) % 4;
    }

    /// The halfedge to the vertex whose face, at the vertex, holds the quadrant.
    static Halfedge at_vertex(Vertex v, int quadrant) {
        auto first = v->incident_halfedges(), e = first;
        do {
            Halfedge in = e;
            const int from = quarter(v->point(), in->next()->target()->point());
            const int to = quarter(v->point(), in->source()->point());
            const int span = (to - from + 4) % 4 ? (to - from + 4) % 4 : 4;
            if ((quadrant - from + 4) % 4 < span) return in;
        } while (++e != first);
        std::abort();
    }

    const Arrangement &arrangement_;
    Location location_;
    sl_box bounds_;
};

/// CGAL's region as a face of `out`.
Arrangement::Face_handle see(const Visibility &visibility, const Question &q, Arrangement &out) {
    return q.on_edge ? visibility.compute_visibility(q.eye, q.edge, out)
                     : visibility.compute_visibility(q.eye, q.face, out);
}

double exact_area(Arrangement::Face_handle face) {
    Kernel::FT twice = 0;
    auto first = face->outer_ccb(), e = first;
    do {
        const Point &a = e->source()->point(), &b = e->target()->point();
        twice += a.x() * b.y() - a.y() * b.x();
    } while (++e != first);
    return std::fabs(CGAL::to_double(twice.exact())) / 2;
}

struct Floor {
    sl_context *context;
    sl_map map{};
    sl_space space{};
    sl_outline outline{};
    Arrangement arrangement;

    explicit Floor(sl_context *c) : context(c) {
    }
    ~Floor() {
        sl_outline_destroy(context, &outline);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    void must(sl_status status) const {
        if (status == SL_OK) return;
        std::fprintf(stderr, "compare_region: %s\n", sl_context_message(context));
        std::exit(2);
    }
    /// All that follows from the map.
    void finish() {
        must(sl_map_clean(context, &map, nullptr, nullptr));
        must(sl_subdivision_for(&map)->subdivide(context, &map, nullptr, &space));
        must(sl_outline_make(context, &space, &outline));
        std::vector<Traits::Curve_2> segments;
        for (uint32_t i = 0; i < space.wall_count; i++)
            add(segments, space.walls[i].a, space.walls[i].b);
        const sl_box &b = space.bounds;
        const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
        for (int i = 0; i < 4; i++) add(segments, corners[i], corners[(i + 1) % 4]);
        CGAL::insert(arrangement, segments.begin(), segments.end());
    }
    static void add(std::vector<Traits::Curve_2> &segments, sl_point a, sl_point b) {
        segments.emplace_back(Point(a.x, a.y), Point(b.x, b.y));
    }
};

double between(sl_random &random, double low, double high) {
    return low + sl_random_unit(&random) * (high - low);
}

struct Eyes {
    std::vector<sl_point> all;
    size_t random = 0, on_corners = 0, on_walls = 0, in_line = 0;
};

Eyes choose_eyes(const sl_space &space) {
    Eyes eyes;
    sl_random random = {11};
    const sl_box &b = space.bounds;
    for (int i = 0; i < 1000; i++) {
        const sl_wall &w = space.walls[sl_random_below(&random, space.wall_count)];
        const sl_wall &other = space.walls[sl_random_below(&random, space.wall_count)];
        sl_point eye = {between(random, b.min.x, b.max.x), between(random, b.min.y, b.max.y)};
        if (i >= 850) {
            eye = {w.a.x, other.b.y};
            eyes.in_line++;
        } else if (i >= 600) {
            eye = i % 2 ? sl_point{w.a.x, eye.y} : sl_point{eye.x, w.a.y};
            eyes.in_line++;
        } else if (i >= 500) {
            const double share = sl_random_unit(&random);
            eye = {w.a.x + share * (w.b.x - w.a.x), w.a.y + share * (w.b.y - w.a.y)};
            eyes.on_walls++;
        } else if (i >= 400) {
            eye = w.a;
            eyes.on_corners++;
        } else
            eyes.random++;
        eyes.all.push_back(eye);
    }
    return eyes;
}

/// Whether CGAL has no answer: at a free end of a wall it gives a region without area.
bool is_free_end(const Question &q) {
    return q.on_edge && q.edge->target()->point() == q.eye && q.edge->target()->degree() == 1;
}

struct Times {
    double here = 0, there = 0; ///< seconds a query
};

/// Random eyes, shuffled as they come; each once here, then each once there.
Times measure(Floor &floor, const Asker &asker, const Visibility &visibility) {
    constexpr int queries = 2000;
    std::vector<sl_point> eyes;
    std::vector<Question> questions;
    sl_random random = {13};
    const sl_box &b = floor.space.bounds;
    for (int i = 0; i < queries; i++) {
        eyes.push_back({between(random, b.min.x, b.max.x), between(random, b.min.y, b.max.y)});
        questions.push_back(asker.ask(eyes.back()));
    }
    Times times;
    sl_region region{};
    Clock::time_point start = Clock::now();
    for (const sl_point eye : eyes) {
        const sl_view view = sl_view_all_round(eye);
        floor.must(sl_region_make(floor.context, &floor.outline, &view, 0, &region));
    }
    times.here = seconds_since(start) / queries;
    sl_region_destroy(floor.context, &region);
    start = Clock::now();
    for (const Question &q : questions) {
        Arrangement out;
        see(visibility, q, out);
    }
    times.there = seconds_since(start) / queries;
    return times;
}

/// One row of the table; the number of failures.
int compare(const char *machine, const std::string &name, Floor &floor) {
    const Visibility visibility(floor.arrangement);
    const Asker asker(floor.arrangement, floor.space.bounds);
    const Eyes eyes = choose_eyes(floor.space);
    double worst = 0;
    int failures = 0, left_out = 0;
    sl_region region{};
    for (const sl_point eye : eyes.all) {
        const sl_view view = sl_view_all_round(eye);
        const Question question = asker.ask(eye);
        floor.must(sl_region_make(floor.context, &floor.outline, &view, 0, &region));
        if (is_free_end(question)) {
            left_out++;
            continue;
        }
        Arrangement out;
        const double expected = exact_area(see(visibility, question, out));
        const double found = sl_region_area(&region), off = std::fabs(found - expected) / expected;
        worst = std::fmax(worst, off);
        if (off <= 1e-12) continue;
        failures++;
        std::fprintf(stderr, "%s: eye %.17g %.17g: area %.17g, by CGAL %.17g\n", name.c_str(),
                     eye.x, eye.y, found, expected);
    }
    sl_region_destroy(floor.context, &region);
    const Times times = measure(floor, asker, visibility);
    std::printf("%s,%s,%zu,%zu,%zu,%zu,%zu,%d,%.2g,%d,%.3f,%.1f,%.1f\n", machine, name.c_str(),
                floor.arrangement.number_of_vertices(), eyes.all.size(), eyes.on_corners,
                eyes.on_walls, eyes.in_line, left_out, worst, failures, 1e6 * times.here,
                1e6 * times.there, times.there / times.here);
    std::fflush(stdout);
    return failures;
}

} // namespace

int main(int argc, char **argv) {
    if (argc < 2) {
        std::fputs("usage: compare_region MAP...\n", stderr);
        return 2;
    }
    struct utsname name;
    const char *machine = uname(&name) == 0 ? name.nodename : "?";
    sl_context *context = sl_context_create(nullptr);
    std::puts("machine,map,corners,queries,on_corners,on_walls,in_line,left_out,worst_difference,"
              "failures,"
              "us_here,us_cgal,ratio");
    int failures = 0;
    for (int i = 1; i < argc; i++) {
        Floor floor(context);
        const sl_import_options options = sl_import_options_default();
        floor.must(sl_io_use(context));
        floor.must(sl_map_read(context, argv[i], &options, &floor.map));
        floor.finish();
        failures += compare(machine, argv[i], floor);
    }
    sl_context_destroy(context);
    return failures ? 1 : 0;
}
