// Verification: closed forms on one side, the program on the other. `phyllite verify` and tests/verification
// run the same list. This is the only room that holds theory against the engine.
#pragma once
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace phy::verification {

constexpr double root3 = std::numbers::sqrt3;  // of a hexagonal lattice: rows over the radius

/// One comparison of a case.
struct Check {
  std::string what;       ///< quantity with unit
  double expected = 0.0;  ///< closed form
  double measured = 0.0;
  double tolerance = 0.0;  ///< relative to |expected|, or absolute where expected is 0
  bool passed() const;
};

struct VerificationCase {
  std::string id;  ///< "V6"
  std::string claim;
  std::string source;
  std::string why;  ///< why this tolerance
  std::function<std::vector<Check>()> run;
};

/// THE list.
const std::vector<VerificationCase>& verification_cases();

// The cases by theme.
std::vector<VerificationCase> dynamics_cases();      ///< V0, V6-V8, V15, V17, V19, V24, V28: the engine
std::vector<VerificationCase> law_cases();           ///< V9-V12: contact laws
std::vector<VerificationCase> flat_joint_cases();    ///< V24: the law of flat joints
std::vector<VerificationCase> theory_cases();        ///< V4, V14: closed forms
std::vector<VerificationCase> statics_cases();       ///< V1-V3, V5, V13, V23, V24: direct elastic solution
std::vector<VerificationCase> specimen_cases();      ///< V18: genesis
std::vector<VerificationCase> test_cases();          ///< V13, V20 - V22, V24: whole tests
std::vector<VerificationCase> pressed_disc_cases();  ///< V25, V29: layered discs
std::vector<VerificationCase> whole_body_cases();    ///< V26, V27: whole bodies
std::vector<VerificationCase> published_cases();     ///< V30: results of others

}  // namespace phy::verification
