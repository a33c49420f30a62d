// The tables of what models reach: that they are whole, that a table of the laboratory finds its place in
// them, and that the regression knows a quadratic when it sees one.
#include "calibrate/reach.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calibrate/reach_check.hpp"
#include "calibrate/reading_fixture.hpp"

namespace phy::calibrate {
namespace {

TEST(Reach, EveryFamilyHasItsPointsWithinItsRanges) {
  for (const ModelFamily& family : model_families()) {
    const ReachTable& table = reach_of(family);
    const int per_point = family.layered ? 1 : 10;
    EXPECT_EQ(table.n_rows(), static_cast<std::size_t>(per_point * (family.n_points + family.n_at_base)))
        << family.name;
    int sensible = 0;
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
      for (std::size_t i = 0; i < family.levers.size(); ++i)
        EXPECT_LE(std::fabs(table.places(row)[i]), 1.001) << family.name << ' ' << family.levers[i].name;
      sensible += table.is_sensible(row) ? 1 : 0;
    }
    EXPECT_GT(sensible, 20) << family.name;
  }
}

// Whoever changes a lever has to run the maps again.
/// A recipe with all levers off their base.
Recipe of_family(const ModelFamily& family) {
  Recipe r = family.base;
  double place = -0.9;
  for (const Lever& l : family.levers) l.set(r, l.at_place(place += 0.1));
  return r;
}

TEST(Reach, ARecipeReadsTheLeversThatItWasGiven) {
  for (const ModelFamily& family : model_families()) {
    const Recipe r = of_family(family);
    double place = -0.9;
    for (const Lever& l : family.levers) EXPECT_NEAR(l.place_of(l.get(r)), place += 0.1, 1e-12) << l.name;
    EXPECT_EQ(family_of(r), &family) << family.name;
  }
}

/// What a laboratory would have of the rock of one row, in other units of stress.
Rock rock_of(const ReachTable& table, std::size_t row) {
  Rock rock;
  rock.E_is = ModulusReading::tangent_50;
  rock.model.bedding.resize(1), rock.model.bedding[0].rule = BeddingRule::crossing;
  for (const double theta : mapped_angles) {
    rock.readings.push_back(
        reading(Property::E, theta, 31e9 * table.at(row, fmt::format("E50/E_c({:g})", theta))));
    rock.readings.push_back(
        reading(Property::ucs, theta, 23e6 * table.at(row, fmt::format("UCS/sigma_c({:g})", theta))));
  }
  for (const double theta : mapped_disc_angles)
    rock.readings.push_back(
        reading(Property::brazilian, theta, 23e6 * table.at(row, fmt::format("BTS/sigma_c({:g})", theta))));
  return rock;
}

/// The first sensible row with all answers.
std::size_t whole_row(const ReachTable& table) {
  std::size_t row = 0;
  const auto has_discs = [&] {
    for (const double theta : mapped_disc_angles)
      if (std::isnan(table.at(row, fmt::format("BTS/sigma_c({:g})", theta)))) return false;
    return true;
  };
  while (!table.is_sensible(row) || !has_discs()) ++row;
  return row;
}

TEST(Reach, ARockOfTheMapIsFoundThereAndNowhereElse) {
  for (const ModelFamily& family : model_families()) {
    if (!family.layered) continue;
    const ReachTable& table = reach_of(family);
    const Evidence evidence(rock_of(table, whole_row(table)));
    for (const NearestPoint& p : nearest_points(evidence)) {
      if (p.family == &family)
        EXPECT_LT(p.error, 1e-6) << family.name;
      else
        EXPECT_GT(p.error, 0.01) << family.name << " in " << p.family->name;
    }
    EXPECT_THAT(place_in_maps(evidence), testing::Contains(testing::HasSubstr("UCS/BTS(45) = ")));
  }
}

/// What a model answers to a table: its values times exp(+-off), in turn.
std::vector<Comparison> answers(const Evidence& evidence, double off) {
  std::vector<Comparison> rows;
  for (const Target& t : evidence.targets) {
    rows.emplace_back();
    rows.back().target = t, rows.back().mean = t.mean * std::exp(off), rows.back().n_packings = 5;
    off = -off;
  }
  return rows;
}

// A rock of a map, and a model that misses it by a tenth: the search has not found what there is.
TEST(Reach, AModelIsHeldAgainstTheMaps) {
  int n_held = 0;
  for (const ModelFamily& family : model_families()) {
    if (!family.layered) continue;
    const ReachTable& table = reach_of(family);
    const Evidence evidence(rock_of(table, whole_row(table)));
    const std::vector<NearestPoint> points = nearest_points(evidence);
    if (std::find_if(points.begin(), points.end(), [&](const NearestPoint& p) {
          return p.family == &family && p.n_points >= 64;  // fewer say nothing
        }) == points.end())
      continue;
    ++n_held;
    const auto said = [&](const Recipe& model) {
      return against_maps(evidence, {model}, answers(evidence, 0.1));
    };
    EXPECT_EQ(said(of_family(family))->advice, Advice::search_again);
    EXPECT_EQ(said(Recipe())->advice, Advice::try_model);
    EXPECT_EQ(said(Recipe())->names.front(), family.label);
    const auto tried = against_maps(evidence, {Recipe(), of_family(family)}, answers(evidence, 0.1));
    EXPECT_EQ(tried->advice, Advice::search_again_by);
    EXPECT_EQ(tried->names.front(), family.label);
  }
  EXPECT_GE(n_held, 4);
}

// A rock that none of them is like, and models as near as the nearest, and farther.
TEST(Reach, WhereNoMappedSpecimenIsNearerNothingIsAdvised) {
  const ReachTable& table = reach_of(model_families().front());
  Rock rock = rock_of(table, whole_row(table));
  for (RockReading& r : rock.readings)
    if (r.property == Property::ucs) r.value *= r.theta == 15.0 ? 0.2 : 1.0;
  const Evidence evidence(rock);
  EXPECT_EQ(against_maps(evidence, {Recipe()}, answers(evidence, 0.05))->advice, Advice::none);
  EXPECT_EQ(against_maps(evidence, {Recipe()}, answers(evidence, 0.8))->advice, Advice::try_model);
  std::vector<Comparison> silent = answers(evidence, 0.05);
  silent.back().mean = std::nan("");
  EXPECT_FALSE(against_maps(evidence, {Recipe()}, silent));
}

// A specimen that meets E and strengths and is far off nu is no nearer than a model that misses all by a
// tenth. The one that the table is of has a negative nu at some angles.
TEST(Reach, NuCountsWhereATestReadsIt) {
  const ModelFamily& family = model_families().front();
  const ReachTable& table = reach_of(family);
  const std::size_t row = whole_row(table);
  ASSERT_LT(table.at(row, "nu50(45)"), 0.0);
  const auto said = [&](double shift, ModulusReading E_is) {
    Rock rock = rock_of(table, row);
    rock.E_is = E_is;
    for (const double theta : mapped_angles)
      rock.readings.push_back(
          reading(Property::nu, theta, table.at(row, fmt::format("nu50({:g})", theta)) + shift));
    const Evidence evidence(rock);
    return against_maps(evidence, {of_family(family)}, answers(evidence, 0.1));
  };
  const auto met = said(0.0, ModulusReading::tangent_50);
  ASSERT_TRUE(met);
  EXPECT_EQ(met->number("with_nu"), 1.0);
  EXPECT_NEAR(met->number("nearest"), 0.0, 0.005);
  EXPECT_EQ(met->advice, Advice::search_again);
  EXPECT_EQ(said(0.6, ModulusReading::tangent_50)->advice, Advice::none);
  const auto small = said(0.6, ModulusReading::small_strain);  // whose nu no map holds
  ASSERT_TRUE(small);
  EXPECT_EQ(small->number("with_nu"), 0.0);
  EXPECT_EQ(small->advice, Advice::search_again);
}

TEST(Reach, APointThatLacksAnAnswerIsNotCompared) {
  const ModelFamily& family = model_families().front();
  const ReachTable& table = reach_of(family);
  int whole = 0;
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    bool answers = table.is_sensible(row);
    for (const double theta : mapped_disc_angles)
      answers = answers && std::isfinite(table.at(row, fmt::format("BTS/sigma_c({:g})", theta)));
    whole += answers ? 1 : 0;
  }
  const NearestPoint found = nearest_points(Evidence(rock_of(table, whole_row(table)))).front();
  EXPECT_EQ(found.n_points, whole);
}

TEST(Reach, WithoutStrengthsATableHasNoPlace) {
  Rock rock;
  rock.readings = {reading(Property::E, 0.0, 20e9), reading(Property::E, 90.0, 40e9)};
  EXPECT_TRUE(place_in_maps(Evidence(rock)).empty());
}

TEST(Reach, TheRegressionMeetsAQuadraticAndHoldsItsEdges) {
  const ModelFamily& family = model_families().front();
  std::string csv = "point,n_grains";
  for (const Lever& l : family.levers) csv += fmt::format(",{}", l.name);
  csv += ",answer\n";
  const auto truth = [](const std::vector<double>& z) {
    return 0.4 + 0.5 * z[0] - 0.2 * z[1] + 0.1 * z[0] * z[3];
  };
  std::vector<double> z(family.levers.size());
  for (int point = 1; point <= 600; ++point) {
    csv += fmt::format("{},{}", point, family.base.packing.n_grains);
    for (std::size_t i = 0; i < z.size(); ++i) {
      z[i] = std::sin(1.0 + point * (1.7 + 0.61 * static_cast<double>(i)));
      csv += fmt::format(",{:.9g}", family.levers[i].at_place(z[i]));
    }
    csv += fmt::format(",{:.9g}\n", std::exp(truth(z)));
  }
  const ReachTable table(family, csv);
  const ReachRegression fitted(table, "answer");
  for (double& v : z) v = 0.3;
  EXPECT_NEAR(fitted.at(z), truth(z), 5e-3);
  EXPECT_LT(ReachRegression::left_out_error(table, "answer"), 0.01);
  z[0] = 5.0;
  const double beyond = fitted.at(z);
  z[0] = 50.0;
  EXPECT_EQ(fitted.at(z), beyond);
}

TEST(Reach, ARegressionOverSomeLeversIsTheWholeOneWithTheOthersHeld) {
  const ModelFamily& family = model_families().front();
  const ReachRegression whole(reach_of(family), column_at(family, "UCS/sigma_c", 30.0));
  std::vector<double> places(family.levers.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = 1.5 * std::sin(1.0 + 2.3 * static_cast<double>(i));  // some beyond where they are held
  const std::vector<std::size_t> open = {1, 2, 5};
  const ReachRegression some = whole.over(open, places);
  for (const std::vector<double>& at :
       {std::vector{0.0, 0.0, 0.0}, std::vector{0.3, -0.7, 0.9}, std::vector{-2.0, 0.1, 2.0}}) {
    for (std::size_t k = 0; k < open.size(); ++k) places[open[k]] = at[k];
    EXPECT_NEAR(some.at(at), whole.at(places), 1e-12);
  }
}

}  // namespace
}  // namespace phy::calibrate
