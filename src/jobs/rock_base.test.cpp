// The measured rocks that come with the program: every one can be read, and a table's neighbour is the one
// whose curve it follows.
#include "jobs/rock_base.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "rock/file.hpp"

namespace phy::jobs {
namespace {

std::vector<Target> scaled(const std::string& name, Property property, double factor) {
  std::vector<Target> table;
  for (Target t : targets_of(base_rock(name)))
    if (t.property == property) t.mean *= factor, table.push_back(t);
  return table;
}

TEST(RockBase, EveryRockIsReadAndHasACardOfItsTable) {
  const std::vector<std::string> names = base_rocks();
  EXPECT_THAT(names, testing::IsSupersetOf({"augen-gneiss", "boryeong-shale", "tien-layered", "th26-shale"}));
  for (const std::string& name : names) {
    const Rock rock = base_rock(name);
    const auto card = nlohmann::json::parse(base_card(name));
    EXPECT_EQ(card.at("name"), name);
    EXPECT_EQ(card.at("title"), rock.name);
    EXPECT_FALSE(card.at("sources").empty()) << name;
    std::set<std::string> properties;
    for (const Target& t : targets_of(rock)) properties.insert(to_string(t.property));
    const auto stated = card.at("measured").at("properties").get<std::set<std::string>>();
    EXPECT_EQ(stated, properties) << name;
    for (const auto& cell : card.value("cells", nlohmann::json::array()))
      EXPECT_TRUE(properties.contains(cell.at("property"))) << name;
  }
}

TEST(RockBase, ACopyNamesTheTableBesideIt) {
  for (const std::string& name : base_rocks()) {
    const std::vector<BaseFile> files = base_files(name);
    ASSERT_GE(files.size(), 3U) << name;
    const Rock copy = rock::parse_rock(files[0].text, "rock.toml", {files[1].text, {}});
    EXPECT_EQ(targets_of(copy).size(), targets_of(base_rock(name)).size()) << name;
    EXPECT_THAT(files[0].text, testing::HasSubstr("data = \"table.csv\""));
  }
}

// The shape counts and not the size; the rock itself, with its own values, is no neighbour.
TEST(RockBase, TheNeighbourHasTheShapeOfTheCurve) {
  const auto twice = nearest_rock(scaled("boryeong-shale", Property::ucs, 2.0));
  ASSERT_TRUE(twice);
  EXPECT_THAT(twice->names, testing::ElementsAre("Boryeong shale", "boryeong-shale"));
  EXPECT_NEAR(twice->number("difference"), 0.0, 1e-12);
  const auto itself = nearest_rock(scaled("boryeong-shale", Property::ucs, 1.0));
  ASSERT_TRUE(itself);
  EXPECT_NE(itself->names[1], "boryeong-shale");
  EXPECT_EQ(itself->names.back(), "Boryeong shale") << "whose values these are";
  EXPECT_GT(itself->number("difference"), 0.01);
}

TEST(RockBase, ARockFarFromAllHasNoNeighbour) {
  std::vector<Target> table = scaled("boryeong-shale", Property::ucs, 1.0);
  for (std::size_t i = 0; i < table.size(); ++i) table[i].mean = i % 2 == 0 ? 10e6 : 100e6;
  const auto found = nearest_rock(table);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->cells.empty());
  EXPECT_TRUE(found->names.empty());
}

// One value raised by 7 %: every other one falls in the mean.
TEST(RockBase, TheDifferenceIsThatOfCurvesOverTheirMeans) {
  const std::vector<Target> table = scaled("boryeong-shale", Property::ucs, 1.0);
  std::vector<Target> raised = table;
  raised[0].mean *= 1.07;
  double mean = 0.0, sum = 0.0;
  for (const Target& t : table) mean += t.mean / 7.0;
  const double higher = mean + 0.07 * table[0].mean / 7.0;
  for (std::size_t i = 0; i < 7; ++i) sum += std::pow(raised[i].mean / higher - table[i].mean / mean, 2);
  const auto found = nearest_rock(raised);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->names[1], "boryeong-shale");
  EXPECT_NEAR(found->number("difference"), std::sqrt(sum / 7.0), 1e-12);
}

TEST(RockBase, WhatCannotBeComparedHasNoNeighbour) {
  std::vector<Target> two = scaled("boryeong-shale", Property::ucs, 2.0);
  two.resize(2);
  EXPECT_FALSE(nearest_rock(two));
  EXPECT_THROW(base_rock("no-rock"), InputError);
}

}  // namespace
}  // namespace phy::jobs
