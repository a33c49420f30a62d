// Which model a rock is given: what makes its layers and what holds its grains together. Taken is the model
// whose expectation (prior_regression.hpp), fitted to all values of the table but one, predicts that one
// better. Fit alone would always prefer the model with more parameters; but one that misses E by so much that
// no calibration by it ends within reach gives way to any that does not, and one that contains another has to
// be better by a tenth.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/evidence.hpp"
#include "calibrate/simulator.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

/// A rock with one model; nothing: the matrix that it has. Directions: of parallel bonds in which the moment
/// counts little, since with moment contribution 1 bonds break at the rim and hardly feel the directions of
/// their shear strength. Bridges: contact by contact, where a recipe does not state the length of patches.
/// Another matrix is as stiff as the one before.
Rock with_model(Rock rock, LayerModel layers, std::optional<MatrixModel> matrix);

/// The rock with every model that its file and table leave to choose from, of planes with bridges one for
/// each of some shares that may be jointed, unless a recipe states it; the first is taken where nothing can
/// be compared. Layers take four strengths without confinement, UCS among them, so that one can be left out;
/// flat joints, which have neither directions nor bridges, UCS and tension, whose ratio is what they differ
/// in.
std::vector<Rock> candidates_of(const Evidence& evidence);

/// "joints on planes", "directions of the bonds", "joints on 0.6 of the planes", "flat joints".
std::string model_in_words(const Rock& rock);
/// All, the shares of the planes in one: "joints on planes; joints on 0.8, 0.65 of the planes".
std::string models_in_words(const std::vector<Rock>& models);
/// `share_assumed`: of the planes, that nobody has stated and no table shows; nothing: there is none.
std::optional<Finding> assumed_share(const Rock& read, const std::vector<Rock>& candidates);

struct Rival {
  Rock rock;
  double modulus_error = 0.0;   ///< of E, as fitted on one packing (three with bridges), root mean square
  double strength_error = 0.0;  ///< of strengths that were left out
  double error = 0.0;           ///< of both together
  /// An E that is missed by more than 6 % and than scatter explains: out of reach, whatever its strengths.
  bool misses_modulus = false;
  bool has_E() const;  ///< within 6 %, root mean square
};

struct ModelChoice {
  std::vector<Rival> rivals;  ///< in the order of the candidates
  std::size_t best = 0;       ///< of them
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

/// Of the candidates, two or more.
ModelChoice choose_model(const Evidence& evidence, const std::vector<Rock>& candidates, std::int64_t seed,
                         Simulator& simulator, const std::function<void(const std::string&)>& say);

}  // namespace phy::calibrate
