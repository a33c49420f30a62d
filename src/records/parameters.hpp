// THE parameters that a calibration moves: the one list, an object each, told apart by their addresses.
//
// An object knows which number of the recipe it is, how it gets there, in which box it is sought, and what
// of a table speaks about it. A strength is sought as its ratio to another one (`over`), because UCS grows in
// proportion to all strengths together and the ratios alone give the shape of UCS(theta): only sigma_c is
// sought itself, tau_c over sigma_c, C over tau_c, sigma_n over C. Standard deviations of the bond strengths
// keep their share of the mean. What a number means and what a recipe may hold stands under its key in
// records/recipe_schema.cpp.
#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/nan.hpp"
#include "records/calibration.hpp"
#include "records/evidence.hpp"

namespace phy {

/// Admissible values, and what is known of them without a table: logarithms of SI.
struct LogBox {
  double low = 0.0, high = 0.0, usual = 0.0;
  double sd = infinity;  ///< about `usual`
  /// Distance from the usual value in standard deviations.
  double strangeness(double x) const { return (x - usual) / sd; }
  /// Standard deviation before any data: of the prior within the box.
  double spread() const;
  /// Have data narrowed it? Is a 95 % interval of this width under half of a flat box that spreads as far?
  bool narrowed_to(double width) const { return width < std::sqrt(3.0) * spread(); }
};

/// The same as an object states it: multiples of what a table holds, or pure numbers.
struct Range {
  double low, high, usual;
  double Scales::*of = nullptr;  ///< nullptr: pure numbers
  /// Of the logarithm about that of `usual`, from literature (docs/theory/inference.md); infinity: nothing is
  /// known but the box.
  double sd = infinity;
};

struct Parameter;

/// Numbers of the closed forms of jointed rock (theory/goodman.hpp).
enum class MacroNumber { E, nu, K_n_delta, K_s_delta };

/// What a fit of Eq. 1 and one solution of the bare recipe say before the search.
struct FirstSight {
  double macro_E = 0.0, K_n_delta = 0.0, K_s_delta = 0.0;  ///< [Pa] by Eq. 1
  double E_c = 0.0, E = 0.0;  ///< [Pa] of the contacts of the bare recipe, and what its specimen has
  double joint_length = 0.0;  ///< [m] spacing times length of joints per length of plane
};

/// What E(theta) and nu(theta) show of a parameter.
struct ModulusRole {
  std::array<std::string_view, 2> rates;  ///< sensitivities of the direct solution that move together with it
  MacroNumber acts_on;                    ///< the number of the closed form
  double (*first_guess)(const FirstSight&) = nullptr;  ///< nullptr: the usual value
  LabTest bedded_test = {};                            ///< that tells most of it
  LabTest intact_test = {};                            ///< the same without bedding; none of a joint
  /// It acts by its logarithm on that of the number; or, where this is not 0, on the number as it is, which
  /// falls by `per_log` per logarithm of the parameter and is known to `prior_sd` without any data.
  double per_log = 0.0, prior_sd = 0.0;
  double E_per_log = 0.0;  ///< beside that, log E grows by so much
};

/// What a table says about a strength, by the kind and angle of its tests alone.
struct Rule {
  bool held = false;
  std::vector<LabTests> tests;      ///< that determine it
  std::vector<LabTests> next = {};  ///< that would; empty: no test that a table holds tells much
  bool shared = false;              ///< these tests speak as much about others: it is sought, not determined
};

/// What strengths show of a parameter.
struct StrengthRole {
  Rule (*rule)(const Evidence&);
  bool if_held = false;  ///< sought only where the table tells it, else left as the recipe has it
  /// Least value that goes with the rest of the recipe; nullptr: the box alone decides.
  double (*least)(const Recipe&) = nullptr;
  /// Throws InputError where a rock leaves no value of the box.
  void (*check)(const Rock&) = nullptr;
};

struct Parameter {
  const char* key;       ///< of the recipe: "matrix.tau_c"
  const char* symbol;    ///< "tau_c"
  const char* unit;      ///< SI; of angles "deg"
  RecipeNumber* number;  ///< the number of the recipe; of several sets of bedding, the first one's
  /// What is sought is the ratio to this one; nullptr: the number itself.
  const Parameter* over = nullptr;
  Range range;
  /// Takes what is sought. Leaves what stands below in the chain of ratios alone and moves what stands above:
  /// set parameters in the order of their list.
  void (*set)(Recipe&, double);
  bool (*belongs)(const Recipe&) = nullptr;  ///< to a model; nullptr: to every one
  /// One of the two.
  std::optional<ModulusRole> modulus = std::nullopt;
  std::optional<StrengthRole> strength = std::nullopt;

  double get(const Recipe& recipe) const;  ///< what is sought
  LogBox box(const Scales& scales) const;
  /// Of pure numbers: place in the box by the logarithm, -1 at the lower end, 1 at the upper.
  double normalised(double value) const;
  double from_normalised(double place) const;
};

/// An estimate and whose it is.
struct Estimate : ParameterEstimate {
  const Parameter* parameter = nullptr;
};
/// Names alone: of what is sought ("tau_c/sigma_c"), and of the number of the recipe ("matrix.tau_c").
Estimate sought(const Parameter& p);
Estimate number_of_recipe(const Parameter& p);

/// Those that a model has, in the order in which they are set.
std::vector<const Parameter*> elastic_parameters(const Recipe& model);
/// sigma_c, by which all strengths are measured, and the others that a rock's table is asked for.
std::vector<const Parameter*> strength_parameters(const Evidence& evidence);
std::vector<const Parameter*> strength_ratios(const Evidence& evidence);
/// All that there are of one kind of model, whatever a table holds.
std::vector<const Parameter*> strength_parameters(const Recipe& model);

extern const Parameter matrix_E_c, matrix_ks_over_kn, joint_k_n, joint_k_s, stiffness_ratio;
extern const Parameter matrix_sigma_c, matrix_tau_c, matrix_mu, matrix_moment, matrix_phi, matrix_slits,
    joint_cohesion, joint_sigma_n, joint_mu, joint_phi, tension_ratio, cohesion_ratio, cohesion_oblique;

}  // namespace phy
