// Roots of polynomials, as eigenvalues of the companion matrix. Compiled once: Eigen's eigenvalues take
// fifteen seconds of a compiler's time in every file that names them.
#pragma once
#include <complex>
#include <vector>

namespace phy {

/// All roots of c[0] + c[1] x + ... + c[n-1] x^(n-1) + x^n, multiple ones as often, in no order.
std::vector<std::complex<double>> roots_of_monic(const std::vector<double>& c);

}  // namespace phy
