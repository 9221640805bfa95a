// What the number of sectors does to multipass: the fewer, the more cells are on cycles and have
// more candidates; the more, the more often a pair is found again.
//   bench_sectors MAP     CSV: machine, map, cells, portals, sectors, cells on cycles (over all
//                         sectors), candidates, relations, stabbing tests, times the tests of
//                         "prune", seconds, times those of "prune"
#include "bench.h"

#include "sightline/io.h"
#include "sightline/sightline.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

enum { ROUNDS = 3 };

/// The least processor time of some rounds, and what the last one counted.
static double measure(sl_context *context, const sl_space *space, const char *name,
                      uint32_t sectors, sl_see_account *account) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    size_t m = 0;
    while (m < count && strcmp(methods[m].name, name) != 0) m++;
    if (m == count) bench_fail("a method is missing");
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.threads = 1;
    options.sectors = sectors;
    double least = 0;
    for (int round = 0; round < ROUNDS; round++) {
        sl_visibility seen;
        const double start = bench_seconds();
        bench_must(context, methods[m].see(context, space, &options, &seen));
        const double seconds = bench_seconds() - start;
        if (round == 0 || seconds < least) least = seconds;
        *account = seen.account;
        sl_visibility_destroy(context, &seen);
    }
    return least;
}

int main(int argc, char **argv) {
    static const uint32_t numbers[] = {4, 6, 8, 12, 16, 24, 32, 64, 128, 256, 0};
    if (argc != 2) bench_fail("a map is to be given");
    sl_context *context = sl_context_create(NULL);
    struct utsname machine;
    sl_space space;
    if (!context || uname(&machine) != 0) bench_fail("no memory");
    bench_read_space(context, argv[1], NULL, &space);
    sl_see_account prune, account;
    const double prune_seconds = measure(context, &space, "prune", 0, &prune);
    puts("machine,map,cells,portals,sectors,on_cycles,candidates,relations,tests,times_prune_tests,"
         "seconds,times_prune_seconds");
    uint32_t last = 0;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const double seconds = measure(context, &space, "multipass", numbers[i], &account);
        if (account.multipass.sectors == last) continue;
        last = account.multipass.sectors;
        printf("%s,%s,%u,%u,%u,%llu,%llu,%llu,%llu,%.3f,%.6f,%.3f\n", machine.machine, argv[1],
               space.cell_count, space.portal_count, account.multipass.sectors,
               (unsigned long long)account.multipass.on_cycles,
               (unsigned long long)account.multipass.candidates,
               (unsigned long long)account.multipass.relations, (unsigned long long)account.tests,
               (double)account.tests / (double)prune.tests, seconds, seconds / prune_seconds);
    }
    sl_space_destroy(context, &space);
    sl_context_destroy(context);
    return 0;
}
