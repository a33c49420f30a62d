// The stages of a calibration by one model: each a function from what the one before has found to what it
// finds itself (calibration.cpp puts them in order). All throw Stopped where the user stops.
#pragma once
#include <vector>

#include "calibrate/elastic_fit.hpp"
#include "calibrate/method.hpp"
#include "calibrate/plan.hpp"

namespace phy::calibrate {

/// What all stages go by.
struct StageTask {
  const Evidence& evidence;
  const CalibrationOptions& options;
  const Scope& scope;
  const Packings& packings;
  Simulator& simulator;
  std::int64_t first_test;  ///< in compression, of this model

  std::int64_t spent() const { return simulator.count().compression() - first_test; }
  const Method& method() const { return method_of(options.method); }
};

/// Moduli of small strain: the fit, and what it has on unseen packings.
struct Moduli {
  ElasticFit fit;
  std::vector<Comparison> unseen;  ///< means over all unseen packings
  std::vector<Comparison> first;   ///< of these, the first one alone
};
Moduli fit_moduli(const StageTask& task);
/// What a recipe has on unseen packings, `fit` as it was.
Moduli on_packings(const StageTask& task, ElasticFit fit, const Recipe& recipe,
                   const std::vector<std::int64_t>& unseen);

/// Strengths, and the moduli as they were fitted anew, since tests soften them.
struct Strengths {
  ElasticFit moduli;
  StrengthFit fit;
  bool answered() const { return fit.findings.empty(); }
};
/// `found`: empty; where the user stops, it holds what was known.
void fit_strengths(const StageTask& task, const ElasticFit& moduli, Strengths& found);

/// Measurements of what tests make of the moduli, at most.
constexpr int most_softenings = 4;

/// With what tests make of the moduli measured at the estimate, and the moduli that follow from it, in turn
/// until E as it is read is settled.
Strengths with_measured_softening(const StageTask& task, Strengths found);

}  // namespace phy::calibrate
