// Every calibrated parameter: it is the number of the recipe that it says it is, what it sets it reads again,
// and the ratios around it keep still.
#include "records/parameters.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "records/reading_fixture.hpp"
#include "records/recipe_schema.hpp"

namespace phy {
namespace {

Recipe bedded() {
  Recipe r;
  r.bedding.resize(2);
  r.bedding[1].cohesion *= 0.5, r.bedding[1].sigma_n *= 0.25;
  for (BeddingRecipe& b : r.bedding) b.phi = 10.0;
  return r;
}
Recipe foliated() {
  Recipe r;
  r.matrix.stiffness_ratio = 1.5, r.matrix.tension_ratio = 1.2, r.matrix.cohesion_ratio = 0.8,
  r.matrix.cohesion_oblique = 1.3;
  r.matrix.shear_strength = ShearStrength::cohesion_friction, r.matrix.phi = 10.0;
  return r;
}
/// Planes between bonds whose strength has directions.
Recipe foliated_planes() {
  Recipe r = bedded();
  r.matrix = foliated().matrix, r.matrix.stiffness_ratio = 1.0;
  return r;
}

std::vector<const Parameter*> all(const Recipe& model = bedded()) {
  std::vector<const Parameter*> list;
  for (const Parameter* p : elastic_parameters(model)) list.push_back(p);
  for (const Parameter* p : strength_parameters(model)) list.push_back(p);
  return list;
}

/// The field of the recipe under a key; "bedding[0].k_n" is "bedding.k_n" of the first set.
const Field* field_of(std::string key) {
  if (const std::size_t at = key.find("[0]"); at != key.npos) key.erase(at, 3);
  for (const Field& f : recipe_fields())
    if (f.path() == key) return &f;
  return nullptr;
}

TEST(Parameters, AreTheNumbersOfTheRecipeUnderTheirKeys) {
  for (const Recipe& r : {bedded(), foliated(), foliated_planes()}) {
    std::set<std::string> keys;
    for (const Parameter* p : all(r)) {
      EXPECT_TRUE(keys.insert(p->key).second) << p->key;
      const Field* f = field_of(p->key);
      ASSERT_NE(f, nullptr) << p->key;
      EXPECT_EQ(p->number(r), f->get(r, 0)) << p->key;
      if (r.bedding.empty()) {
        EXPECT_NE(f->table, "bedding") << p->key;
      }
      EXPECT_STREQ(p->unit, f->dimension == Dimension::pressure    ? "Pa"
                            : f->dimension == Dimension::stiffness ? "Pa/m"
                            : f->dimension == Dimension::angle     ? "deg"
                                                                   : "1")
          << p->key;
    }
  }
}

TEST(Parameters, ReadWhatTheySetAndMoveNothingElseThatIsSought) {
  for (const Recipe& model : {bedded(), foliated(), foliated_planes()})
    for (const Parameter* p : all(model)) {
      Recipe r = model;
      const double wanted = 1.3 * p->get(r);
      std::vector<double> before;
      for (const Parameter* other : all(model)) before.push_back(other->get(r));
      p->set(r, wanted);
      EXPECT_NEAR(p->get(r) / wanted, 1.0, 1e-14) << p->key;
      std::size_t i = 0;
      for (const Parameter* other : all(model)) {
        if (other != p) {
          EXPECT_NEAR(other->get(r) / before[i], 1.0, 1e-14) << p->key << " moves " << other->key;
        }
        ++i;
      }
    }
}

TEST(Parameters, BondsKeepTheShareOfTheirScatterAndFollowTheContacts) {
  const Recipe before = bedded();
  Recipe r = before;
  matrix_sigma_c.set(r, 2.0 * r.matrix.sigma_c), matrix_tau_c.set(r, 3.0);
  EXPECT_NEAR(r.matrix.sigma_c_sd / r.matrix.sigma_c, before.matrix.sigma_c_sd / before.matrix.sigma_c,
              1e-14);
  EXPECT_NEAR(r.matrix.tau_c_sd / r.matrix.tau_c, before.matrix.tau_c_sd / before.matrix.tau_c, 1e-14);
  for (const Parameter* p : elastic_parameters(Recipe())) p->set(r, 1.5 * p->get(r));
  EXPECT_EQ(r.matrix.E_b, r.matrix.E_c);
  EXPECT_EQ(r.matrix.bond_ks_over_kn, r.matrix.ks_over_kn);
}

TEST(Parameters, FlatJointsHaveNeitherBondsOfTheirOwnNorAMomentContribution) {
  Recipe r = bedded();
  r.matrix.model = MatrixModel::flat_joint;
  const MatrixRecipe usual = r.matrix;
  const std::vector<const Parameter*> list = all(r);
  for (const Parameter* p : list) p->set(r, 1.5 * p->get(r));
  EXPECT_EQ(r.matrix.E_b, usual.E_b);
  EXPECT_EQ(r.matrix.bond_ks_over_kn, usual.bond_ks_over_kn);
  const auto has = [&](const Parameter& p) { return std::find(list.begin(), list.end(), &p) != list.end(); };
  EXPECT_FALSE(has(matrix_moment));
  EXPECT_TRUE(has(matrix_phi));
}

// Other programs read these names in calibration.json.
TEST(Parameters, RatiosAreNamedByTheirTwoNumbers) {
  std::vector<std::string> names;
  for (const Parameter* p : all()) names.push_back(sought(*p).key);
  EXPECT_EQ(names, (std::vector<std::string>{"matrix.E_c", "matrix.ks_over_kn", "bedding[0].k_n",
                                             "bedding[0].k_s", "matrix.sigma_c", "tau_c/sigma_c", "matrix.mu",
                                             "matrix.moment_contribution", "C_sj/tau_c", "sigma_n,sj/C_sj",
                                             "bedding[0].mu", "bedding[0].phi"}));
  EXPECT_EQ(sought(joint_sigma_n).unit, "1");
  EXPECT_EQ(sought(joint_sigma_n).number, nullptr);
  EXPECT_EQ(number_of_recipe(joint_sigma_n).key, "bedding[0].sigma_n");
  EXPECT_EQ(number_of_recipe(joint_sigma_n).unit, "Pa");
}

TEST(Parameters, WithoutBeddingNoneIsOfTheJoints) {
  Recipe r;
  r.bedding.clear();
  for (const Parameter* p : all(r)) EXPECT_GT(p->get(r), 0.0);
  EXPECT_EQ(all(r).size(), 6U);
}

TEST(Parameters, OnlyATableThatTellsThemIsAskedForSome) {
  Rock rock;
  rock.model.bedding.resize(1);
  rock.readings = {reading(Property::ucs, 0.0, 100e6), reading(Property::ucs, 90.0, 100e6)};
  const auto seeks = [&](const Parameter& p) {
    const std::vector<const Parameter*> list = strength_parameters(Evidence(rock));
    return std::find(list.begin(), list.end(), &p) != list.end();
  };
  EXPECT_FALSE(seeks(matrix_moment)) << "no tension in the table";
  rock.readings.push_back(reading(Property::brazilian, 0.0, 8e6));
  EXPECT_TRUE(seeks(matrix_moment));
  rock.model = foliated();
  EXPECT_FALSE(seeks(tension_ratio)) << "tension at one angle";
  EXPECT_TRUE(seeks(cohesion_ratio) && !seeks(joint_cohesion));
  rock.readings.push_back(reading(Property::brazilian, 90.0, 6e6));
  EXPECT_TRUE(seeks(tension_ratio));
  rock.model = foliated_planes();
  EXPECT_TRUE(seeks(tension_ratio) && seeks(cohesion_oblique) && seeks(joint_cohesion));
}

TEST(Parameters, BetweenPlanesTheStiffnessOfBondsHasNoDirections) {
  const auto stiffness = [](const Recipe& r) {
    const std::vector<const Parameter*> list = all(r);
    return std::any_of(list.begin(), list.end(), [](const Parameter* p) {
      return std::string_view(p->key) == "matrix.stiffness_ratio";
    });
  };
  EXPECT_TRUE(stiffness(foliated()));
  EXPECT_FALSE(stiffness(foliated_planes()) || stiffness(bedded()));
}

TEST(Parameters, BoxesAreMultiplesOfWhatTheTableHolds) {
  Rock rock;
  rock.model.bedding.resize(1), rock.model.bedding[0].spacing = 0.01;
  rock.readings = {reading(Property::E, 0.0, 20e9), reading(Property::E, 90.0, 40e9),
                   reading(Property::ucs, 0.0, 100e6), reading(Property::brazilian, 0.0, 8e6)};
  const Scales scales = Evidence(rock).scales;
  EXPECT_EQ(scales.modulus, 40e9);
  EXPECT_NEAR(scales.stiffness, 4e12, 1.0);
  EXPECT_EQ(scales.strength, 100e6);
  for (const Parameter* p : all()) {
    const LogBox box = p->box(scales);
    EXPECT_LT(box.low, box.usual) << p->key;
    EXPECT_LT(box.usual, box.high) << p->key;
    const std::string unit = sought(*p).unit;
    EXPECT_EQ(p->range.of == nullptr, unit == "1" || unit == "deg") << p->key;
  }
  EXPECT_NEAR(std::exp(matrix_sigma_c.box(scales).low), 10e6, 1.0);
  EXPECT_NEAR(std::exp(matrix_mu.box(scales).high), 1.2, 1e-12);
}

TEST(Parameters, PriorsStandInTheTableOfTheirSources) {
  std::ifstream in(PHY_SOURCE_DIR "/docs/theory/inference.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  std::set<const Parameter*> stated;
  for (const Recipe& r : {bedded(), foliated()})
    for (const Parameter* p : strength_parameters(r))
      if (std::isfinite(p->range.sd)) stated.insert(p);
  EXPECT_EQ(stated.size(), 6U);
  for (const Parameter* p : stated) {
    const std::string row =
        fmt::format("\n| {} | {:g} | {:g} | ", sought(*p).symbol, p->range.usual, p->range.sd);
    EXPECT_NE(page.find(row), page.npos) << row;
  }
}

TEST(Parameters, PlacesRunFromOneEndOfTheBoxToTheOther) {
  for (const Parameter* p : strength_parameters(bedded())) {
    if (p == &matrix_sigma_c) continue;
    EXPECT_DOUBLE_EQ(p->normalised(p->range.low), -1.0);
    EXPECT_DOUBLE_EQ(p->normalised(p->range.high), 1.0);
    EXPECT_NEAR(p->from_normalised(0.0), std::sqrt(p->range.low * p->range.high), 1e-14);
    EXPECT_NEAR(p->from_normalised(p->normalised(p->range.usual)) / p->range.usual, 1.0, 1e-14);
  }
}

}  // namespace
}  // namespace phy
