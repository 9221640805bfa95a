// Ways by the authors' Polyanya, for route_polyanya.mjs: the length (-1: none) and the microseconds
// of each pair of places, a line each.
//
//   route_polyanya MESH PAIRS.csv
//
// Built in a copy of bshen95/End-Point-Search, which has their search:
//   c++ -std=c++14 -O3 -DNDEBUG -fopenmp -include stack -I helpers -I search -I structs -o POLYANYA
//       route_polyanya.cpp search/searchinstance.cpp search/expansion.cpp structs/mesh.cpp
//       structs/graph.cpp helpers/geometry.cpp helpers/timer.cpp helpers/cfg.cpp
#include "mesh.h"
#include "searchinstance.h"

#include <cstdio>
#include <ctime>
#include <fstream>

static double microseconds() {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

int main(int argc, char **argv) {
    if (argc != 3) return 2;
    std::ifstream file(argv[1]);
    polyanya::Mesh mesh(file);
    polyanya::SearchInstance search(&mesh);
    std::FILE *pairs = std::fopen(argv[2], "r");
    double x, y, to_x, to_y;
    if (!pairs) return 2;
    while (std::fscanf(pairs, "%lf,%lf,%lf,%lf", &x, &y, &to_x, &to_y) == 4) {
        const double start = microseconds();
        search.set_start_goal({x, y}, {to_x, to_y});
        const bool found = search.search();
        const double took = microseconds() - start;
        std::printf("%.17g,%.3f\n", found ? search.get_cost() : -1, took);
    }
    std::fclose(pairs);
    return 0;
}
