// The sweep of `phyllite elastic`: K_n(k_n) and K_s(k_s) beside the paper's Eq. 2.
#pragma once
#include <string>

#include "records/recipe.hpp"

namespace phy::cli {

/// Runs recipe.sweep (of the recipe read from `path`, and of the one that it names in `also`), prints the
/// lines for a terminal of so many columns, writes lines.csv, fig4.csv and moduli.csv into the folder `out`.
/// Returns the exit code.
int run_elastic_sweep(const Recipe& recipe, const std::string& path, const std::string& out, int threads,
                      int terminal_width);

}  // namespace phy::cli
