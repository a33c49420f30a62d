// `phyllite design`: the tests of the draws of a calibration, and all files that come of them.
#pragma once
#include <string>
#include <vector>

#include "calibrate/simulator.hpp"
#include "design/design.hpp"

namespace phy::jobs {

struct DesignRequest {
  std::string calibration;       ///< its folder, or the calibrated.toml in it
  std::vector<double> stresses;  ///< [Pa] three or more, rising
  std::size_t n_draws = 0;       ///< 0: all that the calibration has left
  design::ElasticReadingOf2D reading = {};
  double dip = 0.0;          ///< [deg]
  bool model_alone = false;  ///< without what the model misses of its table
  std::string out;
};

/// A request that was found to make sense: recipe and draws of the calibration.
struct DesignPlan {
  DesignRequest request;
  Recipe recipe;
  std::vector<Recipe> draws;
  Calibration calibration;
  std::vector<Target> cells;  ///< strengths in compression of the table, whose misfit corrects the draws
  bool sought = true;         ///< strengths were fitted to the rock; else none is tested

  std::size_t n_tests() const;  ///< in compression and tension
};

/// Reads the calibration. Throws InputError where it has no draws, its rock no layers, or where files of
/// somebody else are in the way.
DesignPlan plan_design(const DesignRequest& request);

/// Runs what the simulator's store does not hold, and fits. May throw calibrate::Stopped.
design::Design run_design(const DesignPlan& plan, calibrate::Simulator& simulator);

/// design.csv, covariance.csv, tests.csv, design.json, report.html, and the file of each code whose constants
/// are known. The names of the files.
std::vector<std::string> write_design(const std::string& folder, const design::Design& design);

}  // namespace phy::jobs
