// The tests behind src/calibrate/prior_regression.cpp: synthetic rocks from outside the twenty of the twin
// trials, each at nine points of the strength box. All 48 are 3,456 tests, some 50 minutes of CPU;
// PHY_REGRESSION_ROCKS sets how many, PHY_REGRESSION_STORE a file that keeps finished tests.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "../calibration/twin_trial.hpp"
#include "analysis/analyse.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/prior_regression.hpp"
#include "calibrate/strength_tests.hpp"
#include "setting.hpp"

namespace phy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::uint32_t first_rock = 1000, point_seed = 777;
constexpr int n_rocks = 48, n_points = 9, n_packings = 12, first_packing = 201;
constexpr double intact = -1.0;
const std::vector<double> angles = {0, 15, 30, 45, 60, 75, 90};

struct Lesson {
  std::uint32_t rock;
  double theta;
  std::vector<double> z, moduli;
  double y;  ///< log(UCS/sigma_c)
};

/// Rock and ratios of one point.
Recipe recipe_of(std::uint32_t rock, std::uint32_t point, const Recipe& model, std::vector<double>& z) {
  Recipe r = trial_rock(first_rock + rock, model);
  z.clear();
  std::uint32_t i = 1;
  for (const calibrate::StrengthParameter* p : calibrate::regressed_ratios(true)) {
    z.push_back(2.0 * uniform(point_seed, Stream::test, rock, point, i++) - 1.0);
    p->set(r, p->at_place(z.back()));
  }
  return r;
}

/// What UCS may be, for the speed of the platens: matrix, or joints where they lie across the load.
std::vector<Target> guesses(const Recipe& r) {
  std::vector<Target> targets;
  for (const double theta : angles) {
    const double matrix = 2.2 * r.matrix.sigma_c, joint = 4.0 * r.bedding[0].cohesion;
    const bool oblique = theta > 15.0 && theta < 80.0;
    targets.push_back({Property::ucs, theta, oblique ? std::min(matrix, joint) : matrix, 1.0, 1, true});
  }
  return targets;
}

std::vector<Lesson> lessons_of(std::uint32_t rock, const Recipe& model, calibrate::Simulator& simulator) {
  std::vector<Recipe> recipes;
  std::vector<Lesson> lessons;
  for (std::uint32_t p = 0; p < n_points; ++p) {
    std::vector<double> z;
    const Recipe point = recipe_of(rock, p, model, z);
    const std::int64_t seed = first_packing + (rock * n_points + p) / 2 % n_packings;
    const Recipe ready = calibrate::test_settings(point, guesses(point), seed, simulator);
    for (const double theta : angles) {
      recipes.push_back(calibrate::single_at(ready, theta, seed));
      lessons.push_back({rock, theta, z, calibrate::regression_moduli(ready), 0.0});
    }
    recipes.push_back(calibrate::single_at(ready, 0.0, seed));
    recipes.back().bedding.clear();
    z.resize(calibrate::regressed_ratios(false).size());
    lessons.push_back({rock, intact, z, calibrate::regression_moduli(recipes.back()), 0.0});
  }
  const std::vector<TestResult> results = simulator.test(recipes);
  std::vector<Lesson> peaked;
  for (std::size_t i = 0; i < results.size(); ++i)
    if (const Number* ucs = analysis::find(results[i].numbers, "ucs");
        ucs != nullptr && results[i].outcome.status == Status::peaked) {
      lessons[i].y = std::log(ucs->value / recipes[i].matrix.sigma_c);
      peaked.push_back(lessons[i]);
    }
  return peaked;
}

constexpr std::uint32_t n_folds = 8, no_fold = n_folds;
std::uint32_t fold_of(const Lesson& l) { return l.rock % n_folds; }

VectorXd features_of(const std::vector<double>& z, const std::vector<double>& moduli) {
  const std::vector<double> f = calibrate::regression_features(z, moduli);
  return Eigen::Map<const VectorXd>(f.data(), static_cast<Eigen::Index>(f.size()));
}

/// Ridge regression without the rocks of one fold; the usual sizes of coefficients say how much each is
/// believed.
VectorXd regress(const std::vector<Lesson>& all, double theta, std::uint32_t without) {
  constexpr double noise = 0.11, slope = 0.4, modulus = 0.2, second = 0.1;
  MatrixXd A;
  VectorXd b;
  for (const Lesson& l : all) {
    if (l.theta != theta || fold_of(l) == without) continue;
    const VectorXd f = features_of(l.z, l.moduli);
    if (A.size() == 0) {
      const auto n = static_cast<Eigen::Index>(l.z.size()), m = static_cast<Eigen::Index>(l.moduli.size());
      VectorXd size = VectorXd::Constant(f.size(), second);
      size[0] = 1.0, size.segment(1, n).setConstant(slope);
      size.segment(1 + n + n * (n + 1) / 2, m).setConstant(modulus);
      A = (noise * size.cwiseInverse()).cwiseAbs2().asDiagonal();
      b = VectorXd::Zero(f.size());
    }
    A += f * f.transpose(), b += f * l.y;
  }
  return A.ldlt().solve(b);
}

/// Root mean square of what a regression on the other rocks misses of each.
double left_out_error(const std::vector<Lesson>& all, double theta) {
  double squares = 0.0;
  int n = 0;
  for (std::uint32_t fold = 0; fold < n_folds; ++fold) {
    const VectorXd c = regress(all, theta, fold);
    for (const Lesson& l : all) {
      if (l.theta != theta || fold_of(l) != fold) continue;
      const double e = l.y - c.dot(features_of(l.z, l.moduli));
      squares += e * e, ++n;
    }
  }
  return std::sqrt(squares / n);
}

TEST(PriorRegression, IsWhatItsTestsTeach) {
  const auto n = static_cast<std::uint32_t>(setting("PHY_REGRESSION_ROCKS", n_rocks));
  const auto simulator = calibrate::make_simulator({static_cast<int>(std::thread::hardware_concurrency()),
                                                    text_setting("PHY_REGRESSION_STORE"), nullptr, nullptr});
  const Recipe model = magnified_model(2.5);
  std::vector<Lesson> all;
  for (std::uint32_t k = 0; k < n; ++k)
    for (const Lesson& l : lessons_of(k, model, *simulator)) all.push_back(l);
  std::vector<double> kinds = angles;
  kinds.push_back(intact);
  for (const double theta : kinds) {
    const double error = left_out_error(all, theta);
    std::printf("%5.0f degrees: rocks left out are missed by %.3f (rms of the logarithm)\n", theta, error);
    EXPECT_LT(error, 0.2);
  }
  std::vector<VectorXd> columns;
  for (const double theta : angles) columns.push_back(regress(all, theta, no_fold));
  for (Eigen::Index i = 0; i < columns[0].size(); ++i) {
    std::printf("    {");
    for (std::size_t a = 0; a < columns.size(); ++a) std::printf("%s%.3f", a > 0 ? ", " : "", columns[a][i]);
    std::printf("},\n");
  }
  const VectorXd without = regress(all, intact, no_fold);
  for (const double c : without) std::printf("%.3f, ", c);
  std::printf("\n");
  if (n < n_rocks) return;
  for (std::uint32_t k = 0; k < 4; ++k) {  // the table in the program is this one, rounded
    Recipe rock = trial_rock(k, model);
    const std::vector<double> z(calibrate::regressed_ratios(true).size(), 0.25 * k);
    for (std::size_t a = 0; a < angles.size(); ++a)
      EXPECT_NEAR(calibrate::PriorRegression(rock, angles[a]).at(z),
                  columns[a].dot(features_of(z, calibrate::regression_moduli(rock))), 5e-3);
    rock.bedding.clear();
    const std::vector<double> two(calibrate::regressed_ratios(false).size(), 0.25 * k);
    EXPECT_NEAR(calibrate::PriorRegression(rock, 0.0).at(two),
                without.dot(features_of(two, calibrate::regression_moduli(rock))), 5e-3);
  }
}

}  // namespace
}  // namespace phy
