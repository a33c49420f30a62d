// Which model is chosen, of layers and matrix, for rocks whose model is known: rows of the maps as a
// laboratory would report them, moduli by the direct solution of a small packing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "calibrate/elastic_response.hpp"
#include "calibrate/model_trial.hpp"
#include "maps/response_map.hpp"
#include "records/reading_fixture.hpp"
#include "report/words.hpp"
#include "twin_trial.hpp"

namespace phy {
namespace {

std::string story(const maps::ModelChoice& choice) {
  std::string text;
  for (const std::string& line : report::sentences(choice.findings())) text += line + " ";
  return text;
}

using maps::ResponseMap;

Rock rock_of(const ResponseMap& table, std::size_t row) {
  Rock rock;
  rock.layers = LayerModel::choose, rock.matrix.reset();
  rock.model = magnified_model(5.0);
  rock.model.bedding[0].rule = BeddingRule::crossing;
  rock.E_is = ModulusReading::tangent_50;
  for (const double theta : maps::mapped_angles) {
    rock.readings.push_back(
        reading(Property::E, theta, 38e9 * table.at(row, fmt::format("E50/E_c({:g})", theta))));
    rock.readings.push_back(
        reading(Property::ucs, theta, 50e6 * table.at(row, fmt::format("UCS/sigma_c({:g})", theta))));
  }
  for (const double theta : maps::mapped_disc_angles) {
    const double bts = 50e6 * table.at(row, fmt::format("BTS/sigma_c({:g})", theta));
    if (std::isfinite(bts)) rock.readings.push_back(reading(Property::brazilian, theta, bts));
  }
  return rock;
}

maps::ModelChoice choice_for(const Rock& rock, calibrate::Simulator& simulator) {
  const Evidence evidence(rock);
  return calibrate::choose_model(evidence, maps::candidates_of(evidence), 1, simulator,
                                 [](const Finding&) {});
}

/// "bridges" of whatever share of the planes.
std::string words_of(const maps::ModelChoice& choice) {
  return choice.rock().layers == LayerModel::planes_with_bridges ? "bridges"
                                                                 : maps::model_in_words(choice.rock());
}

/// How many of some sensible rows of a family, from the first of them, are taken for what they are.
int recognised(const std::string& name, const std::string& words, int n, calibrate::Simulator& simulator) {
  const ResponseMap& table = maps::map_of(family(name));
  int right = 0;
  for (std::size_t row = 0; n > 0; ++row) {
    if (!table.is_plausible(row)) continue;
    --n;
    const maps::ModelChoice choice = choice_for(rock_of(table, row), simulator);
    right += words_of(choice) == words ? 1 : 0;
    std::printf("%s, row %zu: %s\n", name.c_str(), row, story(choice).c_str());
  }
  return right;
}

std::unique_ptr<calibrate::Simulator> all_cores() {
  return calibrate::make_simulator(
      {static_cast<int>(std::max(1U, std::thread::hardware_concurrency())), "", nullptr, nullptr});
}

TEST(ModelChoice, TellsPlanesDirectionsAndBridgesApart) {
  const auto simulator = all_cores();
  EXPECT_EQ(recognised("parallel-bond-crossing", "joints on planes", 2, *simulator), 2);
  EXPECT_EQ(recognised("parallel-bond-directions", "directions of the bonds", 2, *simulator), 2);
  EXPECT_GE(recognised("parallel-bond-bridges-crossing", "bridges", 2, *simulator), 1);
}

// Strengths of a rock with directions, E of one on planes, least at 45 degrees, which no directions have.
TEST(ModelChoice, AModelWithoutTheEOfTheTableGivesWay) {
  const auto simulator = all_cores();
  Rock rock = rock_of(maps::map_of(family("parallel-bond-directions")), 2);
  std::erase_if(rock.readings, [](const RockReading& r) { return r.property == Property::E; });
  const double E[] = {24.6, 23.0, 21.6, 21.4, 23.3, 29.7, 31.8};  // [GPa], every 15 degrees
  for (int i = 0; i < 7; ++i) rock.readings.push_back(reading(Property::E, 15.0 * i, 1e9 * E[i]));
  const maps::ModelChoice choice = choice_for(rock, *simulator);
  std::printf("%s\n", story(choice).c_str());
  const maps::Rival& taken = choice.rivals[choice.best];
  EXPECT_LT(taken.modulus_error, 0.06);
  EXPECT_TRUE(std::any_of(choice.rivals.begin(), choice.rivals.end(),
                          [&](const maps::Rival& r) { return r.error < taken.error; }));
}

// Flat joints are taken where UCS is more of the tensile strength than parallel bonds have.
TEST(ModelChoice, TakesFlatJointsForWhatIsWeakInTension) {
  const auto simulator = all_cores();
  Rock rock;
  rock.bedded = false, rock.matrix.reset(), rock.E_is = ModulusReading::tangent_50;
  rock.model = magnified_model(5.0);
  const auto words_at = [&](double ratio) {
    rock.readings = {reading(Property::E, 0.0, 50e9), reading(Property::nu, 0.0, 0.25),
                     reading(Property::ucs, 0.0, 120e6), reading(Property::brazilian, 0.0, 120e6 / ratio)};
    const maps::ModelChoice choice = choice_for(rock, *simulator);
    std::printf("UCS/BTS %g: %s\n", ratio, story(choice).c_str());
    return maps::model_in_words(choice.rock());
  };
  EXPECT_EQ(words_at(7.0), "parallel bonds");
  EXPECT_EQ(words_at(18.0), "flat joints");
}

// A share of the planes that a recipe states stays; others are tried, where strengths can be left out.
TEST(ModelChoice, TriesSharesOfThePlanesThatNobodyHasStated) {
  Rock rock = rock_of(maps::map_of(family("parallel-bond-crossing")), 5);
  rock.layers = LayerModel::planes_with_bridges;
  const auto shares = [&] {
    std::vector<double> all;
    for (const Rock& r : maps::candidates_of(Evidence(rock)))
      all.push_back(r.model.bedding.at(0).persistence);
    return all;
  };
  EXPECT_EQ(shares(), (std::vector<double>{0.8, 0.65, 0.5, 0.35, 0.2}));
  const Rock whole = rock;
  rock.model.bedding[0].persistence = 0.7;
  EXPECT_EQ(shares(), std::vector<double>{0.7});
  rock = whole;
  std::erase_if(rock.readings,
                [](const RockReading& r) { return r.property == Property::ucs && r.theta > 40.0; });
  std::erase_if(rock.readings, [](const RockReading& r) { return r.property == Property::brazilian; });
  EXPECT_EQ(shares(), std::vector<double>{maps::usual_persistence});
  const std::vector<Rock> one = maps::candidates_of(Evidence(rock));
  const auto assumed = maps::assumed_share(rock, one);
  ASSERT_TRUE(assumed);
  EXPECT_EQ(assumed->number("share"), 0.65);
  EXPECT_FALSE(maps::assumed_share(one.front(), one)) << "stated";
}

/// Errors of shares 0.8, 0.65, 0.5, 0.35, 0.2, before them that of whole planes; the best is taken.
maps::ModelChoice choice_of(const std::vector<double>& errors) {
  Rock rock = rock_of(maps::map_of(family("parallel-bond-crossing")), 5);
  rock.matrix = MatrixModel::parallel_bond;
  maps::ModelChoice choice;
  for (const Rock& r : maps::candidates_of(Evidence(rock)))
    if (r.layers == LayerModel::planes || r.layers == LayerModel::planes_with_bridges)
      choice.rivals.push_back({r, 0.02, 0.0, errors.at(choice.rivals.size())});
  choice.best = static_cast<std::size_t>(std::min_element(errors.begin(), errors.end()) - errors.begin());
  return choice;
}

TEST(ModelChoice, AShareLiesBetweenThoseThatPredictClearlyWorse) {
  const auto share = choice_of({0.16, 0.15, 0.13, 0.100, 0.105, 0.125}).share();
  ASSERT_TRUE(share);
  EXPECT_EQ(share->value, 0.5);
  EXPECT_EQ(std::pair(share->low, share->high), std::pair(0.2, 0.65));
  EXPECT_FALSE(share->determined);
  const auto narrow = choice_of({0.16, 0.10, 0.13, 0.15, 0.15, 0.15}).share();
  ASSERT_TRUE(narrow);
  EXPECT_EQ(std::pair(narrow->low, narrow->high), std::pair(0.65, 1.0));
  EXPECT_TRUE(narrow->determined);
  EXPECT_FALSE(choice_of({0.10, 0.15, 0.15, 0.15, 0.15, 0.15}).share()) << "whole planes";
  EXPECT_EQ(choice_of({0.105, 0.10, 0.15, 0.15, 0.15, 0.15}).share()->high, 1.0);
}

/// Names of the nearest of another kind: the model, the one that is taken, layers and matrix to ask for;
/// none: there is no such model.
std::vector<std::string> first_advice(const maps::ModelChoice& choice) {
  const auto near = choice.near_ones();
  return near.empty() ? std::vector<std::string>() : choice.asked_for(*near.front()).names;
}

TEST(ModelChoice, TellsHowToAskForANearRivalOfAnotherKind) {
  using Names = std::vector<std::string>;
  const maps::ModelChoice bridges = choice_of({0.10, 0.11, 0.13, 0.15, 0.15, 0.15});
  EXPECT_EQ(first_advice(bridges),
            (Names{"joints on 0.8 of the planes", "joints on planes", "planes with bridges", ""}));
  const Finding advice = bridges.asked_for(*bridges.near_ones().front());
  EXPECT_NEAR(advice.number("error"), 0.11, 1e-12);
  EXPECT_NEAR(advice.number("taken_error"), 0.10, 1e-12);
  EXPECT_EQ(first_advice(choice_of({0.11, 0.13, 0.09, 0.091, 0.15, 0.15}))[2], "planes");
  EXPECT_TRUE(first_advice(choice_of({0.10, 0.13, 0.13, 0.15, 0.15, 0.15})).empty());
  maps::ModelChoice choice = choice_of({0.10, 0.15, 0.15, 0.15, 0.15, 0.15});
  maps::Rival other = choice.rivals.front();
  other.rock = maps::with_model(other.rock, LayerModel::directions, MatrixModel::parallel_bond);
  other.error = 0.105, choice.rivals.push_back(other);
  EXPECT_EQ(first_advice(choice)[2], "directions");
  other = choice.rivals.front();
  other.rock = maps::with_model(other.rock, LayerModel::planes, MatrixModel::flat_joint);
  other.error = 0.101, choice.rivals.push_back(other);
  EXPECT_EQ(first_advice(choice),
            (Names{"joints on planes between flat joints", "joints on planes", "planes", "flat_joint"}));
  choice.rivals.back().modulus_error = 0.07;  // another model has E
  EXPECT_EQ(first_advice(choice)[2], "directions");
}

TEST(ModelChoice, RivalsAreTheBestOfEveryOtherKindTheNearestFirst) {
  maps::ModelChoice choice = choice_of({0.10, 0.13, 0.11, 0.12, 0.15, 0.15});
  ASSERT_EQ(choice.near_ones().size(), 1U);
  const maps::Rival& bridged = *choice.near_ones().front();
  EXPECT_EQ(bridged.rock.model.bedding.front().persistence, 0.65);
  ASSERT_TRUE(choice.share(bridged));
  EXPECT_EQ(choice.share(bridged)->value, 0.65);
  EXPECT_FALSE(choice.share());
  maps::Rival other = choice.rivals.front();
  other.rock = maps::with_model(other.rock, LayerModel::directions, MatrixModel::parallel_bond);
  other.error = 0.105, choice.rivals.push_back(other);
  ASSERT_EQ(choice.near_ones().size(), 2U);
  EXPECT_EQ(choice.near_ones().front()->rock.layers, LayerModel::directions);
  EXPECT_EQ(choice.near_ones().back()->rock.layers, LayerModel::planes_with_bridges);
  EXPECT_TRUE(choice_of({0.10, 0.13, 0.13, 0.15, 0.15, 0.15}).near_ones().empty());
}

TEST(ModelChoice, RockWithoutLayersHasNoShareOfThem) {
  Rock rock = rock_of(maps::map_of(family("parallel-bond-crossing")), 5);
  rock.bedded = false, remove_layers(rock.model);
  std::erase_if(rock.readings, [](const RockReading& r) { return r.theta > 0.0; });
  const maps::ModelChoice choice = choice_for(rock, *all_cores());
  EXPECT_EQ(choice.rivals.size(), 2U);
  EXPECT_FALSE(choice.share());
  if (const std::vector<std::string> rival = first_advice(choice); !rival.empty()) {
    EXPECT_EQ(rival[2], "") << "no layers";
    EXPECT_NE(rival[3], "");
  }
}

TEST(ModelChoice, ATableWithoutTensionLeavesTheMatrixAsItIs) {
  Rock rock = rock_of(maps::map_of(family("parallel-bond-crossing")), 5);
  EXPECT_EQ(maps::candidates_of(Evidence(rock)).size(), 9U);
  std::erase_if(rock.readings, [](const RockReading& r) { return r.property == Property::brazilian; });
  EXPECT_EQ(maps::candidates_of(Evidence(rock)).size(), 8U);
  rock.matrix = MatrixModel::flat_joint;  // asked for: planes alone
  const std::vector<Rock> one = maps::candidates_of(Evidence(rock));
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(maps::model_in_words(one.front()), "joints on planes between flat joints");
  EXPECT_EQ(one.front().model.matrix.E_c, 76e9);  // as stiff as 38 + 38 GPa
}

}  // namespace
}  // namespace phy
