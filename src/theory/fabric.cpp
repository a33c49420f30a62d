#include "theory/fabric.hpp"

#include <cmath>

#include "base/exact_math.hpp"
#include "base/nan.hpp"
#include "theory/angles.hpp"
#include "theory/jaeger.hpp"

namespace phy::theory {

double fabric_load(double theta, double sigma_1, double sigma_3) {
  const SinCos a = sin_cos_degrees(folded_theta(theta));
  const double s1 = sigma_1 * sigma_1, s3 = sigma_3 * sigma_3;
  return 1.0 - 3.0 * (s1 * a.cos * a.cos + s3 * a.sin * a.sin) / (s1 + 2.0 * s3);
}

double fabric_sigma_1(const Fabric& rock, double theta, double sigma_3) {
  constexpr int rounds = 200;
  constexpr double settled = 1e-14;
  double sigma_1 = coulomb_sigma_1({rock.cohesion, rock.friction}, sigma_3);
  // The direction of the load depends on sigma_1 only where the sides are pressed, and weakly: it settles in
  // some ten rounds.
  for (int i = 0; i < rounds; ++i) {
    const double x = fabric_load(theta, sigma_1, sigma_3);
    const double c = rock.cohesion * (1.0 + rock.omega * x + rock.omega_2 * x * x);
    const double next = coulomb_sigma_1({c, rock.friction}, sigma_3);
    if (!(next > sigma_3)) return nan;
    const bool done = std::abs(next - sigma_1) <= settled * next;
    sigma_1 = next;
    if (done) return sigma_1;
  }
  return nan;
}

}  // namespace phy::theory
