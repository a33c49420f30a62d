// Joint stiffness from measured moduli: least squares of Eq. 1 (theory/goodman.hpp) on E(theta).
//
//   1/E(theta) = e + a cos^4(theta) + b sin^2(theta) cos^2(theta)
//   e = 1/E, a = 1/(K_n delta), b = 1/(K_s delta)
//
// Two choices change the answer and must be made in the open.
//
//   The loss. compliance: sum (1/E_i - 1/E(theta_i))^2 is linear in e, a, b and is solved by QR; soft angles
//   weigh most. modulus: sum (E_i - E(theta_i))^2 by Gauss-Newton, from weighted compliances; stiff angles
//   weigh most. On scattered data the two give different K_s.
//
//   The reference. given: E of the intact rock. measured_90: the mean of the readings at 90 degrees. free:
//   fitted too. Where bedding weakens the rock along itself (a *zone*, not a plane), E(90) is not E.
//
// With E free the three terms span every E(theta) of an orthotropic body in two dimensions
// (transverse_isotropy.hpp, goodman_from_ti): a good fit then says nothing about joint mechanics. The result
// repeats this in `note`.
//
// R2 = 1 - sum (E_i - E(theta_i))^2 / sum (E_i - mean E)^2, always in modulus whatever the loss, over all
// readings; it is negative when a constant would do better. Standard errors: s^2 (J^T J)^-1 with s^2 = (sum
// of squares of the chosen loss) / degrees_of_freedom, carried to K by first-order propagation; conditional
// on E where E is not free. docs/theory/goodman.md
#pragma once
#include <string>
#include <vector>

#include "theory/goodman.hpp"

namespace phy::theory {

/// One laboratory or numerical test.
struct ModulusReading {
  double theta = 0.0;  ///< [deg], any; folded to [0, 90]
  double E = 0.0;      ///< [Pa], > 0
};

enum class Eq1Loss { compliance, modulus };
enum class Eq1Reference { given, measured_90, free };

struct Eq1Options {
  Eq1Loss loss = Eq1Loss::compliance;
  Eq1Reference reference = Eq1Reference::given;
  double E = 0.0;  ///< modulus of the intact rock [Pa], > 0; used by Eq1Reference::given only
};

/// Why there is no answer. Not an error: data that Eq. 1 cannot hold are a finding.
enum class Eq1Status {
  fitted,
  bad_reading,       ///< a reading or the given E is not a positive finite number
  too_few_angles,    ///< fewer than three distinct angles
  no_oblique_angle,  ///< none strictly between 20 and 70 degrees: K_s would rest on nothing
  no_reading_at_90,  ///< measured_90 was asked for
  K_n_not_positive,  ///< the rock is no softer across its planes than the reference
  K_s_not_positive,  ///< the rock is stiffer at oblique angles than any joint allows
  not_converged      ///< Gauss-Newton left the range of positive moduli or did not settle
};

/// What the fit found. On a refusal `rock` and `shape` are meaningless, `reason` says why; the three
/// compliances are filled whenever they could be computed.
struct Eq1Fit {
  Eq1Status status = Eq1Status::fitted;
  std::string reason;  ///< empty when fitted
  std::string note;    ///< what to keep in mind when reading the result
  JointedRock rock;    ///< E, K_n_delta, K_s_delta [Pa]; nu = 0
  CurveShape shape;    ///< shoulder or incremental, theta_star, E_min
  double e = 0.0;      ///< 1/E [1/Pa]
  double a = 0.0;      ///< 1/(K_n delta) [1/Pa]
  double b = 0.0;      ///< 1/(K_s delta) [1/Pa]
  double se_E = 0.0;   ///< standard errors [Pa]; NaN when degrees_of_freedom is 0; se_E is 0 unless E is free
  double se_K_n_delta = 0.0;     ///< [Pa]
  double se_K_s_delta = 0.0;     ///< [Pa]
  double R2 = 0.0;               ///< in modulus, see above [-]; NaN when all moduli are equal
  int degrees_of_freedom = 0;    ///< readings that took part minus parameters
  std::vector<double> residual;  ///< E_i - E(theta_i) [Pa], one per reading, in the order given
  bool ok() const { return status == Eq1Status::fitted; }
};

/// Fits Eq. 1. Never throws for what the data are; see Eq1Status.
Eq1Fit fit_eq1(const std::vector<ModulusReading>& readings, const Eq1Options& options);

}  // namespace phy::theory
