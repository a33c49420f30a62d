// The tables of what models reach: that they are whole, that a table of the laboratory finds its place in
// them, and that the regression knows a quadratic when it sees one.
#include "maps/response_map.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maps/placing.hpp"
#include "records/reading_fixture.hpp"

namespace phy::maps {
namespace {

TEST(ResponseMap, EveryFamilyHasItsPointsWithinItsRanges) {
  for (const MappedModel& family : mapped_models()) {
    const ResponseMap& table = map_of(family);
    const int per_point = family.layered() ? 1 : 10;
    EXPECT_EQ(table.n_rows(), static_cast<std::size_t>(per_point * (family.n_points + family.n_at_base)))
        << family.name;
    int sensible = 0;
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
      for (std::size_t i = 0; i < family.variables.size(); ++i)
        EXPECT_LE(std::fabs(table.places(row)[i]), 1.001) << family.name << ' ' << family.variables[i].name;
      sensible += table.is_plausible(row) ? 1 : 0;
    }
    EXPECT_GT(sensible, 20) << family.name;
  }
}

// Whoever changes a lever has to run the maps again.
/// A recipe with all variables off their base.
Recipe of_family(const MappedModel& family) {
  Recipe r = family.base;
  double place = -0.9;
  for (const MapVariable& l : family.variables) l.set(r, l.from_normalised(place += 0.1));
  return r;
}

TEST(ResponseMap, ARecipeReadsTheLeversThatItWasGiven) {
  for (const MappedModel& family : mapped_models()) {
    const Recipe r = of_family(family);
    double place = -0.9;
    for (const MapVariable& l : family.variables)
      EXPECT_NEAR(l.normalised(l.get(r)), place += 0.1, 1e-12) << l.name;
    EXPECT_EQ(mapped_model_of(r), &family) << family.name;
  }
}

/// What a laboratory would have of the rock of one row, in other units of stress.
Rock rock_of(const ResponseMap& table, std::size_t row) {
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
std::size_t whole_row(const ResponseMap& table) {
  std::size_t row = 0;
  const auto has_discs = [&] {
    for (const double theta : mapped_disc_angles)
      if (std::isnan(table.at(row, fmt::format("BTS/sigma_c({:g})", theta)))) return false;
    return true;
  };
  while (!table.is_plausible(row) || !has_discs()) ++row;
  return row;
}

TEST(ResponseMap, ARockOfTheMapIsFoundThereAndNowhereElse) {
  for (const MappedModel& family : mapped_models()) {
    if (!family.layered()) continue;
    const ResponseMap& table = map_of(family);
    const Evidence evidence(rock_of(table, whole_row(table)));
    for (const ClosestMapped& p : closest_mapped(evidence)) {
      if (p.model == &family)
        EXPECT_LT(p.error, 1e-6) << family.name;
      else
        EXPECT_GT(p.error, 0.01) << family.name << " in " << p.model->name;
    }
    const std::vector<Finding> placed = place_in_maps(evidence);
    EXPECT_TRUE(std::any_of(placed.begin(), placed.end(),
                            [&](const Finding& f) {
                              return f.kind == FindingKind::map_ratio && f.cells.front().theta == 45.0 &&
                                     std::find(f.names.begin(), f.names.end(), family.label) != f.names.end();
                            }))
        << family.name << " reaches its own ratio";
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
TEST(ResponseMap, AModelIsHeldAgainstTheMaps) {
  int n_held = 0;
  for (const MappedModel& family : mapped_models()) {
    if (!family.layered()) continue;
    const ResponseMap& table = map_of(family);
    const Evidence evidence(rock_of(table, whole_row(table)));
    const std::vector<ClosestMapped> points = closest_mapped(evidence);
    if (std::find_if(points.begin(), points.end(), [&](const ClosestMapped& p) {
          return p.model == &family && p.n_points >= 64;  // fewer say nothing
        }) == points.end())
      continue;
    ++n_held;
    const auto advice = [&](const std::vector<Recipe>& tried) {
      return against_maps(evidence, tried, answers(evidence, 0.1)).value().advice;
    };
    EXPECT_EQ(advice({of_family(family)}), Advice::search_again);
    EXPECT_EQ(advice({Recipe()}), Advice::try_model);
    EXPECT_EQ(advice({Recipe(), of_family(family)}), Advice::search_again_by);
    EXPECT_EQ(against_maps(evidence, {Recipe()}, answers(evidence, 0.1)).value().names.front(), family.label);
  }
  EXPECT_GE(n_held, 4);
}

// A rock that none of them is like, and models as near as the nearest, and farther.
TEST(ResponseMap, WhereNoMappedSpecimenIsNearerNothingIsAdvised) {
  const ResponseMap& table = map_of(mapped_models().front());
  Rock rock = rock_of(table, whole_row(table));
  for (RockReading& r : rock.readings)
    if (r.property == Property::ucs) r.value *= r.theta == 15.0 ? 0.2 : 1.0;
  const Evidence evidence(rock);
  EXPECT_EQ(against_maps(evidence, {Recipe()}, answers(evidence, 0.05)).value().advice, Advice::none);
  EXPECT_EQ(against_maps(evidence, {Recipe()}, answers(evidence, 0.8)).value().advice, Advice::try_model);
  std::vector<Comparison> silent = answers(evidence, 0.05);
  silent.back().mean = std::nan("");
  EXPECT_FALSE(against_maps(evidence, {Recipe()}, silent));
}

// A specimen that meets E and strengths and is far off nu is no nearer than a model that misses all by a
// tenth. The one that the table is of has a negative nu at some angles.
TEST(ResponseMap, NuCountsWhereATestReadsIt) {
  const MappedModel& family = mapped_models().front();
  const ResponseMap& table = map_of(family);
  const std::size_t row = whole_row(table);
  ASSERT_LT(table.at(row, "nu50(45)"), 0.0);
  const auto said = [&](double shift, ModulusReading E_is) {
    Rock rock = rock_of(table, row);
    rock.E_is = E_is;
    for (const double theta : mapped_angles)
      rock.readings.push_back(
          reading(Property::nu, theta, table.at(row, fmt::format("nu50({:g})", theta)) + shift));
    const Evidence evidence(rock);
    return against_maps(evidence, {of_family(family)}, answers(evidence, 0.1)).value();
  };
  const Finding met = said(0.0, ModulusReading::tangent_50);
  EXPECT_EQ(met.number("with_nu"), 1.0);
  EXPECT_NEAR(met.number("nearest"), 0.0, 0.005);
  EXPECT_EQ(met.advice, Advice::search_again);
  EXPECT_EQ(said(0.6, ModulusReading::tangent_50).advice, Advice::none);
  const Finding small = said(0.6, ModulusReading::small_strain);  // whose nu no map holds
  EXPECT_EQ(small.number("with_nu"), 0.0);
  EXPECT_EQ(small.advice, Advice::search_again);
}

TEST(ResponseMap, APointThatLacksAnAnswerIsNotCompared) {
  const MappedModel& family = mapped_models().front();
  const ResponseMap& table = map_of(family);
  int whole = 0;
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    bool answers = table.is_plausible(row);
    for (const double theta : mapped_disc_angles)
      answers = answers && std::isfinite(table.at(row, fmt::format("BTS/sigma_c({:g})", theta)));
    whole += answers ? 1 : 0;
  }
  const ClosestMapped found = closest_mapped(Evidence(rock_of(table, whole_row(table)))).front();
  EXPECT_EQ(found.n_points, whole);
}

TEST(ResponseMap, WithoutStrengthsATableHasNoPlace) {
  Rock rock;
  rock.readings = {reading(Property::E, 0.0, 20e9), reading(Property::E, 90.0, 40e9)};
  EXPECT_TRUE(place_in_maps(Evidence(rock)).empty());
}

TEST(ResponseMap, TheRegressionMeetsAQuadraticAndHoldsItsEdges) {
  const MappedModel& family = mapped_models().front();
  std::string csv = "point,n_grains";
  for (const MapVariable& l : family.variables) csv += fmt::format(",{}", l.name);
  csv += ",answer\n";
  const auto truth = [](const std::vector<double>& z) {
    return 0.4 + 0.5 * z[0] - 0.2 * z[1] + 0.1 * z[0] * z[3];
  };
  std::vector<double> z(family.variables.size());
  for (int point = 1; point <= 600; ++point) {
    csv += fmt::format("{},{}", point, family.base.packing.n_grains);
    for (std::size_t i = 0; i < z.size(); ++i) {
      z[i] = std::sin(1.0 + point * (1.7 + 0.61 * static_cast<double>(i)));
      csv += fmt::format(",{:.9g}", family.variables[i].from_normalised(z[i]));
    }
    csv += fmt::format(",{:.9g}\n", std::exp(truth(z)));
  }
  const ResponseMap table(family, csv);
  const MapRegression fitted(table, "answer");
  for (double& v : z) v = 0.3;
  EXPECT_NEAR(fitted.at(z), truth(z), 5e-3);
  EXPECT_LT(MapRegression::left_out_error(table, "answer"), 0.01);
  z[0] = 5.0;
  const double beyond = fitted.at(z);
  z[0] = 50.0;
  EXPECT_EQ(fitted.at(z), beyond);
}

TEST(ResponseMap, ARegressionOverSomeLeversIsTheWholeOneWithTheOthersHeld) {
  const MappedModel& family = mapped_models().front();
  const MapRegression whole(map_of(family), column_at(family, "UCS/sigma_c", 30.0));
  std::vector<double> places(family.variables.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = 1.5 * std::sin(1.0 + 2.3 * static_cast<double>(i));  // some beyond where they are held
  const std::vector<std::size_t> open = {1, 2, 5};
  const MapRegression some = whole.over(open, places);
  for (const std::vector<double>& at :
       {std::vector{0.0, 0.0, 0.0}, std::vector{0.3, -0.7, 0.9}, std::vector{-2.0, 0.1, 2.0}}) {
    for (std::size_t k = 0; k < open.size(); ++k) places[open[k]] = at[k];
    EXPECT_NEAR(some.at(at), whole.at(places), 1e-12);
  }
}

}  // namespace
}  // namespace phy::maps
