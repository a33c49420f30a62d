// What stands beside constants for other codes, in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>

#include "report/words.hpp"

namespace phy::report {
namespace {

using F = const Finding&;
using Kind = FindingKind;

/// Why a law has no constants, by the word of the finding.
std::string reason(const std::string& word) {
  static const std::map<std::string, std::string> reasons = {
      {"too_few", "too few tests have a strength"},
      {"undetermined", "the tests leave a combination of the constants open"},
      {"no_plane", "no specimen slips on a plane under two confining stresses"},
      {"no_matrix", "no specimen breaks between the planes under two confining stresses"},
      {"falling", "by the best fit sigma_1, on planes or in the rock, grows no faster than sigma_3"},
      {"no_common", "no two draws have a constant in common; the confining stresses may hardly differ"},
      {"planes_absent", "the model has no planes"},
      {"not_sought", "the calibration did not fit strengths, which are the recipe's"},
      {"not_admissible", "no elastic body has such constants"},
      {"no_agreement", "the law has no strength in some direction"}};
  const auto it = reasons.find(word);
  return it != reasons.end() ? it->second : "it could not be fitted";
}

/// A list after a colon; nothing where nothing is in it.
std::string listed(const char* begin, F f) {
  if (f.names.empty()) return "";
  return fmt::format(" {}: {}.", begin, fmt::join(f.names, ", "));
}
/// What the verdict of the calibration leaves open.
std::string undetermined(F f) { return listed("The calibration does not determine", f); }

std::string refused(F f) {
  if (f.has("theta"))
    return fmt::format("No constants of the {} part at {:g} degrees: fewer than two draws have a curve.",
                       f.names[0], f.number("theta"));
  return fmt::format("No constants of the {} part: {}.", f.names[0], reason(f.names[1]));
}

std::string range(F f) {
  std::string text = fmt::format(
      "The constants hold between {:g} and {:g} MPa of confining stress. They are fitted to {:.0f} tests of "
      "{:.0f} draws.",
      f.number("least") * 1e-6, f.number("most") * 1e-6, f.number("tests"), f.number("draws"));
  if (f.number("without") > 0.0)
    text += fmt::format(" {} came to no strength.", counted_text(f.number("without"), "test"));
  return text;
}

std::string nu_unseen(F f) {
  return fmt::format(
      "Tests in a plane do not show nu in the planes of isotropy. It is taken as {}, as of isotropic rock "
      "between planes (nu' E/E'). To give another: {}.",
      number_text(f.number("nu")), option_text("nu", "VALUE"));
}

std::string partly(F f) {
  return fmt::format("{:.0f} of {:.0f} draws have no constants of the {} part; the interval leaves them out.",
                     f.number("without"), f.number("draws"), f.names[0]);
}

std::string reading_of(const char* state, F f) {
  return fmt::format("E and nu are those at small strain, and the model's two dimensions are read as {}.",
                     state) +
         listed("E of the table is another, and not compared", f);
}

std::string errors(F) {
  return "Fit: what a law misses of the tests, root mean square. Stress left out: the same of means under a "
         "stress that the law was not fitted to.";
}

std::string tension_above(F f) {
  return fmt::format("sigma_t is {:.1f} MPa. In uniaxial tension c and phi fail first, at {:.1f} MPa.",
                     f.number("sigma_t") * 1e-6, f.number("by_cohesion") * 1e-6);
}

std::string laboratory(F f) {
  const double mean = f.number("mean");
  return fmt::format("The {} constants miss {} of {} of the laboratory by {} (rms), {} too {} on average.",
                     f.names[0], counted_text(f.number("values"), "value"), f.names[1],
                     percent_text(f.number("error")), percent_text(std::fabs(mean)),
                     mean < 0.0 ? "low" : "high");
}

}  // namespace

const std::vector<Wording>& words_of_design() {
  static const std::vector<Wording> list = {
      {Kind::design_range, range},
      {Kind::design_of_rock,
       [](F f) {
         return "Strengths in compression are the model's times what it misses of the table; the intervals "
                "count what is open there." +
                undetermined(f);
       }},
      {Kind::design_of_model,
       [](F f) {
         return "Strengths are the model's alone: what it misses of the rock is not in the intervals." +
                undetermined(f);
       }},
      {Kind::design_nu_unseen, nu_unseen},
      {Kind::design_nu_given,
       [](F f) {
         return fmt::format("nu in the planes of isotropy was given: {}.", number_text(f.number("nu")));
       }},
      {Kind::design_plane_stress, [](F f) { return reading_of("plane stress", f); }},
      {Kind::design_plane_strain, [](F f) { return reading_of("plane strain", f); }},
      {Kind::design_refused, refused},
      {Kind::design_partly, partly},
      {Kind::design_left_out, errors},
      {Kind::design_laboratory, laboratory},
      {Kind::design_no_laboratory,
       [](F) -> std::string { return "The calibration fitted no strength of the table inside the range."; }},
      {Kind::design_tension_above, tension_above},
      {Kind::design_strike,
       [](F) -> std::string {
         return "All tests load the rock in the section that is normal to the strike of its planes.";
       }},
      {Kind::design_not_fitted,
       [](F f) {
         return "Dilation and residual strength are not fitted; files have dilation 0." +
                listed("Not written, as they need a constant that is missing", f);
       }},
  };
  return list;
}

}  // namespace phy::report
