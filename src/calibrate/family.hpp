// Families of models: a matrix and what makes it layered, with the numbers that decide the shape of its
// answers.
//
// UCS/sigma_c, E/E_c and their course over the inclination are functions of dimensionless numbers alone:
// ratios of strengths and of moduli, frictions, scatter, spacing over grain size. A family names those that
// were mapped, each with its range, on a small specimen of some 1,300 discs. `make maps` runs a Sobol
// sequence over them and writes what came out into data/maps; the program holds those tables
// (calibrate/reach.hpp).
#pragma once
#include <string>
#include <vector>

#include "calibrate/parameters.hpp"
#include "records/recipe.hpp"

namespace phy::calibrate {

/// A dimensionless number of a recipe and the range in which it was mapped.
struct Lever {
  const char* name;  ///< "tau_c/sigma_c": column of the table
  double low, high;
  bool logarithmic;
  double (*get)(const Recipe&);
  void (*set)(Recipe&, double);
  /// The parameter of a calibration that it is; nullptr: none.
  const StrengthParameter* parameter = nullptr;
  bool at_base = false;  ///< keeps the value of the base recipe in the second sequence

  /// Place of a value in the range, -1 at the lower end, 1 at the upper one, and back.
  double place_of(double value) const;
  double at_place(double place) const;
};

struct ModelFamily {
  const char* name;   ///< of its table: "parallel-bond-crossing"
  const char* label;  ///< "parallel bonds, planes by crossing"
  Recipe base;
  std::vector<Lever> levers;  ///< in the order in which they are set
  int n_points;               ///< of the Sobol sequence over all levers
  int n_at_base;              ///< of a second one, over those that a rock without much data needs
  bool layered;               ///< seven inclinations; else the same at every one

  bool has(const Recipe& recipe) const;  ///< Is a recipe of this family?
};

/// Share of them that is, where nothing tells it.
inline constexpr double usual_persistence = 0.65;

const std::vector<ModelFamily>& model_families();
/// The family of a recipe; nullptr: it was not mapped.
const ModelFamily* family_of(const Recipe& recipe);

/// Inclinations of the layered families [deg]: of UCS, and of Brazilian strength.
inline constexpr double mapped_angles[] = {0, 15, 30, 45, 60, 75, 90};
inline constexpr double mapped_disc_angles[] = {0, 45, 90};

}  // namespace phy::calibrate
