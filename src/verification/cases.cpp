#include "verification/cases.hpp"

#include <cmath>

namespace phy::verification {

bool Check::passed() const {
  const double scale = expected == 0.0 ? 1.0 : std::fabs(expected);
  return std::fabs(measured - expected) <= tolerance * scale;
}

const std::vector<VerificationCase>& verification_cases() {
  static const std::vector<VerificationCase> cases = [] {
    std::vector<VerificationCase> all;
    for (const auto& part :
         {theory_cases(), statics_cases(), dynamics_cases(), law_cases(), flat_joint_cases(),
          specimen_cases(), test_cases(), pressed_disc_cases(), whole_body_cases(), published_cases()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return cases;
}

}  // namespace phy::verification
