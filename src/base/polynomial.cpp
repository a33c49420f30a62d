#include "base/polynomial.hpp"

#include <Eigen/Eigenvalues>

#include "base/check.hpp"

namespace phy {

std::vector<std::complex<double>> roots_of_monic(const std::vector<double>& c) {
  PHY_CHECK(!c.empty(), "a polynomial of at least the first degree");
  const auto n = static_cast<Eigen::Index>(c.size());
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  companion.diagonal(-1).setOnes();
  companion.col(n - 1) = -Eigen::Map<const Eigen::VectorXd>(c.data(), n);
  const Eigen::VectorXcd all = companion.eigenvalues();
  return {all.begin(), all.end()};
}

}  // namespace phy
