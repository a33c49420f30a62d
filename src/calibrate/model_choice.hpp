// What makes a rock's layers: the model whose expectation (prior_regression.hpp), fitted to all values of the
// table but one, predicts that one better. Fit alone would always prefer the model with more parameters.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "calibrate/evidence.hpp"
#include "calibrate/simulator.hpp"

namespace phy::calibrate {

/// A rock with the layers of one model. Directions: of parallel bonds in which the moment counts little,
/// since with moment contribution 1 bonds break at the rim and hardly feel the directions of their shear
/// strength.
Rock with_layers(Rock rock, LayerModel layers);

struct Rival {
  LayerModel layers;
  double modulus_error = 0.0;   ///< of E, as fitted on one packing, root mean square
  double strength_error = 0.0;  ///< of strengths that were left out
  double error = 0.0;           ///< of both together
};

struct ModelChoice {
  LayerModel layers = LayerModel::planes;
  std::vector<Rival> rivals;     ///< empty: nothing was compared
  std::int64_t n_solutions = 0;  ///< of the direct solution
  std::string text() const;      ///< one sentence with all errors; "" where nothing was compared
};

/// Does the table hold strengths enough, of tests that were mapped, that one can be left out: four, UCS among
/// them?
bool can_choose(const Evidence& evidence);

/// Planes where it does not.
ModelChoice choose_layers(const Evidence& evidence, std::int64_t seed, Simulator& simulator,
                          const std::function<void(const std::string&)>& say);

}  // namespace phy::calibrate
