// Which model a rock is given: what makes its layers and what holds its grains together. Taken is the model
// whose expectation (prior_regression.hpp), fitted to all values of the table but one, predicts that one
// better. Fit alone would always prefer the model with more parameters; but one that misses E by so much that
// no calibration by it ends within reach gives way to any that does not, and one that contains another has to
// be better by a tenth.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "maps/candidates.hpp"
#include "records/calibration.hpp"

namespace phy::maps {

struct Rival {
  Rock rock;
  double modulus_error = 0.0;   ///< of E, as fitted on one packing (three with bridges), root mean square
  double strength_error = 0.0;  ///< of strengths that were left out
  double error = 0.0;           ///< of both together
  /// An E that is missed by more than 6 % and than scatter explains: out of reach, whatever its strengths.
  bool misses_modulus = false;
  bool has_modulus() const;  ///< within 6 %, root mean square
  const RockModel& model() const { return model_of(rock); }
};

/// Is a rock with one model forecast to meet its table (forecast.hpp)?
using ForecastMet = std::function<bool(const Rock&)>;

struct ModelChoice {
  std::vector<Rival> rivals;  ///< in the order of the candidates
  std::size_t best = 0;       ///< of them
  /// The next candidate, which may take the place of the best.
  void add(Rival rival, const ForecastMet& meets);
  const Rock& rock() const { return rivals[best].rock; }
  /// The model that is taken, the errors of all, and the rules that kept others back.
  std::vector<Finding> findings() const;
  /// The best model of every other kind that predicts nearly as well, the nearest first.
  std::vector<const Rival*> near_ones() const;
  /// `rival_model`: how a user asks for one of them, and why.
  Finding asked_for(const Rival& rival) const;
  /// Which shares of the planes may be jointed where one of the models is taken: from the next share below
  /// all that predict nearly as well to the next above. Nothing: it has no joints on a share, or no other
  /// share was compared.
  std::optional<ParameterEstimate> share(const Rival& taken) const;
  std::optional<ParameterEstimate> share() const { return share(rivals[best]); }
};

/// What an interval of a share rests on.
Finding share_interval(const ParameterEstimate& share);

}  // namespace phy::maps
