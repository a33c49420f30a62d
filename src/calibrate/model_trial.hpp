// What the choice of a model (maps/model_choice.hpp) rests on: moduli by the direct solution, and every
// strength predicted from the others by what is expected of the model, before any test.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "calibrate/simulator.hpp"
#include "maps/model_choice.hpp"

namespace phy::calibrate {

/// Packings for the moduli of models with bridges, whose specimens differ more.
constexpr std::int64_t bridged_packings = 3;

/// Of the candidates, two or more.
maps::ModelChoice choose_model(const Evidence& evidence, const std::vector<Rock>& candidates,
                               std::int64_t seed, Simulator& simulator,
                               const std::function<void(const Finding&)>& begins);

}  // namespace phy::calibrate
