// Constants of a law from one set of tests, by least squares: values, covariance, error.
//
// Misfits of strengths and moduli count relative to them (differences of logarithms), as the scatter of rock
// does; a misfit of 0.01 of a Poisson's ratio counts like one of 1 % of a modulus. The covariance is
// s^2 (J'J)^-1 with s^2 of the misfits: what the tests leave open, and what the law is wrong by.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "design/constants.hpp"
#include "theory/jaeger_fit.hpp"

namespace phy::design {

/// Why there are no constants. Not an error: tests that a law cannot hold are a finding.
enum class Refusal {
  none,
  too_few,         ///< tests with a strength, for the constants of the law
  undetermined,    ///< some combination of the constants changes no test
  no_plane,        ///< no test, or those of one stress alone, fails along the planes
  no_matrix,       ///< the same of the rock between them
  falling,         ///< the strength falls with the stress on the sides, or grows less than it
  not_admissible,  ///< constants that no elastic body has
  no_common,       ///< no two draws have a constant in common, as of stresses that hardly differ
  planes_absent,   ///< the model has no planes
  not_sought,      ///< nobody has fitted the strengths of the model to a rock
  no_agreement     ///< the law has no strength in some direction
};

/// As files call it: "no_plane".
const char* word_of(Refusal refusal);

/// Peak sigma_1 at theta [deg] and sigma_3 [Pa].
using StrengthPoint = theory::StrengthReading;
using StrengthPoints = std::vector<StrengthPoint>;

/// Of one set of tests.
struct Fit {
  Refusal refusal = Refusal::too_few;
  std::vector<Key> keys = {};
  Eigen::VectorXd x = {};           ///< inner() of the values, in the order of the keys
  Eigen::MatrixXd covariance = {};  ///< of x
  double error = nan;               ///< root of the mean square of the misfits [-]
  std::size_t n = 0;                ///< misfits

  bool ok() const { return refusal == Refusal::none; }
  bool has(const Key& key) const;
  /// In SI; NaN: it has none.
  double value(const Key& key) const;
};
inline Fit refused(Refusal why) { return {.refusal = why}; }

/// Misfits of a law with some unknowns, n of them.
struct Law {
  std::size_t n = 0;
  std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& misfits)> misfits;
};

/// The best of the minima downhill from `starts`, as the constants of `keys`.
Fit fit_law(const Law& law, std::vector<Key> keys, const std::vector<Eigen::VectorXd>& starts);

/// d f / d x by central differences, in place of derivatives that nobody has to write and check.
Eigen::MatrixXd slopes_of(const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>& f,
                          const Eigen::VectorXd& x, Eigen::Index n);

/// The constants that `f` makes of those of a fit, with their covariance to first order.
Fit transformed(const Fit& fit, std::vector<Key> keys,
                const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>& f);

}  // namespace phy::design
