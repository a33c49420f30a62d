// Confining stresses of the command line.
#pragma once
#include <string>
#include <vector>

namespace phy::cli {

/// At least three, each once, in rising order [Pa]; InputError with every word that is none. `option`: as it
/// was typed, "--confining".
std::vector<double> read_stresses(const std::string& option, const std::vector<std::string>& words);

/// "5 MPa", as folders and lines name a stress.
std::string stress_text(double stress);

}  // namespace phy::cli
