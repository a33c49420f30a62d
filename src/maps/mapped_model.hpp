// Models of rock that were mapped, with the numbers that decide the shape of their answers.
//
// UCS/sigma_c, E/E_c and their course over the inclination are functions of dimensionless numbers alone:
// ratios of strengths and of moduli, frictions, scatter, spacing over grain size. A mapped model names those
// that were varied, each with its range, on a small specimen of some 1,300 discs. `make maps` runs a Sobol
// sequence over them and writes what came out into data/maps; the program holds those tables
// (maps/response_map.hpp).
#pragma once
#include <string>
#include <vector>

#include "records/parameters.hpp"
#include "records/rock_model.hpp"

namespace phy::maps {

/// A dimensionless number of a recipe and the range in which it was mapped.
struct MapVariable {
  const char* name;  ///< "tau_c/sigma_c": column of the table
  double low, high;
  bool logarithmic;
  double (*get)(const Recipe&) = nullptr;
  void (*set)(Recipe&, double) = nullptr;
  /// The parameter of a calibration that moves it; nullptr: none.
  const Parameter* parameter = nullptr;
  bool at_base = false;  ///< keeps the value of the base recipe in the second sequence

  /// Place of a value in the range, -1 at the lower end, 1 at the upper one, and back.
  double normalised(double value) const;
  double from_normalised(double place) const;
};

struct MappedModel {
  const char* name;   ///< of its table: "parallel-bond-crossing"
  const char* label;  ///< "parallel bonds, planes by crossing"
  const RockModel* model;
  Recipe base;
  std::vector<MapVariable> variables;  ///< in the order in which they are set
  int n_points;                        ///< of the Sobol sequence over all variables
  int n_at_base;                       ///< of a second one, over those that a rock without much data needs

  bool layered() const { return model->layered; }  ///< seven inclinations; else the same at every one
  bool has(const Recipe& recipe) const;            ///< Is a recipe one of it?
};

/// Share of the planes that is jointed, where nothing says it.
inline constexpr double usual_persistence = 0.65;

const std::vector<MappedModel>& mapped_models();
/// The mapped model of a recipe; nullptr: it was not mapped.
const MappedModel* mapped_model_of(const Recipe& recipe);

/// Inclinations of the layered models [deg]: of UCS, and of Brazilian strength.
inline constexpr double mapped_angles[] = {0, 15, 30, 45, 60, 75, 90};
inline constexpr double mapped_disc_angles[] = {0, 45, 90};

}  // namespace phy::maps
