// Every calibrated parameter: it is the number of the recipe that it says it is, what it sets it reads again,
// and the ratios around it keep still.
#include "calibrate/parameters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "calibrate/prior_regression.hpp"
#include "calibrate/reading_fixture.hpp"
#include "records/recipe_schema.hpp"

namespace phy::calibrate {
namespace {

std::vector<const CalibratedParameter*> all() {
  std::vector<const CalibratedParameter*> list;
  for (const ElasticParameter* p : elastic_parameters(true)) list.push_back(p);
  for (const StrengthParameter* p : strength_parameters(true)) list.push_back(p);
  return list;
}

Recipe bedded() {
  Recipe r;
  r.bedding.resize(2);
  r.bedding[1].cohesion *= 0.5, r.bedding[1].sigma_n *= 0.25;
  return r;
}

/// The field of the recipe under a key; "bedding[0].k_n" is "bedding.k_n" of the first set.
const Field* field_of(std::string key) {
  if (const std::size_t at = key.find("[0]"); at != key.npos) key.erase(at, 3);
  for (const Field& f : recipe_fields())
    if (f.path() == key) return &f;
  return nullptr;
}

TEST(CalibratedParameters, AreTheNumbersOfTheRecipeUnderTheirKeys) {
  const Recipe r = bedded();
  std::set<std::string> keys;
  for (const CalibratedParameter* p : all()) {
    EXPECT_TRUE(keys.insert(p->key).second) << p->key;
    const Field* f = field_of(p->key);
    ASSERT_NE(f, nullptr) << p->key;
    EXPECT_EQ(p->number(r), f->get(r, 0)) << p->key;
    EXPECT_EQ(p->of_joint(), f->table == "bedding") << p->key;
    EXPECT_STREQ(p->unit, f->dimension == Dimension::pressure    ? "Pa"
                          : f->dimension == Dimension::stiffness ? "Pa/m"
                                                                 : "1")
        << p->key;
  }
}

TEST(CalibratedParameters, ReadWhatTheySetAndMoveNothingElseThatIsSought) {
  for (const CalibratedParameter* p : all()) {
    Recipe r = bedded();
    const double wanted = 1.3 * p->get(r);
    std::vector<double> before;
    for (const CalibratedParameter* other : all()) before.push_back(other->get(r));
    p->set(r, wanted);
    EXPECT_NEAR(p->get(r) / wanted, 1.0, 1e-14) << p->key;
    std::size_t i = 0;
    for (const CalibratedParameter* other : all()) {
      if (other != p) {
        EXPECT_NEAR(other->get(r) / before[i], 1.0, 1e-14) << p->key << " moves " << other->key;
      }
      ++i;
    }
  }
}

TEST(CalibratedParameters, BondsKeepTheShareOfTheirScatterAndFollowTheContacts) {
  const Recipe before = bedded();
  Recipe r = before;
  matrix_sigma_c.set(r, 2.0 * r.matrix.sigma_c), matrix_tau_c.set(r, 3.0);
  EXPECT_NEAR(r.matrix.sigma_c_sd / r.matrix.sigma_c, before.matrix.sigma_c_sd / before.matrix.sigma_c,
              1e-14);
  EXPECT_NEAR(r.matrix.tau_c_sd / r.matrix.tau_c, before.matrix.tau_c_sd / before.matrix.tau_c, 1e-14);
  for (const ElasticParameter* p : elastic_parameters(false)) p->set(r, 1.5 * p->get(r));
  EXPECT_EQ(r.matrix.E_b, r.matrix.E_c);
  EXPECT_EQ(r.matrix.bond_ks_over_kn, r.matrix.ks_over_kn);
}

// Other programs read these names in calibration.json.
TEST(CalibratedParameters, RatiosAreNamedByTheirTwoNumbers) {
  std::vector<std::string> names;
  for (const CalibratedParameter* p : all()) names.push_back(sought(*p).key);
  EXPECT_EQ(names, (std::vector<std::string>{"matrix.E_c", "matrix.ks_over_kn", "bedding[0].k_n",
                                             "bedding[0].k_s", "matrix.sigma_c", "tau_c/sigma_c", "matrix.mu",
                                             "C_sj/tau_c", "sigma_n,sj/C_sj", "bedding[0].mu"}));
  EXPECT_EQ(sought(joint_sigma_n).unit, "1");
  EXPECT_EQ(sought(joint_sigma_n).number, nullptr);
  EXPECT_EQ(number_of_recipe(joint_sigma_n).key, "bedding[0].sigma_n");
  EXPECT_EQ(number_of_recipe(joint_sigma_n).unit, "Pa");
}

TEST(CalibratedParameters, WithoutBeddingNoneIsOfTheJoints) {
  Recipe r;
  r.bedding.clear();
  for (const ElasticParameter* p : elastic_parameters(false)) EXPECT_GT(p->get(r), 0.0);
  for (const StrengthParameter* p : strength_parameters(false)) EXPECT_GT(p->get(r), 0.0);
  EXPECT_EQ(elastic_parameters(false).size() + strength_parameters(false).size(), 5U);
}

TEST(CalibratedParameters, BoxesAreMultiplesOfWhatTheTableHolds) {
  Rock rock;
  rock.model.bedding.resize(1), rock.model.bedding[0].spacing = 0.01;
  rock.readings = {reading(Property::E, 0.0, 20e9), reading(Property::E, 90.0, 40e9),
                   reading(Property::ucs, 0.0, 100e6), reading(Property::brazilian, 0.0, 8e6)};
  const Scales scales = Evidence(rock).scales;
  EXPECT_EQ(scales.modulus, 40e9);
  EXPECT_NEAR(scales.stiffness, 4e12, 1.0);
  EXPECT_EQ(scales.strength, 100e6);
  for (const CalibratedParameter* p : all()) {
    const LogBox box = p->box(scales);
    EXPECT_LT(box.low, box.usual) << p->key;
    EXPECT_LT(box.usual, box.high) << p->key;
    EXPECT_EQ(p->range.of == nullptr, sought(*p).unit == "1") << p->key;
  }
  EXPECT_NEAR(std::exp(matrix_sigma_c.box(scales).low), 10e6, 1.0);
  EXPECT_NEAR(std::exp(matrix_mu.box(scales).high), 1.2, 1e-12);
}

TEST(CalibratedParameters, PlacesRunFromOneEndOfTheBoxToTheOther) {
  for (const StrengthParameter* p : strength_ratios(true)) {
    EXPECT_DOUBLE_EQ(p->place_of(p->range.low), -1.0);
    EXPECT_DOUBLE_EQ(p->place_of(p->range.high), 1.0);
    EXPECT_NEAR(p->at_place(0.0), std::sqrt(p->range.low * p->range.high), 1e-14);
    EXPECT_NEAR(p->at_place(p->place_of(p->range.usual)), p->range.usual, 1e-14);
  }
}

// The posterior is free to add ratios; the prior regression speaks of those that it has learnt.
TEST(CalibratedParameters, ThePriorSpeaksOfRatiosThatAreSought) {
  for (const bool joints : {false, true}) {
    const std::vector<const StrengthParameter*> ratios = strength_ratios(joints);
    for (const StrengthParameter* p : regressed_ratios(joints))
      EXPECT_NE(std::find(ratios.begin(), ratios.end(), p), ratios.end()) << p->key;
  }
}

}  // namespace
}  // namespace phy::calibrate
