// How a calibration came about, in words: its models, its tests, its search.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/nan.hpp"
#include "report/words.hpp"

namespace phy::report {

namespace {

using F = const Finding&;
using Kind = FindingKind;

/// Of a model that was calibrated, and what it came to.
std::string model_tried(F f) {
  const std::string result =
      f.number("unanswered") > 0.0
          ? counted_text(f.number("unanswered"), "value") + " without an answer"
          : fmt::format("{:.2g} tolerances off on unseen packings (rms)", f.number("tolerances"));
  return fmt::format("Calibrated with {}: {}, {}.", f.names.front(),
                     f.number("reached") > 0.0 ? "within reach" : "not within reach", result);
}

std::string rival_model(F f) {
  return fmt::format(
      "{} may do as well: before any test it missed the table by {}, {} with {}. To try it, take "
      "a new folder and {}.",
      f.names[0], percent_text(f.number("error")), percent_text(f.number("taken_error")), f.names[1],
      options_of_rival(f));
}

std::string toughness_grains(F f) {
  std::string text = fmt::format(
      "At the same strengths grain_size = \"{:.2g} mm\" in the rock file would meet K_Ic. The specimen then "
      "has "
      "some {:.0f} grains, {:.0f} in the radius of the half disc.",
      f.number("wanted") * 1e3, f.number("grains"), f.number("in_radius"));
  if (f.number("in_radius") < f.number("fewest"))
    text += fmt::format(" With fewer than {:g}, K_Ic comes out too small, and larger grains meet it.",
                        f.number("fewest"));
  return text;
}

std::string unsettled(const std::string& why) {
  return "The estimate of the strengths had not settled when the search ended: " + why + ".";
}

const std::vector<Wording> model_words = {
    {Kind::model_expected,
     [](F f) {
       std::vector<std::string> items;
       if (f.has("E")) items.push_back("E fitted to " + percent_text(f.number("E")));
       if (f.has("strengths"))
         items.push_back("strengths left out predicted to " + percent_text(f.number("strengths")));
       return fmt::format("Before any test, with {}: {}.", f.names.front(), list_text(items));
     }},
    {Kind::model_taken,
     [](F f) { return "Expected to do best, by the maps and before any test: " + f.names.front() + "."; }},
    {Kind::models_miss_modulus,
     [](F f) {
       return fmt::format("Models that miss E by more than {} are passed over.",
                          percent_text(f.number("limit")));
     }},
    {Kind::nested_models_stay,
     [](F f) {
       return fmt::format(
           "A model that contains whole planes is taken only if it misses less than {:g} of what they miss.",
           f.number("gain"));
     }},
    {Kind::flat_joints_rule,
     [](F f) {
       return fmt::format(
           "Flat joints are taken only if they alone are expected to meet the table. Where nothing is, they "
           "must "
           "miss less than {:g} of what others miss.",
           f.number("gain"));
     }},
    {Kind::model_without_rivals,
     [](F f) { return "A sequence compares no models; taken: " + f.names.front() + "."; }},
    {Kind::share_assumed,
     [](F f) {
       return fmt::format(
           "Joints on {:g} of the planes are assumed. A share is chosen where the table has four strengths "
           "without confinement, UCS among them.",
           f.number("share"));
     }},
    {Kind::share_interval,
     [](F f) {
       return fmt::format(
           "Joints lie on {:g} of the planes, {:g} to {:g} (95 %). Shares outside miss E, miss the table by "
           "{:g} times as much, or were not compared. All other numbers are of {:g}.",
           f.number("share"), f.number("low"), f.number("high"), f.number("factor"), f.number("share"));
     }},
    {Kind::model_tried, model_tried},
    {Kind::model_interrupted,
     [](F f) { return "The calibration with " + f.names.front() + " was interrupted."; }},
    {Kind::model_kept, [](F f) { return "Kept: " + f.names.front() + "."; }},
    {Kind::rival_model, rival_model},
    {Kind::no_modulus,
     [](F) -> std::string { return "The table has no E: the elastic parameters are the recipe's."; }},
    {Kind::moduli_at_small_strain,
     [](F f) {
       return fmt::format(
           "E and nu are compared at small strain: without {} nothing shows how far a test softens "
           "(E_is = \"{}\").",
           f.names[1], f.names[0]);
     }},
    {Kind::elastic_only,
     [](F) -> std::string {
       return "The elastic part only: the strengths are the recipe's, not calibrated.";
     }},
    {Kind::no_ucs,
     [](F) -> std::string {
       return "The table has no UCS: the strengths are the recipe's, not calibrated.";
     }},
    {Kind::no_compression,
     [](F) -> std::string {
       return "The table has no strength in compression: the strengths are the recipe's, not calibrated.";
     }},
    {Kind::intervals_withdrawn,
     [](F) -> std::string {
       return "The model misses the table: intervals of the rock that exclude the measured value are left "
              "out.";
     }},
};

const std::vector<Wording> test_words = {
    {Kind::cracks_off_centre,
     [](F f) {
       return fmt::format(
           "in {:.0f} of {} on unseen packings the first crack lies outside the central third of the disc. "
           "Peak loads are compared all the same.",
           f.number("tests"), counted_text(f.number("of"), "test"));
     },
     true},
    {Kind::peaks_missing,
     [](F f) {
       return fmt::format("{:.0f} of {} on unseen packings gave no usable peak ({}).", f.number("tests"),
                          counted_text(f.number("of"), "test"), f.names.front());
     },
     true},
    {Kind::tests_marked,
     [](F f) {
       const auto limit = std::ranges::find_if(
           quality_limits(), [&](const QualityLimit& q) { return f.names.front() == q.number; });
       return fmt::format("A warning of {:.0f} of {} on unseen packings: {}.", f.number("tests"),
                          counted_text(f.number("of"), "test"),
                          limit != quality_limits().end() ? limit->says : f.names.front());
     }},
    {Kind::tests_unmarked,
     [](F f) {
       return fmt::format(
           "{:.0f} of {} on unseen packings come from an older version, without this assessment.",
           f.number("tests"), counted_text(f.number("of"), "test"));
     }},
    {Kind::tests_change_modulus,
     [](F f) {
       return fmt::format(
           "E and nu of the table are read at small strain (E_is). At half of UCS the tests measure E "
           "{:+.0f} "
           "% in the mean over the angles.",
           100.0 * f.number("change"));
     }},
    {Kind::modulus_without_test,
     [](F) -> std::string {
       return "no strength of the same test to read it with; the nearest tests of the table stand in.";
     },
     true},
    {Kind::packings_wanted,
     [](F) {
       return "Strengths of packings of this size differ much: a larger " + option_text("max-tests") +
              " takes more unseen ones.";
     }},
    {Kind::packings_added,
     [](F f) {
       return fmt::format(
           "Strengths of packings of this size differ so much that {:.0f} unseen ones were taken instead of "
           "{:.0f}.",
           f.number("packings"), f.number("usual"));
     }},
    {Kind::toughness_compared,
     [](F f) {
       return fmt::format(
           "{} is compared, not fitted, with grains of {:.3g} mm: {}.", cells_text(f.cells),
           f.number("grain_size") * 1e3,
           std::isfinite(f.number("model")) ? both_text(f) + ", " + miss_text(f) : "no answer");
     }},
    {Kind::toughness_grains, toughness_grains},
    {Kind::toughness_grains_unfit,
     [](F f) {
       return fmt::format(
           "At the same strengths K_Ic asks for grains of {:.2g} mm, too {} for this specimen.",
           f.number("wanted") * 1e3, f.number("wanted") > f.number("grain_size") ? "large" : "many");
     }},
};

const std::vector<Wording> search_words = {
    {Kind::search_short,
     [](F f) {
       const std::string tests = fmt::format("{} in compression{}", counted_text(f.number("tests"), "test"),
                                             f.number("models") > 1.0
                                                 ? " by " + counted_text(f.number("models"), "model")
                                                 : std::string()),
                         more = f.number("more") > 0.0 ? fmt::format(" With {} it takes about {:.0f} more.",
                                                                     options_of_search(f), f.number("more"))
                                                       : std::string();
       return f.advice != Advice::none
                  ? fmt::format("The search ended before its estimate had settled ({}).{}", tests, more)
                  : fmt::format("The search was short ({}){}.{}", tests,
                                f.number("foreseen") > 0.0 ? ": the forecast saw the table out of reach" : "",
                                more);
     }},
    {Kind::search_cut,
     [](F f) {
       return fmt::format("{} paid for {:.0f} of the {:.0f} points of a {} search.", option_text("max-tests"),
                          f.number("paid"), f.number("points"), f.names.front());
     }},
    {Kind::draws_rough,
     [](F f) {
       return fmt::format(
           "The {:.0f} draws behind the intervals of the strengths are worth {:.0f} independent ones (R-hat "
           "{:.2f}): the ends are rough.",
           f.number("draws"), f.number("effective"), f.number("r_hat"));
     }},
    {Kind::peaks_left_out,
     [](F f) {
       return fmt::format("Left out, for want of a usable peak: {:.0f} of {} of the search.",
                          f.number("tests"), counted_text(f.number("of"), "test"));
     }},
    {Kind::unsettled_tests,
     [](F f) {
       return unsettled(
           fmt::format("tests there were {:.1f} tolerances off the prediction", f.number("tolerances")));
     }},
    {Kind::unsettled_known,
     [](F f) {
       return unsettled(
           fmt::format("its strengths are known to {:.1f} tolerances only", f.number("tolerances")));
     }},
    {Kind::unsettled_moved,
     [](F) { return unsettled("it moved to where less is known than where it was tried"); }},
    {Kind::rounds_no_nearer,
     [](F f) {
       return fmt::format("The search ended after {:.0f} rounds: the last came no nearer to the table.",
                          f.number("rounds"));
     }},
    {Kind::eq1_refused,
     [](F f) {
       return fmt::format("Eq. 1 does not fit the table ({}): the joints are as stiff as is admissible.",
                          f.names.front());
     }},
    {Kind::eq2_line,
     [](F f) {
       return fmt::format(
           "Eq. 2 on these packings: K_{0} = {1:.4g} k_{0} {2:+.4g} GPa/m, R2 = {3:.5f}. By Eq. 1 through "
           "the "
           "table K_{0} = {4:.4g} GPa/m.",
           f.names.front(), f.number("slope"), f.number("intercept") * 1e-9, f.number("R2"),
           f.number("wanted") * 1e-9);
     }},
    {Kind::sequence_unsettled,
     [](F f) {
       return fmt::format("The strengths still moved in round {:.0f}, the last.", f.number("rounds"));
     }},
    {Kind::peaks_skipped,
     [](F f) {
       return fmt::format(
           "{:.0f} of {} of the search gave no usable peak: the strength was left at the best so far.",
           f.number("tests"), counted_text(f.number("of"), "test"));
     }},
    {Kind::step_missed,
     [](F f) {
       return fmt::format("{} could not be met within {} by {}.", cells_text(f.cells),
                          percent_text(f.number("limit")), f.names.front());
     }},
    {Kind::values_unused,
     [](F f) { return fmt::format("The sequence compares {} and does not use them.", cells_text(f.cells)); }},
};

}  // namespace

const std::vector<Wording>& words_of_notes() {
  static const std::vector<Wording> all = [] {
    std::vector<Wording> list;
    for (const auto* part : {&model_words, &test_words, &search_words})
      list.insert(list.end(), part->begin(), part->end());
    return list;
  }();
  return all;
}

}  // namespace phy::report
