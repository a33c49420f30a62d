// Constants that other codes ask for: the one list, an object each. Fits, intervals, files, the sheet and the
// tables of the codes (design/codes.hpp) are views of it.
#pragma once
#include <span>

#include "base/nan.hpp"

namespace phy::design {

/// The index of the list.
enum class Constant {
  E,
  E_n,
  nu,
  nu_n,
  G_n,  // transversely isotropic elasticity
  c_j,
  phi_j,
  c,
  phi,  // planes and the rock between them
  sigma_tj,
  sigma_t,  // tensile cut-offs
  sigma_ci,
  m,
  k_beta,  // Hoek-Brown at an inclination
  c_0,
  phi_0,
  omega,
  omega_2  // fabric
};
constexpr int n_constants = 18;

/// How a constant is fitted and averaged over draws: what may have any size above zero by its logarithm. A
/// friction angle as it is; its interval ends where angles do, at 0 and 90 degrees.
enum class Scale { logarithmic, linear, angle };

struct ConstantInfo {
  Constant constant;
  const char* name;    ///< of its row in files
  const char* symbol;  ///< as figures and tables write it
  const char* unit;    ///< SI: "Pa", "deg", "1"
  const char* meaning;
  Scale scale;
  /// As people read it.
  double factor;
  const char* shown_unit;
  int digits;
};

std::span<const ConstantInfo> constants();
const ConstantInfo& info(Constant constant);

/// A constant, at an inclination where it has one for each.
struct Key {
  Constant constant;
  double theta = nan;  ///< [deg]; NaN: of all inclinations
  friend bool operator==(const Key& a, const Key& b) {
    return a.constant == b.constant && (a.theta == b.theta || (a.theta != a.theta && b.theta != b.theta));
  }
};

/// Between a value in SI and the number that is fitted.
double inner(Constant constant, double value);
double outer(Constant constant, double x);
/// As `outer`, for an end of an interval: the nearest value that the constant may have.
double outer_end(Constant constant, double x);
/// d value / d x.
double outer_slope(Constant constant, double x);

}  // namespace phy::design
