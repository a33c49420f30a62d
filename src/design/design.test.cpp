#include "design/design.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.hpp"
#include "design/sheet.hpp"
#include "report/words.hpp"

namespace phy::design {
namespace {

using enum Constant;

/// A normal variable from two uniform ones, the next of a rock.
class Noise {
 public:
  explicit Noise(std::uint32_t rock) : rock_(rock) {}
  double operator()() {
    const std::uint32_t j = 2 * next_++;
    return std::sqrt(-2.0 * std::log(1.0 - uniform(rock_, Stream::test, j))) *
           std::cos(6.283185307179586 * uniform(rock_, Stream::test, j + 1));
  }

 private:
  std::uint32_t rock_, next_ = 0;
};

struct Truth {
  theory::TransverseIsotropy body = theory::ti_from_goodman({31e9, 22e9, 9e9, 0.23});
  theory::Coulomb plane{11e6, 22.0}, rock{24e6, 37.0};
  double sigma_tj = 3e6, sigma_t = 8e6;
};
const std::vector<double> stresses = {0.0, 5e6, 10e6, 15e6};

/// Tests of one draw: constants that lie about the truth, and tests that scatter about their law.
DrawTests draw_of(const Truth& truth, Noise& noise, double between, double within) {
  const auto about = [&](double value, double sd) { return value * std::exp(sd * noise()); };
  DrawTests draw;
  theory::TransverseIsotropy body = truth.body;
  body.E = about(body.E, between), body.E_n = about(body.E_n, between), body.G_n = about(body.G_n, between);
  const theory::Coulomb plane{about(truth.plane.cohesion, between),
                              truth.plane.friction + 20.0 * between * noise()};
  const theory::Coulomb rock{about(truth.rock.cohesion, between),
                             truth.rock.friction + 20.0 * between * noise()};
  for (const double theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
    draw.elasticity.push_back(
        {theta, about(ti_E(body, theta), 0.1 * within), ti_nu(body, theta) + 0.1 * within * noise()});
    for (const double s : stresses) {
      const double sigma_1 = theory::jaeger_sigma_1(plane, theory::coulomb_sigma_1(rock, s), theta, s);
      draw.compression.push_back({theta, about(sigma_1, within), s});
    }
  }
  draw.tension = {{0.0, about(truth.sigma_tj, between)}, {90.0, about(truth.sigma_t, between)}};
  return draw;
}

DesignTests tests_of(const Truth& truth, std::uint32_t rock, int n_draws, double between, double within) {
  DesignTests tests{.rock = "drawn rock", .stresses = stresses, .draws = {}};
  Noise noise(rock);
  for (int k = 0; k < n_draws; ++k) tests.draws.push_back(draw_of(truth, noise, between, within));
  return tests;
}

// Four draws about a known rock. Of 11 constants and 40 rocks 95 % lie inside; the share of so many has a
// standard error of 1 %, more where constants of a rock miss together.
TEST(Design, IntervalsHoldTheConstantsOfAKnownRock) {
  const Truth truth;
  const std::vector<std::pair<Constant, double>> known = {
      {E, truth.body.E},        {E_n, truth.body.E_n},       {G_n, truth.body.G_n},
      {nu_n, truth.body.nu_n},  {c_j, truth.plane.cohesion}, {phi_j, truth.plane.friction},
      {c, truth.rock.cohesion}, {phi, truth.rock.friction},  {sigma_tj, truth.sigma_tj},
      {sigma_t, truth.sigma_t}};
  int held = 0, all = 0;
  for (std::uint32_t rock = 0; rock < 40; ++rock) {
    const Design d = design_of(tests_of(truth, rock, 4, 0.06, 0.04));
    for (const auto& [constant, value] : known)
      for (const Pooled& part : d.parts)
        if (const ConstantEstimate* e = part.find({constant}))
          ++all, held += e->low <= value && value <= e->high;
  }
  EXPECT_EQ(all, 400);
  EXPECT_GE(held, 368);  // 92 %
}

TEST(Design, WithoutScatterTheConstantsAreThose) {
  const Truth truth;
  const Design d = design_of(tests_of(truth, 1, 3, 0.0, 0.0));
  EXPECT_NEAR(d.part(Part::elasticity).value({E}) / truth.body.E, 1.0, 1e-3);
  EXPECT_NEAR(d.part(Part::ubiquitous_joint).value({c_j}) / truth.plane.cohesion, 1.0, 1e-3);
  EXPECT_NEAR(d.part(Part::ubiquitous_joint).value({phi}) / truth.rock.friction, 1.0, 1e-3);
  EXPECT_LT(d.part(Part::ubiquitous_joint).left_out, 1e-6);
}

TEST(Design, RockWithoutPlanesHasNoUbiquitousJoint) {
  DesignTests tests = tests_of({}, 1, 3, 0.05, 0.02);
  tests.weak_planes = false;
  const Design d = design_of(tests);
  EXPECT_FALSE(d.part(Part::ubiquitous_joint).ok());
  EXPECT_TRUE(d.part(Part::fabric).ok());
  const Finding* refused = first_of(d.findings, FindingKind::design_refused);
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(refused->names.back(), word_of(Refusal::planes_absent));
}

TEST(Design, HoldsTheLaboratoryBeside) {
  const Truth truth;
  DesignTests tests = tests_of(truth, 1, 3, 0.0, 0.0);
  // One strength inside the range, 10 % above the law, and one outside.
  const double at_5 = theory::coulomb_sigma_1(truth.rock, 5e6);
  tests.laboratory = {{.property = Property::confined, .theta = 0.0, .mean = 1.1 * at_5, .confining = 5e6},
                      {.property = Property::confined, .theta = 0.0, .mean = 1.0, .confining = 40e6}};
  const Design d = design_of(tests);
  const Finding* beside = first_of(d.findings, FindingKind::design_laboratory);
  ASSERT_NE(beside, nullptr);
  EXPECT_EQ(beside->number("values"), 1.0);
  EXPECT_NEAR(beside->number("mean"), -std::log(1.1), 1e-6);
}

TEST(Design, AnotherEIsNotCompared) {
  DesignTests tests = tests_of({}, 1, 3, 0.0, 0.0);
  tests.laboratory = {{.property = Property::E, .theta = 0.0, .mean = 20e9}};
  EXPECT_NE(first_of(design_of(tests).findings, FindingKind::design_laboratory), nullptr);
  tests.E_is = ModulusReading::secant_at_peak;
  const Design d = design_of(tests);
  EXPECT_EQ(first_of(d.findings, FindingKind::design_laboratory), nullptr);
  EXPECT_EQ(first_of(d.findings, FindingKind::design_plane_stress)->names.size(), 1u);
}

TEST(Design, StrengthsOfARecipeAreRefused) {
  DesignTests tests = tests_of({}, 1, 3, 0.05, 0.02);
  tests.strengths_sought = false;
  for (DrawTests& draw : tests.draws) draw.compression.clear(), draw.tension.clear();
  const Design d = design_of(tests);
  EXPECT_TRUE(d.part(Part::elasticity).ok());
  const Finding* refused = first_of(d.findings, FindingKind::design_refused);
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(refused->names.back(), word_of(Refusal::not_sought));
  EXPECT_FALSE(first_of(d.findings, FindingKind::design_not_fitted)->names.empty());
  for (const Finding& f : d.findings) EXPECT_FALSE(report::sentence(f).empty());
}

TEST(Design, SheetHasEveryPartAndEverySentence) {
  DesignTests tests = tests_of({}, 1, 3, 0.05, 0.02);
  tests.reading.nu = 0.2;
  const Design d = design_of(tests);
  EXPECT_EQ(sheet_tables(d).size(), 4u);  // a plane, so no fabric
  for (const SheetTable& t : sheet_tables(d))
    for (const auto& row : t.rows) EXPECT_EQ(row.size(), t.head.size());
  const auto json = sheet_json(d);
  EXPECT_EQ(json["findings"].size(), d.findings.size());
  EXPECT_EQ(json["figure"]["panels"].size(), 3u);
  for (const Finding& f : d.findings) EXPECT_FALSE(report::sentence(f).empty());
}

}  // namespace
}  // namespace phy::design
