// The strength stage on synthetic rocks: it must recover responses that it is told only through noise and say
// honestly how well it knows them. What it may spend: strength_budget.test.cpp.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "calibrate/calibration.hpp"
#include "calibrate/paper_press_fixture.hpp"
#include "calibrate/strength_posterior.hpp"
#include "calibrate/strength_rocks_fixture.hpp"
#include "calibrate/strength_stage.hpp"
#include "records/reading_fixture.hpp"

namespace phy::calibrate {
namespace {

std::vector<Cell> cells_of(const std::vector<Finding>& findings, FindingKind kind) {
  std::vector<Cell> cells;
  for (const Finding& f : findings)
    if (f.kind == kind) cells.insert(cells.end(), f.cells.begin(), f.cells.end());
  return cells;
}

/// UCS over a tensile strength in the table, where it is a finding that the model misses it; else NaN.
double ratio_missed(const Calibration& c, const Cell& tension) {
  for (const Finding& f : c.verdict.findings)
    if (f.kind == FindingKind::ratio_missed && f.cells[1] == tension) return f.number("laboratory");
  return std::nan("");
}

/// Three rocks and their fits, made once.
struct Case {
  Recipe rock;
  StrengthFit fit;
};
const std::vector<Case>& cases() {
  static const std::vector<Case> list = [] {
    std::vector<Case> made;
    for (std::uint32_t k = 0; k < 3; ++k) {
      PaperPress press;
      made.push_back({truth(k), fit(laboratory(truth(k), k), press)});
    }
    return made;
  }();
  return list;
}

TEST(StrengthStage, RecoversTheNoiseFreeResponseOfUnknownRocks) {
  double squares = 0.0;
  int inside = 0, n = 0;
  for (const auto& [rock, f] : cases()) {
    ASSERT_EQ(f.fitted.size(), angles.size());
    for (const Comparison& c : f.fitted) {
      const double true_value = response(rock, c.target.theta);
      const double error = response(f.recipe, c.target.theta) / true_value - 1.0;
      squares += error * error, ++n;
      inside += c.low <= true_value && true_value <= c.high ? 1 : 0;
    }
  }
  // six parameters from seven means of three specimens with 5 % noise, and packings that differ by 3 %
  EXPECT_LT(std::sqrt(squares / n), 0.05);
  EXPECT_GE(inside, 17);  // of 21; a right 95 % interval holds fewer in 1 of 300 cases
}

TEST(StrengthStage, ParameterIntervalsHoldTheTruthAndOpenOnesAreSaidToBeOpen) {
  int inside = 0, open = 0;
  for (const auto& [rock, f] : cases()) {
    ASSERT_EQ(f.parameters.size(), 9U);
    const MatrixRecipe& m = rock.matrix;
    const BeddingRecipe& b = rock.bedding[0];
    const std::vector<double> values = {
        m.sigma_c, m.tau_c / m.sigma_c, m.mu,     b.cohesion / m.tau_c, b.sigma_n / b.cohesion, b.mu,
        m.tau_c,   b.cohesion,          b.sigma_n};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const ParameterEstimate& e = f.parameters[i];
      EXPECT_LE(e.low, e.value) << e.symbol;
      EXPECT_GE(e.high, e.value) << e.symbol;
      inside += e.low <= values[i] && values[i] <= e.high ? 1 : 0;
      open += e.determined ? 0 : 1;
    }
  }
  // Of 27. Ten such rocks hold 76 and 73 of 90 by two chains of draws (measured/statistics.csv), and three of
  // them scatter by two or three. Intervals half as wide would hold half.
  EXPECT_GE(inside, 19);
  EXPECT_GE(open, 3);  // UCS alone cannot tell the friction of the matrix from its strength
}

TEST(StrengthStage, JointsThatDilateMoreThanTheyMayRubAreRefused) {
  Rock rock =
      rock_of({{Property::ucs, 0.0, 150e6}, {Property::ucs, 30.0, 80e6}, {Property::ucs, 60.0, 60e6}}, true);
  rock.model.bedding[0].psi = 46.0;
  PaperPress press;
  try {
    calibrate(Evidence(rock), {}, press);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("bedding.psi = 46 deg"),
                                             testing::HasSubstr("tan(psi) <= 1")));
  }
  rock.model.bedding[0].psi = 44.0;
  EXPECT_EQ(calibrate(Evidence(rock), {}, press).left_out.size(), 0U);
}

TEST(StrengthStage, TheSameAnswersGiveTheSameFit) {
  PaperPress a, b;
  const std::vector<Target> targets = laboratory(truth(2), 2);
  const Searched first = fit(targets, a, {140}), second = fit(targets, b, {140});
  for (std::size_t i = 0; i < first.parameters.size(); ++i) {
    EXPECT_EQ(first.parameters[i].value, second.parameters[i].value);
    EXPECT_EQ(first.parameters[i].low, second.parameters[i].low);
  }
}

TEST(StrengthStage, EveryAngleIsPredictedFromTheOthers) {
  PaperPress press;
  const Recipe rock = truth(3);
  const StrengthFit f = fit(laboratory(rock, 3), press);
  ASSERT_EQ(f.left_out.size(), angles.size());
  int inside = 0;
  for (const Comparison& c : f.left_out)
    inside += c.low <= response(rock, c.target.theta) && response(rock, c.target.theta) <= c.high ? 1 : 0;
  EXPECT_GE(inside, 5);
}

TEST(StrengthStage, ARockWithoutBeddingHasThreeStrengthParameters) {
  PaperPress press;
  Rock rock;
  rock.bedded = false;
  const Searched f = searched(rock, {{Property::ucs, 0.0, 150e6, 7e6, 3, false}}, press, {40});
  ASSERT_EQ(f.parameters.size(), 4U);  // sigma_c, tau_c/sigma_c, mu, and tau_c
  EXPECT_NEAR(PaperPress::ucs(f.recipe) / 150e6, 1.0, 0.06);
  EXPECT_TRUE(f.left_out.empty());
}

TEST(StrengthStage, ARatioOfCompressionToTensionOutOfReachIsAnsweredWithTheNearest) {
  PaperPress press;  // reaches 9 at most
  const Rock rock = rock_of({{Property::ucs, 0.0, 150e6}, {Property::direct_tension, 0.0, 10e6}}, false);
  const Calibration c = calibrate(Evidence(rock), {}, press);
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_NEAR(ratio_missed(c, {Property::direct_tension, nan}), 15.0, 1e-9);
  const Comparison *ucs = nullptr, *tension = nullptr;
  for (const Comparison& row : c.verification) (row.target.property == Property::ucs ? ucs : tension) = &row;
  ASSERT_TRUE(ucs != nullptr && tension != nullptr);
  EXPECT_GT(ucs->mean / tension->mean, 7.0);  // and the nearest is near what the model can do
}

TEST(StrengthStage, ARatioOfCompressionToBrazilianStrengthOutOfReachIsAnsweredWithTheNearest) {
  PaperPress press;  // reaches 7.5 at most
  const Rock rock = rock_of({{Property::ucs, 0.0, 150e6}, {Property::brazilian, 0.0, 10e6}}, false);
  const Calibration c = calibrate(Evidence(rock), {}, press);
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_NEAR(ratio_missed(c, {Property::brazilian, nan}), 15.0, 1e-9);
  double ucs = 0.0, bts = 0.0;
  for (const Comparison& row : c.verification) (row.target.property == Property::ucs ? ucs : bts) = row.mean;
  EXPECT_GT(ucs / bts, 5.5);
  EXPECT_EQ(c.counts.tension, 36 + 5);  // beside as many of UCS
  EXPECT_EQ(c.counts.tests, 2 * (36 + 5));
}

TEST(StrengthStage, TheSameRatioAtEveryAngleIsOutOfReachToo) {
  PaperPress press;
  const Recipe rock = truth(4);
  std::vector<std::tuple<Property, double, double>> values;
  for (const double theta : {0.0, 30.0, 60.0, 90.0}) {
    values.emplace_back(Property::ucs, theta, response(rock, theta));
    values.emplace_back(Property::brazilian, theta, response(rock, theta) / 15.0);
  }
  const Calibration c = calibrate(Evidence(rock_of(values, true)), {}, press);
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_NEAR(ratio_missed(c, {Property::brazilian, 0.0}), 15.0, 1e-9);
}

/// Mean logarithm of UCS at four angles over the posterior, for a table with BTS(0) of UCS(0)/ratio and
/// eighty runs all over the box.
std::vector<double> ucs_beside_bts(const Recipe& rock, double ratio) {
  std::vector<std::tuple<Property, double, double>> values;
  for (const double theta : {0.0, 30.0, 60.0, 90.0})
    values.emplace_back(Property::ucs, theta, response(rock, theta));
  values.emplace_back(Property::brazilian, 0.0, response(rock, 0.0) / ratio);
  const Evidence evidence(rock_of(values, true));
  StrengthPosterior posterior(evidence, rock);
  for (std::uint32_t k = 0; k < 80; ++k) {
    Point x = posterior.middle_of_box();
    for (std::uint32_t d = 1; d < x.size(); ++d) x[d] = 2.0 * uniform(12, Stream::test, k, d) - 1.0;
    Recipe run = posterior.recipe_at(rock, x);
    for (std::size_t i = 0; i < posterior.n_targets(); ++i) {
      run.bedding[0].theta = posterior.targets()[i].theta;
      const double strength = posterior.targets()[i].property == Property::ucs ? PaperPress::ucs(run)
                                                                               : PaperPress::splitting(run);
      posterior.add_run(i, {{x.begin() + 1, x.end()},
                            static_cast<int>(k % 12),
                            false,
                            std::log(strength) - StrengthPosterior::log_sigma_c(x)});
    }
  }
  posterior.learn();
  const std::vector<Point> draws = posterior.draws_with_discrepancy(1);
  std::vector<double> mean(4, 0.0);
  for (std::size_t i = 0; i < mean.size(); ++i)
    for (const Point& x : draws) mean[i] += posterior.predict(x, i).mean / static_cast<double>(draws.size());
  return mean;
}

// The press reaches UCS/BTS of 7.5.
TEST(StrengthStage, ATensionThatCannotBeMetDoesNotTakeUcsAlong) {
  for (const std::uint32_t k : {4U, 6U, 8U}) {
    const std::vector<double> met = ucs_beside_bts(truth(k), 7.0), moved = ucs_beside_bts(truth(k), 12.0);
    double mean = 0.0;
    for (std::size_t i = 0; i < met.size(); ++i) {
      mean += (moved[i] - met[i]) / static_cast<double>(met.size());
      EXPECT_NEAR(moved[i], met[i], 0.03) << k;  // up to 2.6 %, docs/calibration.md
    }
    EXPECT_NEAR(mean, 0.0, 0.02) << k;
  }
}

// UCS(30) is beyond every rock, and the ratios at other angles are not to blame.
TEST(StrengthStage, OnlyRatiosThatDifferAreListed) {
  PaperPress press;
  Recipe rock = truth(4);
  std::vector<std::tuple<Property, double, double>> values;
  for (const double theta : {0.0, 30.0, 60.0, 90.0}) {
    rock.bedding[0].theta = theta;
    values.emplace_back(Property::ucs, theta, (theta == 30.0 ? 2.5 : 1.0) * PaperPress::ucs(rock));
    values.emplace_back(Property::brazilian, theta, PaperPress::splitting(rock));
  }
  const Calibration c = calibrate(Evidence(rock_of(values, true)), {}, press);
  ASSERT_TRUE(misses_table(c.verdict.status));
  int listed = 0, agreeing = 0;
  for (const double theta : {0.0, 30.0, 60.0, 90.0}) {
    double lab = 1.0, model = 1.0;
    for (const Comparison& row : c.verification) {
      if (row.target.theta != theta) continue;
      const double sign = row.target.property == Property::ucs ? 1.0 : -1.0;
      lab *= std::pow(row.target.mean, sign), model *= std::pow(row.mean, sign);
    }
    const bool differ = std::fabs(model / lab - 1.0) > 0.1;
    (differ ? listed : agreeing) += 1;
    int lines = 0;
    for (const Finding& f : c.verdict.findings)
      lines += f.kind == FindingKind::ratio_missed && f.cells[1].theta == theta ? 1 : 0;
    EXPECT_EQ(lines, differ ? 1 : 0) << theta << ": " << lab << " and " << model;
  }
  EXPECT_GE(listed, 1);
  EXPECT_GE(agreeing, 1);
}

/// A rock whose joints are weak in tension alone.
Recipe opening_rock() {
  Recipe rock = truth(4);
  rock.matrix.tau_c = 2.0 * rock.matrix.sigma_c;
  rock.bedding[0].cohesion = 0.3 * rock.matrix.tau_c;
  rock.bedding[0].sigma_n = 0.12 * rock.bedding[0].cohesion;
  return rock;
}

TEST(StrengthStage, BrazilianStrengthThatIsLowOnlyWhereBeddingOpensIsAccepted) {
  PaperPress press;
  press.first_crack = 0.3;
  Recipe rock = opening_rock();
  std::vector<std::tuple<Property, double, double>> values;
  for (const double theta : {0.0, 30.0, 60.0, 90.0}) {
    rock.bedding[0].theta = theta;
    values.emplace_back(Property::ucs, theta, PaperPress::ucs(rock));
    values.emplace_back(Property::brazilian, theta, PaperPress::splitting(rock));
  }
  const Calibration c = calibrate(Evidence(rock_of(values, true)), {}, press);
  EXPECT_NE(c.verdict.status, VerdictStatus::out_of_reach);
  for (const Comparison& row : c.verification) EXPECT_NEAR(row.error(), 0.0, 0.12) << row.target.theta;
  for (const ParameterEstimate& e : c.parameters) {
    if (e.symbol != "sigma_n,sj") continue;
    EXPECT_TRUE(e.determined) << e.low << " " << e.high;
  }
  const Finding* cracks = first_of(c.notes, FindingKind::cracks_off_centre);
  ASSERT_NE(cracks, nullptr);
  EXPECT_EQ(cracks->number("tests"), 5.0);
  EXPECT_EQ(cracks->number("of"), 5.0);
}

TEST(StrengthStage, DiscsHaveTheDiameterOfTheirRow) {
  Rock rock = rock_of({{Property::ucs, 0.0, 150e6}, {Property::brazilian, 0.0, 25e6}}, false);
  rock.readings.push_back(rock.readings.back());
  rock.readings.back().diameter = 0.02, rock.readings.back().value *= std::pow(1.9, 0.2);
  PaperPress press;
  const Calibration c = calibrate(Evidence(rock), {}, press);
  ASSERT_EQ(c.verification.size(), 3U);
  EXPECT_EQ(c.verification[1].target.diameter, 0.0);
  EXPECT_EQ(c.verification[2].target.diameter, 0.02);
  for (const Comparison& row : c.verification)
    EXPECT_NEAR(row.error(), 0.0, row.target.property == Property::ucs ? 0.06 : 0.10);
}

TEST(StrengthStage, TensionThatIsLowOnlyWhereBeddingOpensIsAccepted) {
  PaperPress press;
  Recipe truth_rock = opening_rock();
  std::vector<std::tuple<Property, double, double>> values;
  for (const double theta : {0.0, 30.0, 60.0, 90.0}) {
    truth_rock.bedding[0].theta = theta;
    values.emplace_back(Property::ucs, theta, PaperPress::ucs(truth_rock));
    values.emplace_back(Property::direct_tension, theta, PaperPress::tension(truth_rock));
  }
  const Calibration c = calibrate(Evidence(rock_of(values, true)), {}, press);
  EXPECT_NE(c.verdict.status, VerdictStatus::out_of_reach);
  for (const Comparison& row : c.verification) EXPECT_NEAR(row.error(), 0.0, 0.12) << row.target.theta;
  for (const ParameterEstimate& e : c.parameters) {
    if (e.symbol != "sigma_n,sj") continue;
    // the table alone: 6.2 % standard error, as three specimens of 5 % leave of the 15 % that are expected, a
    // factor of 1.27. Walkers that have not found to where the table is met leave a factor of 25. Of the
    // moment contribution, which is sought too, this press knows nothing.
    EXPECT_LT(e.high / e.low, 1.8);
    EXPECT_LT(e.low, truth_rock.bedding[0].sigma_n);
    EXPECT_GT(e.high, truth_rock.bedding[0].sigma_n);
  }
}

TEST(StrengthStage, WhateverIsLeftOpenIsToldWithTheTestThatWouldTellMore) {
  PaperPress press;
  const Rock rock = rock_of({{Property::ucs, 0.0, 150e6}, {Property::ucs, 90.0, 170e6}}, true);
  int open = 0;
  for (const ParameterEstimate& e : calibrate(Evidence(rock), {}, press).parameters) {
    EXPECT_EQ(e.next.remedy == Remedy::none, e.determined) << e.symbol;
    open += e.determined ? 0 : 1;
  }
  EXPECT_GE(open, 4);
}

/// UCS of the first rock at four angles, found when `peaks` decides which tests peak.
Calibration found(const std::function<bool(const Recipe&)>& peaks) {
  PaperPress press;
  press.peaks = peaks;
  std::vector<std::tuple<Property, double, double>> values;
  for (const double theta : {0.0, 30.0, 60.0, 90.0})
    values.emplace_back(Property::ucs, theta, response(truth(0), theta));
  CalibrationOptions options;
  options.max_tests = 80;
  return calibrate(Evidence(rock_of(values, true)), options, press);
}
bool is_unseen(const Recipe& r) { return r.packing.seed > 5 && r.packing.seed <= 10; }

TEST(StrengthStage, AnAngleWithoutAnyPeakIsOutOfReach) {
  const Calibration c = found([](const Recipe& r) { return r.bedding[0].theta != 30.0; });
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_THAT(cells_of(c.verdict.findings, FindingKind::search_unanswered),
              testing::ElementsAre(Cell{Property::ucs, 30.0}));
}

TEST(StrengthStage, AnAngleWithoutAPeakOnUnseenPackingsIsOutOfReach) {
  const Calibration c = found([](const Recipe& r) { return !is_unseen(r) || r.bedding[0].theta != 30.0; });
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  const Finding* none = first_of(c.verdict.findings, FindingKind::no_usable_peak);
  ASSERT_NE(none, nullptr);
  EXPECT_EQ(none->cells.front(), (Cell{Property::ucs, 30.0}));
  EXPECT_FALSE(none->names.front().empty()) << "the reason of the test";
}

TEST(StrengthStage, EveryAngleWithoutAPeakIsReportedAndTestsOfTheSearchOnce) {
  const Calibration none = found([](const Recipe& r) { return !is_unseen(r); });
  EXPECT_EQ(cells_of(none.verdict.findings, FindingKind::no_usable_peak).size(), 4U);
  const Calibration some = found([](const Recipe& r) { return r.packing.seed != 2; });
  EXPECT_EQ(std::count_if(some.notes.begin(), some.notes.end(),
                          [](const Finding& f) { return f.kind == FindingKind::peaks_left_out; }),
            1);
}

TEST(StrengthStage, UnseenPackingsWithoutAPeakAreCounted) {
  const Calibration c =
      found([](const Recipe& r) { return r.packing.seed != 7 || r.bedding[0].theta != 30.0; });
  const Finding* missing = first_of(c.notes, FindingKind::peaks_missing);
  ASSERT_NE(missing, nullptr);
  EXPECT_EQ(missing->cells.front(), (Cell{Property::ucs, 30.0}));
  EXPECT_EQ(missing->number("tests"), 1.0);
  EXPECT_EQ(missing->number("of"), 5.0);
}

TEST(StrengthStage, ASingleSpecimenIsNoReasonToCallARatioMet) {
  // a ratio of 8.3 where the press reaches 7.5; 15 % are assumed of one disc, 10 % of one cylinder
  Rock rock = rock_of({{Property::ucs, 0.0, 150e6}, {Property::brazilian, 0.0, 18e6}}, false);
  for (RockReading& r : rock.readings) r.sd = std::nan(""), r.n = 1;
  PaperPress press;
  const Calibration c = calibrate(Evidence(rock), {}, press);
  const Comparison& disc = c.verification.back();
  ASSERT_GT(disc.error(), 0.12);
  EXPECT_EQ(c.verdict.status, VerdictStatus::not_decided);
  EXPECT_NE(first_of(c.verdict.findings, FindingKind::scatter_unstated), nullptr);
  EXPECT_THAT(cells_of(c.verdict.findings, FindingKind::value_open),
              testing::Contains(Cell{Property::brazilian, nan}));
}

TEST(StrengthStage, WithoutAnElasticAnswerNoStrengthIsTestedAndTheTableIsOutOfReach) {
  PaperPress press;
  press.carries_load = false;
  const Calibration c =
      calibrate(Evidence(rock_of({{Property::E, 0.0, 40e9}, {Property::ucs, 0.0, 150e6}}, false)), {}, press);
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_THAT(cells_of(c.verdict.findings, FindingKind::fit_unanswered),
              testing::ElementsAre(Cell{Property::E, nan}));
  EXPECT_EQ(press.n_tests, 0);
}

TEST(StrengthStage, ATableWithNothingToFitIsRefused) {
  PaperPress press;
  EXPECT_THROW(calibrate(Evidence(rock_of({{Property::brazilian, 0.0, 10e6}}, false)), {}, press),
               InputError);
  CalibrationOptions elastic;
  elastic.elastic_only = true;
  EXPECT_THROW(calibrate(Evidence(rock_of({{Property::ucs, 0.0, 100e6}}, false)), elastic, press),
               InputError);
}

TEST(StrengthStage, NoJointDilatesMoreThanItRubs) {
  Rock rock = rock_of({{Property::ucs, 0.0, 150e6}, {Property::ucs, 45.0, 60e6}}, true);
  rock.model.bedding[0].psi = 20.0;
  PaperPress press;
  double least = 1.0;
  press.peaks = [&](const Recipe& r) { return least = std::min(least, r.bedding[0].mu), true; };
  const Calibration c = calibrate(Evidence(rock), {}, press);
  EXPECT_GE(least, std::tan(20.0 * 3.14159265358979323846 / 180.0));
  EXPECT_LT(least, 0.5);  // and near it the box is searched
  EXPECT_GE(c.recipe.bedding[0].mu, least);
}

}  // namespace
}  // namespace phy::calibrate
