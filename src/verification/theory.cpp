// Closed forms against an independent route to the same number.
#include <algorithm>
#include <cmath>

#include "theory/goodman.hpp"
#include "theory/jaeger.hpp"
#include "theory/transverse_isotropy.hpp"
#include "verification/cases.hpp"

namespace phy::verification {
namespace {

std::vector<Check> goodman_by_rotation() {
  theory::JointedRock rock;
  // Two closed forms of one thing, neither of which was derived from the other.
  rock.E = 45e9, rock.K_n_delta = 6406e9 * 0.005, rock.K_s_delta = 1666e9 * 0.005, rock.nu = 0.27;
  const theory::PlaneCompliance across =
      theory::plane_compliance(theory::ti_from_goodman(rock), theory::PlaneState::stress);
  std::vector<Check> checks;
  for (const double theta : {0.0, 15.0, 35.0, 45.0, 60.0, 90.0}) {
    const theory::PlaneCompliance S = theory::rotated(across, theta);
    checks.push_back({"E at " + std::to_string(static_cast<int>(theta)) + " deg, rotated compliance [Pa]",
                      1.0 / S.S_yy, theory::goodman_E(rock, theta), 1e-12});
    checks.push_back({"nu at " + std::to_string(static_cast<int>(theta)) + " deg, rotated compliance [-]",
                      -S.S_xy / S.S_yy, theory::goodman_nu(rock, theta), 1e-12});
  }
  return checks;
}

// The smallest strength over a fine scan of angles, refined by thirds, against 2 c (sqrt(1 + mu^2) + mu).
std::vector<Check> jaeger_minimum() {
  theory::Coulomb plane;
  plane.cohesion = 30e6, plane.friction = std::atan(0.4) * 180.0 / std::acos(-1.0);
  double lo = 40.0, hi = 80.0;
  for (int i = 0; i < 200; ++i) {
    const double a = lo + (hi - lo) / 3.0, b = hi - (hi - lo) / 3.0;
    (theory::weak_plane_sigma_1(plane, a, 0.0) < theory::weak_plane_sigma_1(plane, b, 0.0) ? hi : lo) =
        theory::weak_plane_sigma_1(plane, a, 0.0) < theory::weak_plane_sigma_1(plane, b, 0.0) ? b : a;
  }
  const double found = theory::weak_plane_sigma_1(plane, 0.5 * (lo + hi), 0.0);
  return {
      {"smallest strength of c = 30 MPa, mu = 0.4 [Pa]", 2.0 * 30e6 * (std::sqrt(1.16) + 0.4), found, 1e-12},
      {"its angle 45 + phi/2 [deg]", 45.0 + 0.5 * plane.friction, 0.5 * (lo + hi), 1e-6}};
}

}  // namespace

std::vector<VerificationCase> theory_cases() {
  return {
      {"V4", "Goodman's E(theta) and nu(theta) agree with the rotated compliance matrix",
       "Goodman 1989; Amadei 1996", "two closed forms in double precision", goodman_by_rotation},
      {"V14", "Jaeger's plane of weakness: smallest strength 2 c (sqrt(1 + mu^2) + mu) at 45 + phi/2",
       "Jaeger 1960", "a minimum is flat: its angle is found to the root of the rounding error",
       jaeger_minimum},
  };
}

}  // namespace phy::verification
