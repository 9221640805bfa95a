/// Registers the commands that need sightline_study.
#include "commands/commands.h"
#include "system/built.h"

static const built_command commands[] = {{"generate", cmd_generate},
                                         {"regions", cmd_regions},
                                         {"viewcells", cmd_viewcells},
                                         {"walk", cmd_walk},
                                         {0}};

const built_part with_study = {.commands = commands};
