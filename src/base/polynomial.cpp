#include "base/polynomial.hpp"

#include <Eigen/Eigenvalues>

namespace phy {

std::vector<std::complex<double>> roots_of_monic(const std::vector<double>& c) {
  const auto n = static_cast<Eigen::Index>(c.size());
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  companion.diagonal(-1).setOnes();
  companion.col(n - 1) = -Eigen::Map<const Eigen::VectorXd>(c.data(), n);
  const Eigen::VectorXcd all = companion.eigenvalues();
  return {all.begin(), all.end()};
}

}  // namespace phy
