// The strength stage on synthetic rocks: it must recover responses that it is told only through noise, say
// honestly how well it knows them, and keep to its budget.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "base/check.hpp"
#include "calibrate/calibration.hpp"
#include "calibrate/paper_press_fixture.hpp"
#include "calibrate/reading_fixture.hpp"
#include "calibrate/strength_posterior.hpp"
#include "calibrate/strength_stage.hpp"

namespace phy::calibrate {
namespace {

const std::vector<double> angles = {0, 15, 30, 45, 60, 75, 90};
const std::vector<std::int64_t> seeds = {1, 2, 3, 4, 5};
constexpr double noise = 0.05;
constexpr int n_specimens = 3;

/// Synthetic rock k: strengths anywhere in the box of the twin trials.
Recipe truth(std::uint32_t k) {
  const auto between = [&](double low, double high, std::uint32_t what) {
    return low * std::pow(high / low, uniform(11, Stream::test, k, what));
  };
  Recipe r;
  r.bedding.resize(1);
  r.matrix.sigma_c = between(20e6, 120e6, 0), r.matrix.tau_c = r.matrix.sigma_c * between(1.0, 4.0, 1);
  r.matrix.mu = between(0.3, 0.9, 2);
  r.bedding[0].cohesion = r.matrix.tau_c * between(0.1, 0.6, 3);
  r.bedding[0].sigma_n = r.bedding[0].cohesion * between(0.1, 1.0, 4);
  r.bedding[0].mu = between(0.2, 0.8, 5);
  return r;
}

double response(Recipe r, double theta) {
  r.bedding[0].theta = theta;
  return PaperPress::ucs(r);
}

std::vector<Target> laboratory(const Recipe& rock, std::uint32_t k) {
  std::vector<Target> targets;
  for (const double theta : angles) {
    Target t{Property::ucs, theta, 0.0, 0.0, n_specimens, false};
    const double error =
        noise / std::sqrt(n_specimens) * normal(5, Stream::test, k, static_cast<std::uint32_t>(theta));
    t.mean = response(rock, theta) * (1.0 + error), t.sd = noise * t.mean;
    targets.push_back(t);
  }
  return targets;
}

/// Five of the seven angles: enough for what a search counts.
std::vector<Target> some_of(std::vector<Target> targets) {
  std::erase_if(targets, [](const Target& t) { return t.theta == 15.0 || t.theta == 75.0; });
  return targets;
}

StrengthFit fit(const std::vector<Target>& targets, PaperPress& press, const Budget& budget = 252) {
  Rock rock;
  rock.model.bedding.resize(1);
  return fit_strength(Evidence(rock, targets), rock.model, seeds, budget, press, Listener{});
}

/// A rock of strengths only.
Rock rock_of(const std::vector<std::tuple<Property, double, double>>& values, bool bedded) {
  Rock rock;
  rock.bedded = bedded;
  if (bedded) rock.model.bedding.resize(1);
  for (const auto& [property, theta, value] : values)
    rock.readings.push_back(reading(property, theta, value));
  return rock;
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
  int inside = 0, n = 0, open = 0;
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
      inside += e.low <= values[i] && values[i] <= e.high ? 1 : 0, ++n;
      open += e.determined ? 0 : 1;
    }
  }
  EXPECT_GE(inside, n - 4);
  EXPECT_GE(open, 3);  // UCS alone cannot tell the friction of the matrix from its strength
}

TEST(StrengthStage, KeepsToItsBudgetAndAnnouncesWhatComes) {
  PaperPress press;
  const StrengthFit f = fit(laboratory(truth(1), 1), press, 200);
  EXPECT_EQ(f.n_tests, press.n_tests);
  EXPECT_EQ(f.n_tests, 28 * 7) << "a whole search, and no round beyond the budget";
  EXPECT_EQ(f.longer_by, "");
  EXPECT_GT(f.n_coarse, 0);
  EXPECT_EQ(press.n_announced, f.n_tests + static_cast<std::int64_t>(angles.size() * seeds.size()));
}

TEST(StrengthStage, SeveralThreadsFindTheSame) {
  const auto found = [](int threads) {
    PaperPress press;
    press.n_threads = threads;
    return fit(laboratory(truth(1), 1), press, {70, efforts[0]});
  };
  const StrengthFit one = found(1), three = found(3);
  ASSERT_EQ(one.parameters.size(), three.parameters.size());
  for (std::size_t i = 0; i < one.parameters.size(); ++i) {
    EXPECT_EQ(one.parameters[i].value, three.parameters[i].value) << one.parameters[i].symbol;
    EXPECT_EQ(one.parameters[i].low, three.parameters[i].low) << one.parameters[i].symbol;
  }
  for (std::size_t i = 0; i < one.left_out.size(); ++i)
    EXPECT_EQ(one.left_out[i].mean, three.left_out[i].mean) << i;
}

// Two of four packings, and two more where these surprise.
TEST(StrengthStage, AfterCoarseGrainsFewRoundsAtTheEstimateFollow) {
  const auto rounds_of = [](double scatter) {
    PaperPress press;
    press.packing_scatter = scatter;
    const StrengthFit f = fit(laboratory(truth(1), 1), press, 1000);
    EXPECT_EQ(f.n_coarse, 20 * 7);
    return static_cast<double>(f.n_tests - f.n_coarse) / (4 * 7);
  };
  EXPECT_EQ(rounds_of(0.002), 2.0);
  EXPECT_EQ(rounds_of(0.2), 4.0);
}

// Packings that differ much surprise: rounds of four go on, six at most, as far as the budget goes.
TEST(StrengthStage, TheSearchGoesOnWhileTheEstimateIsNotSettled) {
  const auto found = [](double scatter, const Budget& budget) {
    PaperPress press;
    press.packing_scatter = scatter;
    Rock rock;
    rock.model.bedding.resize(1), rock.model.packing.n_grains = 1197;  // no coarse grains
    return fit_strength(Evidence(rock, some_of(laboratory(truth(1), 1))), rock.model, seeds, budget, press,
                        Listener{});
  };
  const auto unsettled = [](const StrengthFit& f) {
    return std::any_of(f.notes.begin(), f.notes.end(),
                       [](const std::string& note) { return note.find("had not settled") != note.npos; });
  };
  constexpr std::int64_t usual = 36 * 5, round = 4 * 5;  // tests at five angles
  const StrengthFit calm = found(0.005, 1000), wild = found(0.2, 1000),
                    short_of_money = found(0.2, usual + round);
  EXPECT_FALSE(unsettled(calm));
  EXPECT_LT(calm.n_tests, wild.n_tests);
  EXPECT_GT(wild.n_tests, usual + round);
  EXPECT_LE(wild.n_tests, usual + 6 * round);
  EXPECT_EQ(short_of_money.n_tests, usual + round);
  EXPECT_TRUE(unsettled(short_of_money));
  EXPECT_EQ(calm.longer_by, "");
}

TEST(StrengthStage, EffortIsTheNumberOfPoints) {
  const auto found = [](const Budget& budget) {
    PaperPress press;
    press.packing_scatter = 0.005;
    Rock rock;
    rock.model.bedding.resize(1), rock.model.packing.n_grains = 1197;  // no coarse grains
    return fit_strength(Evidence(rock, some_of(laboratory(truth(1), 1))), rock.model, seeds, budget, press,
                        Listener{});
  };
  constexpr std::int64_t n_angles = 5;
  const StrengthFit quick = found({1000, efforts[0]}), thorough = found({72 * n_angles, efforts[2]}),
                    cut = found({20 * n_angles, efforts[2]}), part = found({50 * n_angles, efforts[2]}),
                    both = found({20 * n_angles, efforts[0]});
  EXPECT_EQ(quick.n_tests, 18 * n_angles);
  EXPECT_EQ(quick.longer_by, "--effort normal");
  EXPECT_EQ(thorough.n_tests, 72 * n_angles);
  EXPECT_EQ(thorough.longer_by, "");
  EXPECT_EQ(cut.n_tests, 20 * n_angles);
  EXPECT_EQ(cut.longer_by, "a larger --max-tests");
  EXPECT_EQ(both.longer_by, "--effort normal and a larger --max-tests");
  EXPECT_EQ(part.longer_by, "") << "more than a usual search";
  EXPECT_THAT(part.notes, testing::Contains("of the 72 points of a thorough search --max-tests paid for 50"));
}

TEST(StrengthStage, AShortSearchTellsHowManyPackingsItSaw) {
  PaperPress press;
  Rock rock;
  rock.model.bedding.resize(1);
  const std::vector<std::int64_t> twelve = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const auto packings = [&](std::int64_t budget) {
    const StrengthFit f =
        fit_strength(Evidence(rock, laboratory(truth(1), 1)), rock.model, twelve, budget, press, Listener{});
    return f.fitted.front().n_packings;
  };
  // Five and two points, two to a packing, and the estimate on two more.
  EXPECT_EQ(packings(63), 6);
  EXPECT_EQ(packings(252), 12);
}

TEST(StrengthStage, PackingsByPorosityAreSearchedOnCoarseGrainsToo) {
  Rock rock;
  rock.model.bedding.resize(1);
  rock.model.packing.n_grains = 0, rock.model.packing.porosity = 0.082;
  const auto n_coarse = [&] {
    PaperPress press;
    return fit_strength(Evidence(rock, laboratory(truth(1), 1)), rock.model, seeds, 63, press, Listener{})
        .n_coarse;
  };
  EXPECT_EQ(n_coarse(), 7 * 7);
  rock.model.packing.radius_min *= 1.5, rock.model.packing.radius_max *= 1.5;  // some 3,300 grains: too few
  EXPECT_EQ(n_coarse(), 0);
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
  const StrengthFit first = fit(targets, a, 140), second = fit(targets, b, 140);
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
  const StrengthFit f = fit_strength(Evidence(rock, {{Property::ucs, 0.0, 150e6, 7e6, 3, false}}), rock.model,
                                     seeds, 40, press, Listener{});
  ASSERT_EQ(f.parameters.size(), 4U);  // sigma_c, tau_c/sigma_c, mu, and tau_c
  EXPECT_NEAR(PaperPress::ucs(f.recipe) / 150e6, 1.0, 0.06);
  EXPECT_TRUE(f.left_out.empty());
}

TEST(StrengthStage, ARatioOfCompressionToTensionOutOfReachIsAnsweredWithTheNearest) {
  PaperPress press;  // reaches 9 at most
  const Rock rock = rock_of({{Property::ucs, 0.0, 150e6}, {Property::direct_tension, 0.0, 10e6}}, false);
  const Calibration c = calibrate(Evidence(rock), {}, press);
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_THAT(c.verdict.findings,
              testing::Contains(testing::HasSubstr("UCS/DTS(0) = 15.0 in the laboratory")));
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
  EXPECT_THAT(c.verdict.findings,
              testing::Contains(testing::HasSubstr("UCS/BTS(0) = 15.0 in the laboratory")));
  double ucs = 0.0, bts = 0.0;
  for (const Comparison& row : c.verification) (row.target.property == Property::ucs ? ucs : bts) = row.mean;
  EXPECT_GT(ucs / bts, 5.5);
  EXPECT_EQ(c.n_tension_tests, 36 + 5);  // beside as many of UCS
  EXPECT_EQ(c.n_strength_tests, 2 * (36 + 5));
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
  EXPECT_THAT(c.verdict.findings, testing::Contains(testing::HasSubstr("UCS/BTS(0) = 15.0")));
}

TEST(StrengthStage, WherePackingsDifferMuchMoreOfThemVerifyAsFarAsTheBudgetGoes) {
  Rock rock = rock_of({{Property::ucs, 0.0, 150e6}}, false);
  rock.model.packing.n_grains = 1197;
  std::int64_t n_search = 18;
  const auto n_unseen = [&](double scatter, std::int64_t max_tests) {
    PaperPress press;
    press.packing_scatter = scatter;
    CalibrationOptions options;
    options.max_tests = max_tests, options.effort = efforts[0];  // 18 points, no further rounds
    const Calibration c = calibrate(Evidence(rock), options, press);
    for (const Comparison& row : c.verification) EXPECT_EQ(row.n_packings, c.verification.front().n_packings);
    const bool told = std::any_of(c.notes.begin(), c.notes.end(), [](const std::string& note) {
      return note.find("unseen ones were taken") != note.npos;
    });
    EXPECT_EQ(told, c.verification.front().n_packings > 5);
    EXPECT_EQ(c.n_strength_tests, n_search + c.verification.front().n_packings);
    return c.verification.front().n_packings;
  };
  EXPECT_EQ(n_unseen(0.02, 1000), 5);
  EXPECT_EQ(n_unseen(0.12, 1000), 15);
  EXPECT_EQ(n_unseen(0.12, 18 + 10), 10);
  rock.model.packing.n_grains = 7481, n_search = 14;  // ten of them coarse; more are too dear
  EXPECT_EQ(n_unseen(0.12, 1000), 5);
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
  const std::vector<Point> draws = posterior.settled_draws(1);
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
  ASSERT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
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
    for (const std::string& finding : c.verdict.findings)
      lines += finding.starts_with(fmt::format("UCS/BTS({:g})", theta)) ? 1 : 0;
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
  EXPECT_NE(c.verdict.status, VerdictStatus::out_of_reach) << testing::PrintToString(c.verdict.findings);
  for (const Comparison& row : c.verification) EXPECT_NEAR(row.error(), 0.0, 0.12) << row.target.theta;
  for (const ParameterEstimate& e : c.parameters) {
    if (e.symbol != "sigma_n,sj") continue;
    EXPECT_TRUE(e.determined) << e.low << " " << e.high;
  }
  EXPECT_THAT(c.notes, testing::Contains(testing::HasSubstr("5 of 5 tests on unseen packings the first")));
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
  EXPECT_NE(c.verdict.status, VerdictStatus::out_of_reach) << testing::PrintToString(c.verdict.findings);
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
    EXPECT_EQ(e.next_test.empty(), e.determined) << e.symbol;
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
  EXPECT_THAT(c.verdict.findings, testing::Contains(testing::HasSubstr("strengths were not fitted")));
}

TEST(StrengthStage, AnAngleWithoutAPeakOnUnseenPackingsIsOutOfReach) {
  const Calibration c = found([](const Recipe& r) { return !is_unseen(r) || r.bedding[0].theta != 30.0; });
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_THAT(c.verdict.findings,
              testing::Contains(
                  "UCS(30): no test on unseen packings gave a usable peak (no drop; raise test.max_strain)"));
}

TEST(StrengthStage, WhatIsTheSameAtAllAnglesIsOneLine) {
  const Calibration none = found([](const Recipe& r) { return !is_unseen(r); });
  EXPECT_THAT(
      none.verdict.findings,
      testing::Contains(
          "UCS(0), UCS(30), UCS(60), UCS(90): no test on unseen packings gave a usable peak (no drop; "
          "raise test.max_strain)"));
  const Calibration some = found([](const Recipe& r) { return r.packing.seed != 2; });
  int reported = 0;
  for (const std::string& note : some.notes)
    reported += note.find("of the search gave no usable peak") != note.npos ? 1 : 0;
  EXPECT_EQ(reported, 1) << testing::PrintToString(some.notes);
}

TEST(StrengthStage, UnseenPackingsWithoutAPeakAreCounted) {
  const Calibration c =
      found([](const Recipe& r) { return r.packing.seed != 7 || r.bedding[0].theta != 30.0; });
  EXPECT_THAT(
      c.notes,
      testing::Contains(
          "UCS(30): 1 of 5 tests on unseen packings gave no usable peak (no drop; raise test.max_strain)"));
}

TEST(StrengthStage, ASingleSpecimenIsNoReasonToCallARatioMet) {
  // a ratio of 8.3 where the press reaches 7.5; 15 % are assumed of one disc, 10 % of one cylinder
  Rock rock = rock_of({{Property::ucs, 0.0, 150e6}, {Property::brazilian, 0.0, 18e6}}, false);
  for (RockReading& r : rock.readings) r.sd = std::nan(""), r.n = 1;
  PaperPress press;
  const Calibration c = calibrate(Evidence(rock), {}, press);
  const Comparison& disc = c.verification.back();
  ASSERT_GT(disc.error(), 0.12);
  ASSERT_LT(disc.error(), 0.41);  // 2.78 times 15 %: Student's t of four degrees of freedom
  EXPECT_EQ(c.verdict.status, VerdictStatus::not_resolved);
  EXPECT_THAT(c.verdict.findings, testing::Contains(testing::StartsWith("BTS(0): not resolved")));
}

TEST(StrengthStage, WithoutAnElasticAnswerNoStrengthIsTestedAndTheTableIsOutOfReach) {
  PaperPress press;
  press.carries_load = false;
  const Calibration c =
      calibrate(Evidence(rock_of({{Property::E, 0.0, 40e9}, {Property::ucs, 0.0, 150e6}}, false)), {}, press);
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_THAT(c.verdict.findings, testing::Contains(testing::HasSubstr("E(0): the model has no answer")));
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

TEST(StrengthStage, StopsWhenTheUserDoes) {
  PaperPress press;
  press.stop_after = 100;
  const StrengthFit f = fit(laboratory(truth(1), 1), press);
  EXPECT_TRUE(f.interrupted);
  EXPECT_TRUE(f.parameters.empty());
}

}  // namespace
}  // namespace phy::calibrate
