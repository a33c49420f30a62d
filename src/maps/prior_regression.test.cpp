// The prior regression against what it must know whatever was learnt, and against the paper's specimen at
// full size, which it has never seen.
#include "maps/prior_regression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "records/reading_fixture.hpp"

namespace phy::maps {
namespace {

Recipe paper_rock() {
  Recipe r;
  r.bedding.resize(1);
  return r;
}

std::vector<const Parameter*> ratios_of(const Recipe& r) {
  std::vector<const Parameter*> list = strength_parameters(r);
  std::erase(list, &matrix_sigma_c);
  return list;
}

/// Place of a recipe in the box of strength ratios.
std::vector<double> place_of(const Recipe& r) {
  std::vector<double> z;
  for (const Parameter* p : ratios_of(r)) z.push_back(p->normalised(p->get(r)));
  return z;
}

double prior(const Recipe& r, double theta, Property property = Property::ucs) {
  return r.matrix.sigma_c * std::exp(PriorRegression(ratios_of(r), r, property, theta).at(place_of(r)));
}

TEST(PriorRegression, PredictsThePapersSpecimenThatItHasNotSeen) {
  // three packings of 7,481 discs (measured/paper-specimen.csv), which scatter by up to 9 %
  const std::map<double, double> measured = {{0, 105.2e6}, {15, 100.4e6}, {30, 67.1e6}, {45, 52.8e6},
                                             {60, 49.8e6}, {75, 71.9e6},  {90, 138.3e6}};
  double squares = 0.0;
  for (const auto& [theta, ucs] : measured) {
    const double error = std::log(prior(paper_rock(), theta) / ucs);
    EXPECT_LT(std::fabs(error), 0.35) << theta;
    squares += error * error / 7.0;
  }
  EXPECT_LT(std::sqrt(squares), 0.2);  // of rocks of its own kind it misses 10 to 18 %
  Recipe intact = paper_rock();
  intact.bedding.clear();
  EXPECT_NEAR(prior(intact, 0.0) / 179.5e6, 1.0, 0.2);
}

TEST(PriorRegression, IsTheSameAtMirroredAnglesAndLinearBetweenThoseItKnows) {
  const std::vector<double> z = place_of(paper_rock());
  const auto at = [&](double theta) {
    return PriorRegression(ratios_of(paper_rock()), paper_rock(), Property::ucs, theta).at(z);
  };
  EXPECT_DOUBLE_EQ(at(30.0), at(150.0));
  EXPECT_NEAR(at(37.5), 0.5 * (at(30.0) + at(45.0)), 1e-12);
}

TEST(PriorRegression, DependsOnNoUnitAndNoSizeOfGrains) {
  Recipe other = paper_rock();
  MatrixRecipe& m = other.matrix;
  BeddingRecipe& b = other.bedding[0];
  for (double* stress :
       {&m.E_c, &m.E_b, &m.sigma_c, &m.sigma_c_sd, &m.tau_c, &m.tau_c_sd, &b.cohesion, &b.sigma_n})
    *stress *= 3.0;
  for (double* length : {&other.packing.radius_min, &other.packing.radius_max, &b.spacing}) *length *= 2.0;
  b.k_n *= 1.5, b.k_s *= 1.5;
  EXPECT_NEAR(prior(other, 45.0) / prior(paper_rock(), 45.0), 3.0, 1e-9);
}

TEST(PriorRegression, HoldsModuliItHasNotSeenAtTheEdgeOfWhatItHas) {
  Recipe soft = paper_rock(), softer = paper_rock();
  soft.bedding[0].k_s *= 1e-3, softer.bedding[0].k_s *= 1e-5;
  EXPECT_DOUBLE_EQ(prior(soft, 45.0), prior(softer, 45.0));
}

TEST(PriorRegression, TensionIsLessAcrossWeakPlanesThanAlongThem) {
  const Recipe r = paper_rock();  // sigma_n = 10 MPa, C = 30, sigma_c = 65
  EXPECT_LT(prior(r, 90.0, Property::brazilian), 0.9 * prior(r, 0.0, Property::brazilian));
  Recipe weak = r;
  weak.bedding[0].sigma_n = 3e6;
  EXPECT_LT(prior(weak, 90.0, Property::brazilian), 0.7 * prior(r, 90.0, Property::brazilian));
  for (const double theta : {0.0, 20.0, 90.0})
    EXPECT_DOUBLE_EQ(prior(r, theta, Property::direct_tension), prior(r, 90.0 - theta, Property::brazilian));
}

/// Expected sigma_1 [Pa] of a rock whose table has UCS and strengths under confinement.
double prior_confined(const Recipe& recipe, double theta, double sigma_3) {
  Rock rock;
  rock.bedded = !recipe.bedding.empty(), rock.model = recipe;
  RockReading ucs = reading(Property::ucs, 0.0, 2.2 * recipe.matrix.sigma_c);
  rock.readings = {ucs};
  const Evidence evidence(rock);
  std::vector<double> z;
  for (const Parameter* p : strength_ratios(evidence)) z.push_back(p->normalised(p->get(recipe)));
  const LogBox sigma = matrix_sigma_c.box(evidence.scales);
  z.push_back(2.0 * (std::log(recipe.matrix.sigma_c) - sigma.low) / (sigma.high - sigma.low) - 1.0);
  Target t{Property::confined, theta, 1.0, 1.0};
  t.confining = sigma_3;
  return recipe.matrix.sigma_c * std::exp(prior_strength(evidence, recipe, t).value(z));
}

TEST(PriorRegression, StrengthUnderConfinementBeginsWithUcsAndGrowsWithFriction) {
  const Recipe r = paper_rock();
  EXPECT_NEAR(prior_confined(r, 45.0, 1.0) / prior(r, 45.0), 1.0, 1e-6);
  const double N = (prior_confined(r, 90.0, 10e6) - prior(r, 90.0)) / 10e6;
  EXPECT_GT(N, 3.0);  // friction angles of 30 and
  EXPECT_LT(N, 8.0);  // 51 degrees
  Recipe smooth = r;
  smooth.matrix.mu = 0.3;
  EXPECT_LT(prior_confined(smooth, 90.0, 10e6) - prior(smooth, 90.0), 0.9 * N * 10e6);
}

// Rows of the map, as the program sees them: UCS and growth together.
TEST(PriorRegression, MeetsTheMapUnderConfinement) {
  for (const MappedModel& family : mapped_models()) {
    if (family.layered() || family.base.matrix.model != MatrixModel::parallel_bond) continue;
    const ResponseMap& table = map_of(family);
    double squares = 0.0;
    int n = 0;
    for (std::size_t row = 0; row < table.n_rows(); row += 7) {
      const double sigma_3 = table.at(row, "sigma_3/sigma_c #2"), q = table.at(row, "q/sigma_c #2");
      if (!table.is_dense(row) || !std::isfinite(q)) continue;
      Recipe recipe = family.base;
      for (const MapVariable& l : family.variables) l.set(recipe, table.at(row, l.name));
      const double sigma_c = recipe.matrix.sigma_c;
      const double error = std::log(prior_confined(recipe, 0.0, sigma_3 * sigma_c) / (q + sigma_3) / sigma_c);
      squares += error * error, ++n;
    }
    ASSERT_GT(n, 20);
    EXPECT_LT(std::sqrt(squares / n), 0.15);
  }
}

// Points that took no part, of every layered family: what a calibration begins with.
TEST(PriorRegression, PredictsPointsThatTookNoPart) {
  for (const MappedModel& family : mapped_models())
    for (const double theta : mapped_angles) {
      if (!family.layered() && theta > 0.0) continue;
      const std::string column = column_at(family, "UCS/sigma_c", theta);
      const double error = MapRegression::left_out_error(map_of(family), column);
      std::printf("%s, %s: missed by %.3f\n", family.name, column.c_str(), error);
      EXPECT_LT(error, 0.35) << family.name << ' ' << column;
    }
}

}  // namespace
}  // namespace phy::maps
