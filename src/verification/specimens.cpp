// Genesis against closed forms.
#include <cmath>

#include "genesis/bond.hpp"
#include "genesis/settle.hpp"
#include "records/assembly.hpp"
#include "verification/cases.hpp"

namespace phy::verification {
namespace {

std::vector<Check> strengths() {
  const double mean = 65e6, sd = 6.5e6;
  constexpr int n = 20000;
  double sum = 0.0, squares = 0.0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double s = genesis::draw_strength(mean, sd, {1, Stream::bond_tension, i, i + 1});
    sum += s, squares += (s - mean) * (s - mean);
  }
  // standard deviation of a normal variable cut at +-3 SD: sqrt(1 - 6 phi(3)/(2 Phi(3) - 1)) = 0.98658 SD
  return {{"mean of 20,000 strengths [Pa]", mean, sum / n, 3.0 * sd / std::sqrt(n) / mean},
          {"their standard deviation, cut at 3 SD [Pa]", 0.98658 * sd, std::sqrt(squares / n),
           3.0 / std::sqrt(2.0 * n)}};
}

}  // namespace

std::vector<VerificationCase> specimen_cases() {
  return {{"V18", "Bond strengths: mean and standard deviation of the draws", "sampling theory",
           "three standard errors: a false alarm in 1 of 370, but the draws are fixed by the seed",
           strengths}};
}

}  // namespace phy::verification
