// The stages of a calibration while it runs, in words.
#include <fmt/format.h>

#include "report/words.hpp"

namespace phy::report {
namespace {

using F = const Finding&;
using Kind = FindingKind;

std::string batch(F f) {
  return fmt::format(
      "Strength search, batch {:.0f} of {:.0f}: {:.0f} {}, {} each{}", f.number("batch"), f.number("of"),
      f.number("points"), f.number("at_estimate") > 0.0 ? "packings at the estimate" : "points",
      counted_text(f.number("tests"), "test"), f.number("coarse") > 0.0 ? ", on coarse grains" : "");
}

std::string expected(F f) {
  const std::string tests = range_text(f.number("least_tests"), f.number("most_tests"), "{:.0f}");
  const double others = f.number("models") - 1.0;
  const std::string text = fmt::format("A calibration{} takes {} tests, {} on this machine ({}).",
                                       others > 0.0 ? " by one model" : "", tests == "0" ? "no" : tests,
                                       duration_text(f.number("least_seconds"), f.number("most_seconds")),
                                       counted_text(f.number("threads"), "thread"));
  return others > 0.0
             ? text + fmt::format(" Where it ends out of reach, up to {} may follow, each about as long.",
                                  counted_text(others, "more model"))
             : text;
}

}  // namespace

const std::vector<Wording>& words_of_course() {
  static const std::vector<Wording> list = {
      {Kind::course_expected, expected},
      {Kind::course_models, [](F) -> std::string { return "Comparing the models of the rock"; }},
      {Kind::course_model,
       [](F f) { return fmt::format("Out of reach with {1}; now trying {0}", f.names[0], f.names[1]); }},
      {Kind::course_moduli, [](F) -> std::string { return "Fitting the moduli"; }},
      {Kind::course_moduli_packings,
       [](F f) {
         return fmt::format("Fitting the moduli on more packings, after {:.0f} direct solutions",
                            f.number("solutions"));
       }},
      {Kind::course_moduli_unseen, [](F) -> std::string { return "Checking the moduli on unseen packings"; }},
      {Kind::course_batch, batch},
      {Kind::course_step,
       [](F f) {
         return fmt::format("Sequence, round {:.0f}: {} against {}", f.number("round"), f.names.front(),
                            cells_text(f.cells));
       }},
      {Kind::course_softening,
       [](F) -> std::string { return "Reading the moduli in tests at the estimate"; }},
      {Kind::course_unseen,
       [](F f) { return fmt::format("Testing {:.0f} unseen packings", f.number("packings")); }},
      {Kind::course_toughness,
       [](F f) { return fmt::format("Comparing K_Ic on {:.0f} unseen packings", f.number("packings")); }},
      {Kind::course_eq2,
       [](F) -> std::string { return "Eq. 2, and what spacing and rule of the planes change in it"; }},
      {Kind::course_pictures, [](F) -> std::string { return "Testing the specimens that are shown"; }},
  };
  return list;
}

}  // namespace phy::report
