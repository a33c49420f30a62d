#include "theory/hoek_brown.hpp"

#include <cmath>

#include "base/check.hpp"

namespace phy::theory {

double hoek_brown_sigma_1(double sigma_c, double m_i, double sigma_3) {
  return saroglou_tsiambaos_sigma_1(sigma_c, 1.0, m_i, sigma_3);
}

double saroglou_tsiambaos_sigma_1(double sigma_c_theta, double k_theta, double m_i, double sigma_3) {
  const double inside = k_theta * m_i * sigma_3 / sigma_c_theta + 1.0;
  PHY_CHECK(sigma_c_theta > 0.0 && inside >= 0.0, "sigma_3 above the tensile end of the envelope");
  return sigma_3 + sigma_c_theta * std::sqrt(inside);
}

}  // namespace phy::theory
