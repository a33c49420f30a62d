// The sentences that are pinned on purpose, about twenty; everything else asks findings for their kind.
#include "report/words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/nan.hpp"

namespace phy::report {
namespace {

using testing::ElementsAre;
using Kind = FindingKind;

const Cell ucs_60{Property::ucs, 60.0}, nu_0{Property::nu, 0.0};

TEST(Words, NumbersHaveThreeDigitsAndTheirUnit) {
  EXPECT_EQ(value_text(Property::ucs, 118.2e6), "118 MPa");
  EXPECT_EQ(value_text(Property::E, 23.05e9), "23.1 GPa");
  EXPECT_EQ(value_text(Property::fracture_toughness, 1.84e6), "1.84 MPa sqrt(m)");
  EXPECT_EQ(value_text(Property::nu, 0.5291), "0.529");
  EXPECT_EQ(value_text(Property::nu, nan), "-");
  EXPECT_EQ(miss_text(Property::ucs, 0.0412), "4.1 %");
  EXPECT_EQ(miss_text(Property::ucs, 0.1249), "12 %");
  EXPECT_EQ(miss_text(Property::nu, 0.0423), "0.042");
  EXPECT_EQ(parameter_text(1.5e6, "Pa/m"), "1.5 MPa/m");
}

TEST(Words, ATimeIsARangeWithItsUnits) {
  EXPECT_EQ(duration_text(120.0, 540.0), "2 to 9 min");
  EXPECT_EQ(duration_text(40.0, 180.0), "40 s to 3 min");
  EXPECT_EQ(duration_text(5.0, 5.2), "5 s");
}

TEST(Words, CellsOfOneTestAreNamedTogether) {
  EXPECT_EQ(cells_text({{Property::ucs, 0.0}, {Property::brazilian, 0.0, 0.0, 0.054}, {Property::ucs, 30.0}}),
            "UCS at 0 and 30 degrees, BTS (54 mm) at 0 degrees");
  EXPECT_EQ(cells_text({{Property::confined, 45.0, 10e6}}), "sigma_1 (10 MPa) at 45 degrees");
}

TEST(Words, AValueThatIsMissed) {
  EXPECT_EQ(sentence({Kind::value_missed, {ucs_60}, {{"model", 48.0e6}, {"laboratory", 51.4e6}}}),
            "UCS at 60 degrees is 48.0 MPa in the model and 51.4 MPa in the table, 6.6 % too low.");
  EXPECT_EQ(sentence({Kind::value_missed, {nu_0}, {{"model", 0.31}, {"laboratory", 0.26}}}),
            "nu at 0 degrees is 0.310 in the model and 0.260 in the table, 0.050 too high.");
}

TEST(Words, WhatIsTheSameOfSeveralCellsIsOneSentence) {
  const auto silent = [](double theta, const char* why) {
    return Finding{Kind::no_usable_peak, {{Property::ucs, theta}}, {}, {why}};
  };
  EXPECT_THAT(sentences({silent(0.0, "no drop"), silent(30.0, "unstable"), silent(60.0, "no drop")}),
              ElementsAre("UCS at 0 and 60 degrees: no test on unseen packings has a usable peak (no drop).",
                          "UCS at 30 degrees: no test on unseen packings has a usable peak (unstable)."));
}

TEST(Words, AValueThatIsNotDecidedSaysWhatWouldHelp) {
  Finding f{Kind::value_open, {ucs_60}, {{"bound", 0.226}, {"coarsest", 0.15}, {"specimens", 3.0}}};
  EXPECT_EQ(
      sentence(f),
      "UCS at 60 degrees: not decided; an error of 23 % is not excluded. With 3 more specimens it would be "
      "below 15 %.");
  f.numbers.pop_back();
  EXPECT_EQ(sentence(f), "UCS at 60 degrees: not decided; an error of 23 % is not excluded.");
}

TEST(Words, CausesOfTheMisfit) {
  EXPECT_EQ(
      sentence({Kind::weakest_angle_no_plane, {{Property::ucs, 30.0}, {Property::ucs, 60.0}}}),
      "The rock is weakest at 30 degrees, the model at 60 degrees. No single weak plane is weakest there.");
  EXPECT_EQ(
      sentence({Kind::tension_ratio,
                {{Property::brazilian, 0.0}},
                {{"laboratory", 25.0}, {"low", 3.52}, {"high", 23.1}, {"ucs", -0.03}, {"tension", 0.12}}}),
      "UCS/BTS at 0 degrees is 25.0 in the table; mapped specimens of this model have 3.5 to 23.1. The "
      "model's UCS is off by -3 %, its BTS by +12 %.");
  Finding far{Kind::farthest_value, {ucs_60}, {{"model", 66e6}, {"laboratory", 53.5e6}}};
  EXPECT_EQ(sentence(far),
            "Farthest off is UCS at 60 degrees, 66.0 MPa in the model and 53.5 MPa in the table.");
  far.numbers.insert(far.numbers.end(), {{"packings", 3.3e6}, {"expected", 55.0e6}, {"error", 0.15}});
  EXPECT_EQ(
      sentence(far),
      "Farthest off is UCS at 60 degrees, 66.0 MPa in the model and 53.5 MPa in the table. No cause was "
      "found: the maps expect this model 2.8 % too high, give or take 15 %; packings differ by 5.0 %.");
  far.kind = Kind::expected_in_maps;
  EXPECT_EQ(sentence(far),
            "UCS at 60 degrees is 66.0 MPa in the model and 53.5 MPa in the table, 23 % too high. The maps "
            "expect it of this model: 2.8 % too high, give or take 15 %.");
  EXPECT_EQ(sentence({Kind::moduli_scaled, {}, {{"factor", 0.8}}}),
            "E as a whole is 0.80 times E of the table.");
}

TEST(Words, AMeasureOfQualityIsNamedByWhatIsWrong) {
  EXPECT_EQ(sentence({Kind::tests_marked, {}, {{"tests", 7.0}, {"of", 420.0}}, {"kinetic_ratio"}}),
            "A warning of 7 of 420 tests on unseen packings: the specimen is in motion, not in equilibrium.");
}

TEST(Words, NotesOfTheWay) {
  EXPECT_EQ(sentence({Kind::rounds_no_nearer, {}, {{"rounds", 4.0}}}),
            "The search ended after 4 rounds: the last came no nearer to the table.");
  EXPECT_EQ(sentence({Kind::search_short,
                      {},
                      {{"tests", 60.0},
                       {"models", 2.0},
                       {"of_effort", 1.0},
                       {"of_tests", 1.0},
                       {"foreseen", 0.0},
                       {"more", 0.0}},
                      {},
                      Advice::longer_search}),
            "The search ended before its estimate had settled (60 tests in compression by 2 models).");
  EXPECT_EQ(sentence({Kind::search_short,
                      {},
                      {{"tests", 60.0},
                       {"models", 1.0},
                       {"of_effort", 1.0},
                       {"of_tests", 0.0},
                       {"foreseen", 1.0},
                       {"more", 90.0}}}),
            "The search was short (60 tests in compression): the forecast saw the table out of reach. With "
            "--effort normal it takes about 90 more.");
  EXPECT_EQ(sentence({Kind::packings_added, {}, {{"packings", 10.0}, {"usual", 5.0}}}),
            "Strengths of packings of this size differ so much that 10 unseen ones were taken instead of 5.");
}

Comparison row(Property p, double theta, double laboratory, double model) {
  Comparison c;
  c.target = {p, theta, laboratory, 0.05 * laboratory, 3, false};
  c.mean = model, c.n_packings = 5;
  return c;
}

Finding counts(double values, double met, double missed, double open, double alone) {
  return {Kind::values_judged,
          {},
          {{"values", values},
           {"met", met},
           {"missed", missed},
           {"open", open},
           {"alone", alone},
           {"by_chance", 0.05 * values}}};
}

TEST(Words, ALoneValueIsNamedAsOne) {
  EXPECT_EQ(sentence({Kind::tests_met, {{Property::nu, 0.0}}, {{"of", 1.0}}}),
            "nu at 0 degrees, its only value in the table.");
  EXPECT_EQ(sentence({Kind::tests_alone, {{Property::nu, 0.0}}, {{"of", 4.0}}}),
            "nu at 0 degrees, the only value of nu met.");
}

TEST(Words, TheVerdictOfARockThatIsMet) {
  Calibration c;
  c.fitted = c.verification = {row(Property::ucs, 0, 60e6, 61e6), row(Property::nu, 0, 0.25, 0.26)};
  c.verdict.counts = counts(21, 20, 0, 1, 1);
  c.verdict.good_for = {{Kind::tests_met, {{Property::ucs, 0.0}, {Property::ucs, 30.0}}, {{"of", 2.0}}},
                        {Kind::tests_met, {{Property::nu, 0.0}}, {{"of", 2.0}}}};
  c.verdict.not_good_for = {{Kind::tests_open, {{Property::nu, 60.0}}, {{"of", 2.0}}},
                            {Kind::test_undetermined, {}, {}, {"strength under confinement", "mu", "mu_sj"}}};
  EXPECT_EQ(
      verdict_words(c),
      "Calibrated. On packings that the fit has not seen: 20 of 21 values are met, 1 is not decided. Judged "
      "each by itself, 1 value is off; chance alone gives about 1 at most. Largest errors: nu 0.010 and UCS "
      "1.7 %.");
  EXPECT_THAT(verdict_lines(c),
              ElementsAre("Good for: UCS at every angle of the table; nu at 0 degrees.",
                          "Not good for: nu at 60 degrees, not decided; strength under confinement: not "
                          "determined by this table (mu and mu_sj).",
                          "Next: nothing is needed."));
}

TEST(Words, TheVerdictOfATableOfOneValueWithoutBedding) {
  Calibration c;
  c.fitted = c.verification = {row(Property::ucs, 0, 60e6, 61e6)};
  c.verdict.status = VerdictStatus::not_decided, c.verdict.counts = counts(1, 0, 0, 1, 0);
  c.verdict.not_good_for = {{Kind::tests_open, {{Property::ucs, nan}}, {{"of", 1.0}}}};
  c.verdict.next = {Kind::next_step, {}, {}, {"UCS"}, Advice::state_scatter};
  EXPECT_EQ(verdict_words(c),
            "Not decided: the table does not show the scatter of UCS. On packings that the fit has not seen: "
            "the one value is not decided. Largest errors: UCS 1.7 %.");
  EXPECT_THAT(
      verdict_lines(c),
      ElementsAre("Good for: nothing that the table could show.", "Not good for: UCS, not decided.",
                  "Next: state the scatter of the specimens in the columns UCS_sd and n of the table, or "
                  "test three specimens of each."));
}

TEST(Words, TheVerdictOfModuliAlone) {
  Calibration c;
  c.fitted = c.verification = {row(Property::E, 0, 60e9, 61e9)};
  c.verdict.counts = counts(1, 1, 0, 0, 0);
  c.verdict.not_good_for = {{Kind::strengths_of_recipe}};
  c.verdict.next.advice = Advice::calibrate_strengths;
  EXPECT_THAT(verdict_words(c), testing::StartsWith("Calibrated in E and nu alone."));
  EXPECT_EQ(verdict_lines(c)[1], "Not good for: strengths, which are the recipe's, not the rock's.");
}

TEST(Words, TheVerdictOfATableThatIsOutOfReach) {
  Calibration c;
  c.verdict.status = VerdictStatus::out_of_reach, c.verdict.counts = counts(7, 4, 2, 1, 2);
  c.verdict.not_good_for = {
      {Kind::tests_missed, {ucs_60, {Property::ucs, 75.0}}, {{"miss", 0.114}, {"miss", 0.13}, {"of", 7.0}}}};
  c.verdict.causes = {{Kind::farthest_value, {ucs_60}, {{"model", 48e6}, {"laboratory", 51.4e6}}}};
  c.verdict.next = {Kind::next_step, {ucs_60}, {}, {}, Advice::check_value};
  EXPECT_EQ(
      verdict_words(c),
      "Out of reach. 4 of 7 values are met, 2 are missed, 1 is not decided. Judged each by itself, 2 values "
      "are off; chance alone gives 0.4 at most.");
  EXPECT_EQ(verdict_lines(c)[1], "Not good for: UCS at 60 and 75 degrees, 11 to 13 % too high.");
  const std::string last =
      "Why: Farthest off is UCS at 60 degrees, 48.0 MPa in the model and 51.4 MPa in the table. Next: check "
      "UCS at 60 degrees in the table, or test more specimens there.";
  EXPECT_EQ(verdict_lines(c)[2], last);
  c.counts_from_load = true;
  EXPECT_EQ(verdict_lines(c)[2], last + " Angles are theta, 90 - beta of the table.");
}

/// One of every kind that the words know, with all numbers and names that any of them asks for.
Finding specimen_of(Kind kind) {
  const bool two =
      kind == Kind::ratio_missed || kind == Kind::weakest_angle || kind == Kind::weakest_angle_no_plane;
  Finding f{kind, {ucs_60}, {}, {"a", "b", "planes", "flat_joint"}};
  if (two) f.cells.push_back({Property::brazilian, 60.0});
  for (const char* name : {"model",
                           "laboratory",
                           "bound",
                           "values",
                           "met",
                           "missed",
                           "open",
                           "alone",
                           "by_chance",
                           "sd",
                           "packings",
                           "coarsest",
                           "specimens",
                           "rms",
                           "value",
                           "E_before",
                           "nearest",
                           "models",
                           "with_nu",
                           "share",
                           "nu",
                           "E",
                           "from",
                           "to",
                           "factor",
                           "laboratory_low",
                           "laboratory_high",
                           "model_low",
                           "model_high",
                           "grain_size",
                           "wanted",
                           "miss",
                           "tests",
                           "of_effort",
                           "of_tests",
                           "foreseen",
                           "more",
                           "strengths",
                           "limit",
                           "gain",
                           "low",
                           "high",
                           "unanswered",
                           "tolerances",
                           "reached",
                           "error",
                           "taken_error",
                           "of",
                           "change",
                           "usual",
                           "grains",
                           "in_radius",
                           "fewest",
                           "points",
                           "paid",
                           "draws",
                           "effective",
                           "r_hat",
                           "slope",
                           "intercept",
                           "R2",
                           "rounds",
                           "softened",
                           "ucs",
                           "tension",
                           "expected",
                           "finer",
                           "miss_finer"})
    f.numbers.push_back({name, 0.5});
  return f;
}

// Kinds of a calibration stand first in the enumeration; `values_unused` is their last.
TEST(Words, EveryKindOfACalibrationHasItsSentence) {
  for (int k = 0; k <= static_cast<int>(Kind::values_unused); ++k)
    EXPECT_FALSE(sentence(specimen_of(static_cast<Kind>(k))).empty()) << to_string(static_cast<Kind>(k));
}

TEST(Words, EverySentenceIsAsShortAsTheHouseAsks) {
  std::vector<Wording> all = words_of_calibration();
  all.insert(all.end(), words_of_notes().begin(), words_of_notes().end());
  for (const Wording& w : all) {
    std::istringstream text(sentence(specimen_of(w.kind)));
    std::size_t n = 0;
    for (std::string word; text >> word;) {
      ++n;
      if (word.back() != '.' && word.back() != ':' && word.back() != ';') continue;
      EXPECT_LE(n, 25U) << sentence(specimen_of(w.kind));
      n = 0;
    }
    EXPECT_EQ(n, 0U) << "no full stop: " << sentence(specimen_of(w.kind));
  }
}

}  // namespace
}  // namespace phy::report
