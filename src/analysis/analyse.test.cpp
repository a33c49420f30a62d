// The whole list of numbers; each reading is tested in its own file.
#include "analysis/analyse.hpp"
#include "base/nan.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "analysis/histories_fixture.hpp"
#include "records/test_description.hpp"

namespace phy::analysis {
namespace {

std::vector<Number> numbers_of(const History& h, const std::vector<CrackEvent>& cracks,
                               const AxialOptions& options = {}) {
  return with_reasons(axial_numbers(h, loading_branch(h), cracks, options));
}

TEST(Analyse, HeadlineNumbersAreByGauge) {
  const auto numbers = numbers_of(marble(), {});
  EXPECT_DOUBLE_EQ(value(numbers, "ucs"), 100e6);
  for (const char* name : {"E_tangent", "E_secant", "E_small"}) {
    EXPECT_NEAR(value(numbers, name) / (50e9 / 0.9), 1.0, 1e-12) << name;
    EXPECT_NEAR(value(numbers, std::string(name) + "_platen") / 50e9, 1.0, 1e-12) << name;
  }
  EXPECT_NEAR(value(numbers, "nu"), 0.25, 1e-12);
  EXPECT_NEAR(value(numbers, "nu_platen"), 0.225, 1e-12);
}

TEST(Analyse, SecantAndTangentOfASmoothCurve) {
  History h;
  for (int i = 1; i <= 1100; ++i) {  // s = e - e^2/2: peak 1/2 at e = 1, slope 1 - e
    HistoryRow r;
    r.axial_strain = r.axial_strain_gauge = i / 1000.0;
    r.axial_stress = r.axial_strain - 0.5 * r.axial_strain * r.axial_strain;
    h.rows.push_back(r);
  }
  const auto numbers = numbers_of(h, {});
  const double e50 = 1.0 - std::sqrt(0.5);
  EXPECT_NEAR(value(numbers, "E_secant"), 0.25 / e50, 1e-5);
  EXPECT_NEAR(value(numbers, "E_tangent"), 1.0 - e50, 5e-3);
}

TEST(Analyse, OptionsSetTheRangesAndTheDefinitionsSayThem) {
  AxialOptions options;
  options.tangent = {0.2, 0.5};
  options.secant = 0.3;
  const auto numbers = numbers_of(marble(), {}, options);
  EXPECT_NE(find(numbers, "E_tangent")->definition.find("between 20 and 50 % of ucs"), std::string::npos);
  EXPECT_NE(find(numbers, "nu")->definition.find("between 20 and 50 % of ucs"), std::string::npos);
  EXPECT_NE(find(numbers, "E_secant")->definition.find("reaches 30 % of ucs"), std::string::npos);
  EXPECT_NE(find(numbers, "E_small")->definition.find("between 10 and 20 % of ucs"), std::string::npos);
}

TEST(Analyse, EveryNumberHasItsOwnNameAUnitAndADefinition) {
  std::set<std::string> names;
  for (const Number& n : numbers_of(marble(), {})) {
    EXPECT_TRUE(names.insert(n.name).second) << n.name;
    EXPECT_FALSE(n.unit.empty()) << n.name;
    EXPECT_FALSE(n.definition.empty()) << n.name;
  }
  EXPECT_EQ(find({}, "ucs"), nullptr);
}

/// What has no finite value must be NaN and say why.
void expect_reasons(const History& h, const std::vector<CrackEvent>& cracks) {
  for (const Number& n : numbers_of(h, cracks))
    EXPECT_TRUE(std::isfinite(n.value) || (std::isnan(n.value) && !n.note.empty()))
        << n.name << " " << n.value;
}

TEST(Analyse, WhateverTheHistoryNothingIsLeftUntold) {
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<CrackEvent> cracks(5);
  const HistoryColumns& columns = TestKind()->columns;
  History rows;
  expect_reasons(rows, cracks);
  for (const double v : {0.0, 5.0, -5.0, nan, inf}) {
    rows.rows.clear();
    for (int n = 1; n <= 4; ++n) {
      HistoryRow r;
      for (const HistoryColumn& c : columns) r.*c.value = v;
      rows.rows.push_back(r);
      expect_reasons(rows, cracks);
    }
  }
  for (const HistoryColumn& c : columns) {
    for (const double v : {0.0, nan, inf, -inf}) {
      History spoiled = marble();
      for (HistoryRow& r : spoiled.rows) r.*c.value = v;
      expect_reasons(spoiled, cracks);
      spoiled = marble();
      spoiled.rows.front().*c.value = spoiled.rows[199].*c.value = spoiled.rows.back().*c.value = v;
      expect_reasons(spoiled, cracks);
    }
  }
}

TEST(Analyse, NoHistoryGivesNotesOnly) {
  for (const Number& n : numbers_of(History{}, {})) {
    if (n.unit == "1" && n.name.starts_with("cracks_") && !n.name.ends_with("_at_peak")) continue;
    EXPECT_TRUE(std::isnan(n.value)) << n.name;
    EXPECT_TRUE(n.note.starts_with("the stress never rises above zero") ||
                n.note == "the history holds no energies")
        << n.name << ": " << n.note;
  }
}

TEST(Analyse, InfiniteEnergiesAreToldAsUnusable) {
  History h = marble();
  h.rows.back().slip = std::numeric_limits<double>::infinity();
  const auto numbers = numbers_of(h, {});
  EXPECT_TRUE(std::isnan(value(numbers, "energy_slip")));
  EXPECT_EQ(note(numbers, "energy_slip"), "the history holds no usable values for it");
}

}  // namespace
}  // namespace phy::analysis
