// E and nu of a recipe by the direct solution, at the angles of a table, on as many packings as asked for.
#pragma once
#include <cstdint>
#include <map>
#include <vector>

#include "calibrate/simulator.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

/// On the packing of a seed, with bridges, where there are any, and bond strengths of its own: where they lie
/// is of a specimen, not of the rock.
void take_packing(Recipe& recipe, std::int64_t seed);

/// The recipe's one specimen at an angle of the table, on the packing of a seed.
Recipe single_at(const Recipe& recipe, double theta, std::int64_t seed);

/// What a target of E or nu is compared with.
double reading_of(const ElasticResult& solution, Property property);

/// By the angle of the targets, each list in the order of the packings.
using Solutions = std::map<double, std::vector<ElasticResult>>;
Solutions solve_angles(const Recipe& recipe, const std::vector<Target>& moduli,
                       const std::vector<std::int64_t>& seeds, Statics what, Simulator& simulator);

/// Mean E and nu at the targets.
std::vector<Comparison> over_packings(const Solutions& solutions, const std::vector<Target>& moduli);

/// The same over the packings `seeds`, one-sided contacts.
std::vector<Comparison> elastic_response(const Recipe& recipe, const std::vector<Target>& moduli,
                                         const std::vector<std::int64_t>& seeds, Simulator& simulator);

}  // namespace phy::calibrate
