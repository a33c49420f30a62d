// The whole calibration on a press of closed forms: what it tells the user beside the numbers.
#include "calibrate/calibration.hpp"
#include "calibrate/model_trial.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include "base/stats.hpp"
#include "calibrate/outlook.hpp"
#include "calibrate/paper_press_fixture.hpp"
#include "calibrate/softening.hpp"
#include "calibrate/twin.hpp"
#include "records/reading_fixture.hpp"
#include "records/recipe_schema.hpp"
#include "theory/goodman.hpp"

namespace phy::calibrate {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A model between parallel bonds, as findings name it.
std::string name_of(LayerModel layers) {
  return text_of(*find_model(true, layers, MatrixModel::parallel_bond), 1.0);
}

/// A finding of this kind.
MATCHER_P(Is, kind, "is a " + std::string(to_string(kind))) { return arg.kind == kind; }

/// A jointed rock that the press can be: E, nu and UCS at four angles.
Rock rock(double nu_factor = 1.0) {
  Rock made;
  made.name = "shale";
  made.model.bedding.resize(1);
  const theory::JointedRock macro{50e9, 90e9, 40e9, 0.25};
  Recipe truth = made.model;
  for (const double theta : {0.0, 30.0, 60.0, 90.0}) {
    truth.bedding[0].theta = theta;
    made.readings.push_back(reading(Property::E, theta, theory::goodman_E(macro, theta)));
    made.readings.push_back(reading(Property::nu, theta, nu_factor * theory::goodman_nu(macro, theta)));
    made.readings.push_back(reading(Property::ucs, theta, PaperPress::ucs(truth)));
  }
  return made;
}

Calibration calibrated(const Rock& rock, PaperPress& press, bool elastic_only = false) {
  CalibrationOptions options;
  options.elastic_only = elastic_only,
  options.max_tests = 4 * (8 + 5 + (rock.E_is == ModulusReading::small_strain ? 0 : 5));
  return calibrate(Evidence(rock), options, press);
}

TEST(Calibrate, TheModuliOfThePressAtHalfOfTheStrengthStandBesideTheTable) {
  PaperPress press;
  press.tangent = 0.8, press.modulus_scatter = 0.05;
  const Calibration c = calibrated(rock(), press);
  ASSERT_EQ(c.tangent_from_test.size(), 8U);  // E and nu at four angles
  for (const Comparison& p : c.tangent_from_test) {
    const Comparison* small_strain = row_of(c.verification, p.target);
    ASSERT_NE(small_strain, nullptr);
    EXPECT_NEAR(p.mean / small_strain->mean, p.target.property == Property::E ? 0.8 : 1.0, 1e-9);
    EXPECT_EQ(p.n_packings, 1);
  }
  const Finding* change = first_of(c.notes, FindingKind::tests_change_modulus);
  ASSERT_NE(change, nullptr);
  EXPECT_NEAR(change->number("change"), -0.2, 1e-9);
  press.tangent = 0.97;
  EXPECT_THAT(calibrated(rock(), press).notes, Not(Contains(Is(FindingKind::tests_change_modulus))));
}

/// Keeps how far tests are approached, by packing and angle.
class Hurried : public PaperPress {
 public:
  std::map<std::pair<std::int64_t, double>, double> approach;
  std::vector<TestResult> run(const std::vector<Recipe>& recipes) override {
    for (const Recipe& r : recipes)
      approach[{r.packing.seed, r.bedding.front().theta}] = r.test.approach_strain;
    return PaperPress::run(recipes);
  }
};

// The first unseen packing, 6, shows E at half of the strength; the others peak where the model was found to.
TEST(Calibrate, VerifiesInAHurryBehindTheFirstPacking) {
  Rock strong = rock();
  strong.readings.pop_back(), strong.readings.push_back(reading(Property::ucs, 90.0, 600e6));  // no such rock
  Hurried press;
  const Calibration c = calibrated(strong, press);
  int n_weaker = 0;
  for (const Comparison& row : c.fitted) {
    if (row.target.property != Property::ucs) continue;
    const double found = std::min(1.0, row.mean / row.target.mean), theta = row.target.theta;
    EXPECT_NEAR(press.approach.at({7, theta}) / press.approach.at({6, theta}), found * 0.6 / 0.25, 1e-9);
    n_weaker += found < 0.9 ? 1 : 0;
  }
  EXPECT_GT(n_weaker, 0);
}

/// Keeps the recipes whose tests are to leave pictures.
class Photographed : public PaperPress {
 public:
  std::vector<Recipe> shown;
  std::vector<TestResult> run(const std::vector<Recipe>& recipes) override {
    std::copy_if(recipes.begin(), recipes.end(), std::back_inserter(shown), keeps_pictures);
    return PaperPress::run(recipes);
  }
};

TEST(Calibrate, ShowsItsTestsOfUcsOnTheFirstUnseenPacking) {
  Photographed press;
  Rock r = rock();
  for (const double theta : {0.0, 90.0}) r.readings.push_back(reading(Property::brazilian, theta, 8e6));
  calibrated(r, press);
  std::vector<double> angles;
  for (const Recipe& one : press.shown) {
    angles.push_back(one.bedding.front().theta);
    EXPECT_EQ(one.packing.seed, 6) << "seeds 1 to 5 are those of the fit";
    EXPECT_EQ(one.test.kind, TestKind());
  }
  EXPECT_THAT(angles, testing::ElementsAre(0.0, 30.0, 60.0, 90.0));
}

// A press whose tangent is a fifth below what the unbroken specimen has: moduli are sought a quarter higher.
TEST(Calibrate, ATangentIsMetByStifferContacts) {
  PaperPress press;
  press.tangent = 0.8;
  Rock tangents = rock();
  CalibrationOptions options;
  options.max_tests = 4 * (8 + 5 + 5);
  const Calibration small_strain = calibrate(Evidence(tangents), options, press);
  tangents.E_is = ModulusReading::tangent_50;
  const Calibration c = calibrate(Evidence(tangents), options, press);
  EXPECT_TRUE(c.tangent_from_test.empty());
  EXPECT_NEAR(c.recipe.matrix.E_c / small_strain.recipe.matrix.E_c, 1.25, 0.01);
  EXPECT_NEAR(c.recipe.bedding[0].k_n / small_strain.recipe.bedding[0].k_n, 1.25, 0.02);
  for (const Comparison& row : c.verification)
    if (row.target.property == Property::E) {
      EXPECT_NEAR(row.error(), row_of(small_strain.verification, row.target)->error(), 0.004)
          << row.target.theta;
    }
}

// Cracks take the same share of E on every packing, so that packings scatter by the same share of it.
TEST(Calibrate, PackingsScatterInATangentByTheShareAtSmallStrain) {
  PaperPress press;
  press.modulus_scatter = 0.05, press.tangent = 0.8;
  Rock tangents = rock();
  const Calibration small_strain = calibrated(tangents, press, true);
  tangents.E_is = ModulusReading::tangent_50;
  const Calibration c = calibrated(tangents, press);
  for (const Comparison& row : c.fitted) {
    if (row.target.property != Property::E) continue;
    const Comparison& before = *row_of(small_strain.fitted, row.target);
    EXPECT_NEAR((row.sd / row.mean) / (before.sd / before.mean), 1.0, 0.05) << row.target.theta;
  }
}

TEST(Calibrate, AnglesWithoutUcsAreSoftenedAsTheirNeighbours) {
  PaperPress press;
  press.tangent = 0.8;
  Rock tangents = rock();
  tangents.E_is = ModulusReading::tangent_50;
  const double theta = 30.0;
  std::erase_if(tangents.readings,
                [&](const RockReading& r) { return r.property == Property::ucs && r.theta == theta; });
  const Calibration c = calibrated(tangents, press);
  for (const std::vector<Comparison>* rows : {&c.fitted, &c.verification})
    for (const Comparison& row : *rows)
      if (row.target.property == Property::E) {
        EXPECT_NEAR(row.error(), 0.0, 0.03) << row.target.theta;
      }
  const Finding* without = first_of(c.notes, FindingKind::modulus_without_test);
  ASSERT_NE(without, nullptr);
  EXPECT_EQ(without->cells.front().theta, theta);
}

TEST(Calibrate, WithoutStrengthsTangentsAreComparedAtSmallStrainAndThatIsSaid) {
  PaperPress press;
  Rock tangents = rock();
  tangents.E_is = ModulusReading::tangent_50;
  EXPECT_THAT(calibrated(tangents, press, true).notes, Contains(Is(FindingKind::moduli_at_small_strain)));
  EXPECT_THAT(calibrated(rock(), press, true).notes, Not(Contains(Is(FindingKind::moduli_at_small_strain))));
}

TEST(Calibrate, AShortSearchIsAlwaysTold) {
  PaperPress press;
  const auto is_short = [](const Finding& f) { return f.kind == FindingKind::search_short; };
  const Calibration c = calibrated(rock(), press);
  // as a cause where a longer one can come nearer, else as a note
  EXPECT_NE(
      c.notes.end() != std::find_if(c.notes.begin(), c.notes.end(), is_short),
      c.verdict.causes.end() != std::find_if(c.verdict.causes.begin(), c.verdict.causes.end(), is_short));
}

TEST(Calibrate, ANuBeyondItsMarginIsNamed) {
  PaperPress press;
  const Calibration c = calibrated(rock(0.8), press, true);
  double worst = 0.0;
  for (const Comparison& f : c.fitted)
    if (f.target.property == Property::nu) worst = std::max(worst, std::fabs(f.mean - f.target.mean));
  ASSERT_GT(worst, 0.03);
  const Finding* missed = first_of(c.verdict.findings, FindingKind::value_missed);
  ASSERT_NE(missed, nullptr);
  EXPECT_EQ(missed->cells.front().property, Property::nu);
}

// Of one specimen each nothing can be told: its scatter is assumed, 8 and 10 %, of four degrees of freedom.
TEST(Calibrate, OneSpecimenAnAngleDecidesNothing) {
  Rock single = rock();
  for (RockReading& r : single.readings) r.sd = std::nan(""), r.n = 1;
  PaperPress press;
  const Calibration c = calibrated(single, press);
  EXPECT_EQ(c.verdict.status, VerdictStatus::not_decided);
  EXPECT_EQ(c.verdict.counts.number("met"), 4.0) << "nu alone: 0.03 of scatter, errors of 0.1 matter";
  const Finding* open = first_of(c.verdict.findings, FindingKind::value_open);
  ASSERT_NE(open, nullptr);
  EXPECT_GT(open->number("bound"), open->number("coarsest"));
  EXPECT_EQ(c.verdict.next.advice, Advice::state_scatter);
  EXPECT_EQ(c.verdict.next.names, (std::vector<std::string>{"E", "UCS"}));
  EXPECT_NE(c.recipe.name, calibrated(rock(), press).recipe.name) << "it goes into every file";
}

TEST(Calibrate, TheNameOfTheRecipeTellsWhatIsCalibrated) {
  PaperPress press;
  const Calibration part = calibrated(rock(), press, true);
  EXPECT_THAT(part.notes, Contains(Is(FindingKind::elastic_only)));
  Rock strengths = rock();
  std::erase_if(strengths.readings, [](const RockReading& r) { return r.property != Property::ucs; });
  // of moduli that are not the rock's, with as many tests as it takes: eight points are a matter of luck
  const std::set<std::string> names = {calibrated(rock(), press).recipe.name, part.recipe.name,
                                       calibrate(Evidence(strengths), {}, press).recipe.name};
  EXPECT_EQ(names.size(), 3U);
  for (const std::string& name : names) EXPECT_TRUE(name.starts_with(rock().name)) << name;
}

TEST(Calibrate, WhatComesOutIsRunInUniaxialCompressionWhateverTheRecipeWas) {
  PaperPress press;
  Rock confined = rock();
  confined.model.test.kind = TestKind("biaxial"), confined.model.test.confining_stress = 5e6;
  const TestRecipe out = calibrated(confined, press, true).recipe.test;
  EXPECT_EQ(out.kind, TestKind());
  EXPECT_EQ(out.confining_stress, 0.0) << "no stress that this test does not keep";
}

TEST(Calibrate, AnOpenStrengthIsPinnedByWhatPinsTheNearestOpenRatio) {
  PaperPress press;
  const Calibration c = calibrated(rock(), press);
  const auto of = [&](const char* symbol) {
    return *std::find_if(c.parameters.begin(), c.parameters.end(),
                         [&](const ParameterEstimate& e) { return e.symbol == symbol; });
  };
  for (const char* open : {"tau_c/sigma_c", "sigma_n,sj/C_sj", "sigma_n,sj"})
    ASSERT_FALSE(of(open).determined) << open;
  ASSERT_TRUE(of("tau_c").determined) << "by the prior of its ratio";
  const auto first = [&](const char* symbol) { return of(symbol).next.tests.at(0).any_of.at(0); };
  EXPECT_EQ(first("sigma_n,sj"), at_angle(Property::direct_tension, 0.0));
}

/// Scatter of log UCS(90) over draws, without that of packings. `shift`: sigma_c from that many draws further
/// on, so that it is no longer the one that belongs to the rest.
double spread_of_ucs(const std::vector<Recipe>& draws, std::size_t shift) {
  std::vector<double> logs;
  for (std::size_t k = 0; k < draws.size(); ++k) {
    Recipe r = draws[k];
    r.matrix.sigma_c = draws[(k + shift) % draws.size()].matrix.sigma_c;
    r.bedding[0].theta = 90.0;
    logs.push_back(std::log(PaperPress::ucs(r)));
  }
  return summarise(logs).sd;
}

TEST(Calibrate, TheEnsembleIsJointInTheBoxesAndOnPackingsOfItsOwn) {
  PaperPress press;
  const Evidence evidence(rock());
  const Calibration c = calibrate(evidence, {}, press), again = calibrate(evidence, {}, press);
  ASSERT_EQ(c.ensemble.size(), 20U);
  for (std::size_t k = 0; k < 20; ++k) {
    const Recipe& r = c.ensemble[k];
    EXPECT_EQ(r.packing.seed, 36 + static_cast<std::int64_t>(k));  // 1 ... 35: fit, verification, reserve
    EXPECT_EQ(r.test.angles, c.recipe.test.angles);
    EXPECT_EQ(r.matrix.E_b, r.matrix.E_c);
    EXPECT_DOUBLE_EQ(r.matrix.tau_c_sd / r.matrix.tau_c, 0.1);
    EXPECT_EQ(keys_not_by_default(r), keys_not_by_default(again.ensemble[k]));
    for (const ParameterEstimate& e : c.parameters) {
      if (e.number == nullptr) continue;
      EXPECT_GE(e.number(r), e.box_low * (1.0 - 1e-12)) << e.key;
      EXPECT_LE(e.number(r), e.box_high * (1.0 + 1e-12)) << e.key;
    }
  }
  // Numbers drawn apart from each other would spread like those that are put together anew.
  double apart = 0.0;
  for (std::size_t shift = 1; shift < 20; ++shift) apart += spread_of_ucs(c.ensemble, shift) / 19.0;
  EXPECT_LT(spread_of_ucs(c.ensemble, 0), 0.75 * apart);
}

TEST(Calibrate, WithoutStrengthsTheEnsembleHasThoseOfTheRecipe) {
  PaperPress press;
  const Calibration c = calibrated(rock(), press, true);
  ASSERT_EQ(c.ensemble.size(), 20U);
  EXPECT_NE(c.ensemble[0].matrix.E_c, c.ensemble[1].matrix.E_c);
  for (const Recipe& r : c.ensemble) EXPECT_EQ(r.matrix.sigma_c, c.recipe.matrix.sigma_c);
  Rock strengths = rock();
  std::erase_if(strengths.readings, [](const RockReading& r) { return r.property != Property::ucs; });
  strengths.model.matrix.E_b = 0.5 * strengths.model.matrix.E_c;
  for (const Recipe& r : calibrated(strengths, press).ensemble) {
    EXPECT_EQ(r.matrix.E_c, strengths.model.matrix.E_c);
    EXPECT_EQ(r.matrix.E_b, strengths.model.matrix.E_b);
  }
}

TEST(Calibrate, StopsInTheMiddleOfTheDirectSolutions) {
  PaperPress press;
  press.stops_statics = true;
  EXPECT_EQ(calibrated(rock(), press).verdict.status, VerdictStatus::interrupted);
}

// What a table of a twin holds is what a laboratory would have read, in the order of the readings.
TEST(Twin, ModuliAreThoseOfTheTestsUnlessSmallStrainIsMeant) {
  Recipe truth;
  truth.bedding.resize(1);
  PaperPress press;
  press.tangent = 0.8;
  const auto rows = [&](ModulusReading E_is) {
    return twin_response(truth, {0.0, 90.0}, {1, 2}, press, E_is);
  };
  const std::vector<Comparison> waves = rows(ModulusReading::small_strain),
                                read = rows(ModulusReading::tangent_50);
  ASSERT_EQ(waves.size(), 6U);
  ASSERT_EQ(read.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(read[i].target.property, waves[i].target.property);
    EXPECT_EQ(read[i].target.theta, waves[i].target.theta);
    EXPECT_NEAR(read[i].mean / waves[i].mean, i < 2 ? 0.8 : 1.0, 1e-9) << i;
  }
}

/// A table that directions are expected to meet nearly as well as planes.
class ARival : public testing::Test {
 protected:
  ARival() {
    rock.bedded = true, rock.model.bedding.resize(1);
    rock.layers = LayerModel::choose, rock.matrix = MatrixModel::parallel_bond;
    for (const auto& [theta, ucs] :
         {std::pair{0.0, 110e6}, {30.0, 80e6}, {45.0, 63e6}, {60.0, 66e6}, {90.0, 120e6}})
      rock.readings.push_back(reading(Property::ucs, theta, ucs));
  }
  /// No more models begin than were stated before anything ran, each behind one that is named.
  Calibration found() {
    int stated = 0, begun = 1;
    options.listener.outlook = [&](const Outlook& o) { stated = stated > 0 ? stated : o.models; };
    options.listener.begins = [&](const Finding& f) {
      if (f.kind != FindingKind::course_model) return;
      EXPECT_EQ(f.names.size(), 2U) << "which model, and which one ended out of reach";
      ++begun;
    };
    Calibration c = calibrate(Evidence(rock), options, press);
    EXPECT_LE(begun, stated);
    return c;
  }
  Rock rock;
  Photographed press;
  CalibrationOptions options;

  static bool has_planes(const Recipe& r) { return !r.bedding.empty(); }
  static bool nothing(const Recipe&) { return false; }
  /// What became of each model, in the order in which they were tried.
  static std::vector<Finding> story(const Calibration& c) {
    std::vector<Finding> all = c.notes;
    std::erase_if(all, [](const Finding& f) { return f.kind != FindingKind::model_tried; });
    return all;
  }
  static std::string kept(const Calibration& c) {
    const Finding* f = first_of(c.notes, FindingKind::model_kept);
    return f == nullptr ? "" : f->names.front();
  }
};

TEST_F(ARival, OfAModelOutOfReachIsCalibratedToo) {
  press.peaks = [](const Recipe& r) { return !has_planes(r); };
  const Calibration c = found();
  EXPECT_EQ(c.layers, LayerModel::directions);
  EXPECT_TRUE(c.recipe.bedding.empty());
  EXPECT_FALSE(c.rival) << "no advice to try it";
  EXPECT_THAT(c.discarded, testing::ElementsAre(name_of(LayerModel::planes)));
  ASSERT_EQ(story(c).size(), 2U);
  EXPECT_EQ(story(c)[0].names.front(), name_of(LayerModel::planes));
  EXPECT_EQ(story(c)[0].number("unanswered"), 5.0);
  EXPECT_EQ(story(c)[0].number("reached"), 0.0);
  EXPECT_EQ(story(c)[1].number("unanswered"), 0.0);
  EXPECT_EQ(kept(c), name_of(LayerModel::directions));
  EXPECT_GT(c.counts.tests, 12 * 5 + 28 * 5) << "the first batch of planes, and a whole search";
  EXPECT_LE(c.counts.tests, options.max_tests);
  EXPECT_FALSE(press.shown.empty());
  for (const Recipe& r : press.shown) EXPECT_EQ(r.matrix.sigma_c, c.recipe.matrix.sigma_c);
}

TEST_F(ARival, ThatIsNoBetterIsLeft) {
  press.peaks = nothing;
  const Calibration c = found();
  EXPECT_EQ(c.layers, LayerModel::planes);
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_THAT(c.discarded, testing::ElementsAre(name_of(LayerModel::directions)));
  EXPECT_EQ(kept(c), name_of(LayerModel::planes));
  EXPECT_EQ(c.counts.tests, 2 * 12 * 5);
}

// UCS/BTS = 20 to 40, which no mapped specimen has.
TEST_F(ARival, TheNearerOfTwoThatAreOutOfReachStays) {
  for (const double theta : {0.0, 30.0, 60.0, 90.0})
    rock.readings.push_back(reading(Property::brazilian, theta, 3e6));
  const Calibration c = found();
  ASSERT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  ASSERT_EQ(story(c).size(), 2U);
  const double first = story(c)[0].number("tolerances"), second = story(c)[1].number("tolerances");
  EXPECT_EQ(c.layers, second < first ? LayerModel::directions : LayerModel::planes);
  EXPECT_THAT(c.discarded, testing::ElementsAre(second < first ? name_of(LayerModel::planes)
                                                               : name_of(LayerModel::directions)));
  EXPECT_GT(c.counts.tension, 2 * 2 * 36) << "of both";
  ASSERT_FALSE(press.shown.empty());
  for (const Recipe& r : press.shown) {
    EXPECT_EQ(r.matrix.sigma_c, c.recipe.matrix.sigma_c);
    EXPECT_EQ(has_planes(r), has_planes(c.recipe));
  }
  options.max_tests = (c.counts.compression()) / 2 + 65;  // the least, but not as many again
  const Calibration once = found();
  EXPECT_TRUE(story(once).empty());
  ASSERT_TRUE(once.rival) << "it stays an advice";
  EXPECT_EQ(once.rival->names[2], "directions");
}

// Directions, bridges and whole planes are expected to meet this table alike, in this order; only whole
// planes peak.
TEST_F(ARival, IsFollowedByTheNextWhereItIsOutOfReachToo) {
  BeddingRecipe& planes = rock.model.bedding[0];
  planes.rule = BeddingRule::crossing, planes.k_n *= 3.0, planes.k_s *= 3.0;
  rock.readings.clear();
  for (const auto& [theta, ucs, tension] : {std::tuple{0.0, 57e6, 10.5e6},
                                            {15.0, 51e6, 10e6},
                                            {30.0, 42e6, 9.8e6},
                                            {45.0, 49e6, 9.1e6},
                                            {60.0, 49e6, 7.9e6},
                                            {75.0, 61e6, 7.6e6},
                                            {90.0, 67e6, 8e6}})
    rock.readings.push_back(reading(Property::ucs, theta, ucs)),
        rock.readings.push_back(reading(Property::brazilian, theta, tension));
  press.peaks = [](const Recipe& r) { return has_planes(r) && jointed_share(r) == 1.0; };
  options.max_tests = 400;  // less than a whole search by the third would take
  const Calibration c = found();
  EXPECT_EQ(c.layers, LayerModel::planes);
  ASSERT_EQ(c.discarded.size(), 2U);
  EXPECT_EQ(c.discarded[0], name_of(LayerModel::directions));
  const RockModel& bridged = *find_model(true, LayerModel::planes_with_bridges, MatrixModel::parallel_bond);
  std::vector<std::string> by_share;
  for (const double share : {0.8, 0.65, 0.5, 0.35, 0.2}) by_share.push_back(text_of(bridged, share));
  EXPECT_THAT(by_share, testing::Contains(c.discarded[1]));
  EXPECT_EQ(story(c).size(), 3U) << "all are reported";
  EXPECT_LE(c.counts.compression(), options.max_tests);
  press.peaks = nothing;
  options.max_tests = 150;
  const Calibration cut = found();
  EXPECT_EQ(cut.discarded.size(), 1U) << "no tests are left for the third";
  ASSERT_TRUE(cut.rival) << "it stays an advice";
  EXPECT_EQ(cut.rival->names[2], "planes");
  options.max_tests = 2000, press.stop_after = press.n_tests + (15 + 12) * 14 + 1;
  const Calibration stopped = found();
  EXPECT_EQ(stopped.verdict.status, VerdictStatus::interrupted);
  const Finding* at = first_of(stopped.notes, FindingKind::model_interrupted);
  ASSERT_NE(at, nullptr);
  EXPECT_EQ(at->names.front(), name_of(LayerModel::planes));
}

TEST_F(ARival, ThatMissesETooIsNotTested) {
  for (const auto& [theta, E] : {std::pair{0.0, 20e9}, {30.0, 30e9}, {60.0, 20e9}, {90.0, 30e9}})
    rock.readings.push_back(reading(Property::E, theta, E));
  rock.E_is = ModulusReading::small_strain;
  const Calibration c = found();
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_GT(c.counts.tests, 0);
  EXPECT_TRUE(story(c).empty());
  EXPECT_TRUE(c.discarded.empty());
}

// Scatter of the laboratory passes in the verdict, and so in what is expected of one.
TEST_F(ARival, LacksAnEThatScatterDoesNotExplain) {
  const auto lacks = [&](double off, double scatter) {
    Rock one = rock;
    one.E_is = ModulusReading::small_strain;
    for (const double theta : {0.0, 30.0, 60.0, 90.0}) {
      const double E = 25e9 * (theta == 0.0 || theta == 60.0 ? 1.0 - off : 1.0 + off);
      for (const double part : {-1.0, 0.0, 1.0})
        one.readings.push_back(reading(Property::E, theta, E * (1.0 + scatter * part)));
    }
    Rock planes = one, directions = one;
    planes.layers = LayerModel::planes, directions.layers = LayerModel::directions;
    const maps::ModelChoice choice =
        choose_model(Evidence(one), {planes, directions}, 1, press, [](const Finding&) {});
    EXPECT_FALSE(choice.rivals.front().has_modulus());
    return choice.rivals.front().misses_modulus;
  };
  EXPECT_FALSE(lacks(0.08, 0.2));
  EXPECT_TRUE(lacks(0.20, 0.02));
}

TEST_F(ARival, IsExpectedTheSameBySeveralThreads) {
  Rock planes = rock, directions = rock;
  planes.layers = LayerModel::planes, directions.layers = LayerModel::directions;
  const auto text = [&](int threads) {
    press.n_threads = threads;
    const maps::ModelChoice choice =
        choose_model(Evidence(rock), {planes, directions}, 1, press, [](const Finding&) {});
    return fmt::format("{} {}", choice.rivals[0].strength_error, choice.rivals[1].strength_error);
  };
  EXPECT_EQ(text(1), text(3));
}

TEST_F(ARival, OfModuliCostsNoTests) {
  for (const auto& [theta, E] : {std::pair{0.0, 20e9}, {30.0, 30e9}, {60.0, 20e9}, {90.0, 30e9}})
    rock.readings.push_back(reading(Property::E, theta, E));
  options.elastic_only = true, options.max_tests = 1;
  const Calibration c = found();
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_EQ(story(c).size(), 2U);
  EXPECT_EQ(c.counts.tests, 0);
}

TEST_F(ARival, IsNotTriedWithoutNeed) {
  press.peaks = has_planes;
  const Calibration met = found();
  EXPECT_NE(met.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_TRUE(story(met).empty());
  EXPECT_TRUE(met.discarded.empty());
}

TEST_F(ARival, IsGoneOnWithWhereTheUserStopsIt) {
  press.peaks = nothing, press.stop_after = 12 * 5 + 1;
  const Calibration c = found();
  EXPECT_EQ(c.verdict.status, VerdictStatus::interrupted);
  const Finding* at = first_of(c.notes, FindingKind::model_interrupted);
  ASSERT_NE(at, nullptr);
  EXPECT_EQ(at->names.front(), name_of(LayerModel::directions));
}

}  // namespace
}  // namespace phy::calibrate
