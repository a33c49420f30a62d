// The draws of a calibration, as they lie beside its recipe, and what the calibration misses of its table.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "calibrate/discrepancy.hpp"
#include "records/recipe.hpp"

namespace phy::jobs {

/// Of one draw nobody knows how far another lies.
constexpr std::size_t fewest_draws = 2;

/// The draws beside the recipe `path`, each with test and engine of `recipe`, which was read from there.
/// `asked`: what wants them, in messages. Throws InputError where some are missing or none are there.
std::vector<Recipe> read_draws(const std::string& path, const Recipe& recipe, const std::string& asked);

/// What the calibration beside a recipe misses of its table; nothing: it is not there, it fitted no strengths
/// or is of an earlier version.
std::optional<calibrate::Discrepancy> read_discrepancy(const std::string& path, std::size_t n_draws);

}  // namespace phy::jobs
