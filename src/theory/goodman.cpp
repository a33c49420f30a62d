#include "theory/goodman.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"

namespace phy::theory {

double goodman_E(const JointedRock& rock, double theta) {
  const SinCos a = sin_cos_degrees(theta);
  const double c2 = a.cos * a.cos;
  const double s2 = a.sin * a.sin;
  // The normal stress on the planes is cos^2 of the axial one, the shear stress sin cos.
  return 1.0 / (1.0 / rock.E + c2 * (c2 / rock.K_n_delta + s2 / rock.K_s_delta));
}

double goodman_nu(const JointedRock& rock, double theta) {
  const SinCos a = sin_cos_degrees(theta);
  const double s2c2 = a.sin * a.sin * a.cos * a.cos;
  return goodman_E(rock, theta) * (rock.nu / rock.E + s2c2 * (1.0 / rock.K_s_delta - 1.0 / rock.K_n_delta));
}

CurveShape goodman_shape(const JointedRock& rock) {
  PHY_CHECK(rock.E > 0.0 && rock.K_n_delta > 0.0 && rock.K_s_delta > 0.0,
            "E, K_n delta and K_s delta are positive");
  CurveShape shape;
  shape.E_0 = goodman_E(rock, 0.0);
  shape.E_90 = goodman_E(rock, 90.0);
  shape.E_min = shape.E_0;
  const double a = 1.0 / rock.K_n_delta;  // compliances, so that an infinite stiffness is an ordinary number
  const double b = 1.0 / rock.K_s_delta;
  // Where shear is soft enough the curve has a minimum between 0 and 90 degrees.
  if (b > 2.0 * a) {
    const double c2 = b / (2.0 * (b - a));
    shape.type = CurveType::shoulder;
    shape.theta_star = std::acos(std::sqrt(c2)) * (180.0 / pi);
    shape.E_min = 1.0 / (1.0 / rock.E + b * b / (4.0 * (b - a)));
  }
  return shape;
}

}  // namespace phy::theory
