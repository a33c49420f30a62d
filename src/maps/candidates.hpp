// The models that a rock file and its table leave to choose from.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "records/evidence.hpp"
#include "records/finding.hpp"

namespace phy::maps {

/// A rock with one model; nothing: the matrix that it has. Directions: of parallel bonds in which the moment
/// counts little, since with moment contribution 1 bonds break at the rim and hardly feel the directions of
/// their shear strength. Bridges: contact by contact, where a recipe does not state the length of patches.
/// Another matrix is as stiff as the one before.
Rock with_model(Rock rock, LayerModel layers, std::optional<MatrixModel> matrix);

/// The model of a rock that has one.
const RockModel& model_of(const Rock& rock);

/// The rock with every model that its file and table leave to choose from, of planes with bridges one for
/// each of some shares that may be jointed, unless a recipe states it; the first is taken where nothing can
/// be compared. Layers take four strengths without confinement, UCS among them, so that one can be left out;
/// flat joints UCS and tension, whose ratio is what they differ in. Where somebody has not asked for one,
/// only models that were mapped are compared: of others nothing is expected before a test.
std::vector<Rock> candidates_of(const Evidence& evidence);

/// "joints on planes", "joints on 0.6 of the planes", "flat joints".
std::string model_in_words(const Rock& rock);
/// All, the shares of the planes in one: "joints on planes; joints on 0.8, 0.65 of the planes".
std::string models_in_words(const std::vector<Rock>& models);
/// `share_assumed`: of the planes, that nobody has stated and no table shows; nothing: there is none.
std::optional<Finding> assumed_share(const Rock& read, const std::vector<Rock>& candidates);

}  // namespace phy::maps
