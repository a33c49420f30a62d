// `phyllite elastic RECIPE`: E(theta), nu(theta), joint stiffnesses and sensitivities without time stepping.
#pragma once
#include "cli/commands.hpp"

namespace phy {

void add_elastic_command(CLI::App& app, Session& session);

}  // namespace phy
