// How parameters are found: by a posterior, this program's own way, or in the paper's sequence. The one place
// that knows both; everything else asks the object.
#pragma once
#include <vector>

#include "calibrate/elastic_fit.hpp"
#include "calibrate/options.hpp"
#include "calibrate/strength_stage.hpp"

namespace phy::calibrate {

/// What a fit of the moduli goes by.
struct ModuliTask {
  const Evidence& evidence;
  const std::vector<std::int64_t>& packings;
  const std::vector<std::int64_t>& spare;  ///< more of them, where they differ much
  Simulator& simulator;
  const Listener& listener;
};

struct Method {
  bool has_posterior;    ///< intervals, draws, and what the data leave open; an effort of the search
  bool compares_models;  ///< where a rock file leaves open which one
  bool needs_ucs;        ///< other strengths alone show it no strength
  /// Throws InputError with all that it cannot work with.
  void (*check)(const Evidence& evidence);
  ElasticFit (*fit_moduli)(const ModuliTask& task);
  /// Throws Stopped; the fit then holds what was known.
  void (*fit_strengths)(const SearchTask& task, StrengthFit& fit);
};
const Method& method_of(CalibrationMethod id);

}  // namespace phy::calibrate
