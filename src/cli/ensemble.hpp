// `--ensemble` of the verbs `run` and `envelope`: one test on every draw of a calibration, and the band of
// all draws (study/band.hpp).
#pragma once
#include <string>
#include <vector>

#include "calibrate/simulator.hpp"
#include "cli/commands.hpp"
#include "cli/progress.hpp"

namespace phy::cli {

struct EnsembleArguments {
  std::vector<std::string> recipes;  ///< of the command line; one is wanted
  std::string out;
  bool with_untrusted = false;
};

/// The test of the recipe, on the draws that lie beside it. With confining stresses [Pa]: biaxial tests under
/// each of them, and the envelopes that fit them. The exit code.
int run_ensemble(const EnsembleArguments& args, const Session& session,
                 const std::vector<double>& confining = {});

/// This program's own tests of draws, kept in a store of `folder`: the same command goes on with them.
calibrate::SimulatorOptions tests_in(const std::string& folder, bool with_untrusted, const Session& session,
                                     ProgressLine& line);
/// After Ctrl-C; the exit code.
int tell_stopped(const std::string& folder, int width);

}  // namespace phy::cli
