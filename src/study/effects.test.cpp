// Do effects come out as their definitions say, on functions whose effects are known?
#include "study/effects.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

#include "base/exact_math.hpp"
#include "records/recipe_schema.hpp"
#include "theory/goodman.hpp"

namespace phy::study {
namespace {

using testing::HasSubstr;

/// Two or three keys over [0, 1], so that values and unit coordinates agree.
Study unit_study(Design design, std::int64_t samples, std::size_t n_keys) {
  Study s;
  s.base.bedding.resize(1);
  s.base.test.angles = {0.0, 30.0, 60.0, 90.0};
  s.base.test.intact = true;
  s.design = design;
  s.samples = samples;
  s.packings = {1};
  s.bond_seeds = {1};
  const char* keys[] = {"bedding.mu", "matrix.mu", "engine.step_safety"};
  for (std::size_t k = 0; k < n_keys; ++k) {
    Factor f;
    for (const Field& field : recipe_fields())
      if (field.path() == keys[k]) f.key.field = &field;
    f.from = 0.0, f.to = 1.0;
    s.vary.push_back(f);
  }
  return s;
}

std::vector<double> evaluate(const std::vector<Point>& points,
                             const std::function<double(const std::vector<double>&)>& f) {
  std::vector<double> y;
  for (const Point& p : points) y.push_back(f(p.values));
  return y;
}

TEST(Effects, APlaneIsFoundWithItsStandardErrors) {
  // y = 3 + 2 x + error at x = -1, 0, 1 twice, with errors +-0.3 that cancel at every x: s^2 = 6 (0.09)/(6 -
  // 2), se of the slope = s / sqrt(sum x^2 = 4).
  std::vector<Point> points;
  std::vector<double> y;
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double error : {-0.3, 0.3}) points.push_back({{x}, -1}), y.push_back(3.0 + 2.0 * x + error);
  const PlaneFit fit = fit_plane(points, y);
  EXPECT_NEAR(fit.slope[0], 2.0, 1e-12);
  EXPECT_NEAR(fit.se[0], std::sqrt(0.135 / 4.0), 1e-12);
  EXPECT_NEAR(fit.R2, 1.0 - 0.54 / (16.0 + 0.54), 1e-12);
}

TEST(Effects, APlaneHoldsForKeysOfVeryDifferentSize) {
  std::vector<Point> points;
  for (const double a : {1e12, 2e12, 4e12})
    for (const double b : {1e-4, 3e-4}) points.push_back({{a, b}, -1});
  const PlaneFit fit =
      fit_plane(points, evaluate(points, [](const auto& x) { return 1e-6 * x[0] - 2e9 * x[1]; }));
  EXPECT_NEAR(fit.slope[0], 1e-6, 1e-15);
  EXPECT_NEAR(fit.slope[1], -2e9, 1.0);
  EXPECT_TRUE(std::isnan(fit_plane({points[0], points[1]}, {1.0, 2.0}).R2)) << "two points, two slopes";
}

TEST(Effects, ElementaryEffectsOfAPlaneAreItsSlopes) {
  const std::vector<Point> points = points_of(unit_study(Design::morris, 6, 3));
  const auto effects =
      elementary_effects(points, evaluate(points, [](const auto& x) { return 4.0 * x[0] - 3.0 * x[1]; }));
  const double slopes[] = {4.0, -3.0, 0.0};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(effects[k].mu, slopes[k], 1e-12);
    EXPECT_NEAR(effects[k].mu_star, std::abs(slopes[k]), 1e-12);
    EXPECT_NEAR(effects[k].sigma, 0.0, 1e-12);
    EXPECT_EQ(effects[k].n, 6u);
  }
  const auto product =
      elementary_effects(points, evaluate(points, [](const auto& x) { return x[0] * x[1]; }));
  EXPECT_GT(product[0].sigma, 0.1) << "an interaction shows as scatter";
}

TEST(Effects, VarianceIndicesOfTheIshigamiFunction) {
  // sin u + 7 sin^2 v + 0.1 w^4 sin u on (-pi, pi)^3; indices in closed form: Ishigami & Homma 1990.
  const Study s = unit_study(Design::saltelli, 2048, 3);
  const auto angle = [](double u) { return pi * (2.0 * u - 1.0); };
  const auto indices = variance_indices(3, evaluate(points_of(s), [&](const auto& x) {
                                          const double u = std::sin(angle(x[0])), v = std::sin(angle(x[1]));
                                          return u + 7.0 * v * v + 0.1 * std::pow(angle(x[2]), 4.0) * u;
                                        }));
  const double V = 0.5 + 49.0 / 8.0 + 0.1 * std::pow(pi, 4) / 5.0 + 0.01 * std::pow(pi, 8) / 18.0;
  const double u_alone = 0.5 * std::pow(1.0 + 0.1 * std::pow(pi, 4) / 5.0, 2.0);
  const double u_and_w = 0.01 * std::pow(pi, 8) * (1.0 / 18.0 - 1.0 / 50.0);
  const double first[] = {u_alone / V, 49.0 / 8.0 / V, 0.0};
  const double total[] = {(u_alone + u_and_w) / V, 49.0 / 8.0 / V, u_and_w / V};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(indices[k].first, first[k], 0.02) << k;
    EXPECT_NEAR(indices[k].total, total[k], 0.02) << k;
  }
}

/// A study whose tests came out as Goodman's law has it: K = 1.8 k_n + 300 GPa/m, one packing stiffer by 10
/// %.
struct Made {
  Plan plan;
  StudyRows rows;
};
Made goodman_study() {
  Study s = unit_study(Design::one_at_a_time, 0, 1);
  for (const Field& field : recipe_fields())
    if (field.path() == "bedding.k_n") s.vary[0].key.field = &field;
  s.vary[0].levels = {1680e9, 3360e9, 6720e9};
  s.packings = {1, 2};
  Made made{make_plan(s), {}};
  for (const PlannedTest& t : made.plan.tests) {
    const double E = t.recipe.packing.seed == 1 ? 40e9 : 44e9;
    const bool intact = t.recipe.bedding.empty();
    const BeddingRecipe b = intact ? BeddingRecipe{} : t.recipe.bedding[0];
    const theory::JointedRock rock{E, (1.8 * b.k_n + 300e9) * b.spacing, 1500e9 * b.spacing, 0.0};
    StoredResult row;
    row.result.outcome.status = Status::peaked;
    row.result.numbers = {{"E_tangent", intact ? E : theory::goodman_E(rock, b.theta), "Pa", "", ""},
                          {"ucs", E / 400.0, "Pa", "", ""}};
    made.rows.push_back(row);
  }
  return made;
}

TEST(Effects, MacroStiffnessAndItsLineComeBack) {
  const auto [plan, rows] = goodman_study();
  const JointFits fits = fit_joints(plan, rows, {"E_tangent"});
  for (std::size_t p = 0; p < plan.points.size(); ++p) {
    EXPECT_NEAR(fits.K_n.at(p).mean / (1.8 * plan.points[p].values[0] + 300e9), 1.0, 1e-9);
    EXPECT_NEAR(fits.K_s.at(p).mean / 1500e9, 1.0, 1e-9);
    EXPECT_EQ(fits.K_n.at(p).n, 2u);
    EXPECT_NEAR(fits.R2.at(p).mean, 1.0, 1e-12);
    EXPECT_NEAR(fits.E[3].at(p).mean, 42e9, 1.0);  // at 90 degrees: the intact rock
  }
  const auto effects = effects_of(plan, fits.K_n, 0);
  EXPECT_EQ(effects[0].name, "slope");
  EXPECT_NEAR(effects[0].value.mean, 1.8, 1e-9);
  EXPECT_EQ(effects.back().name, "change");
  EXPECT_NEAR(effects.back().value.mean, (1.8 * 6720 + 300.0) / (1.8 * 1680 + 300.0) - 1.0, 1e-9);
  EXPECT_THAT(effects_text(plan, rows), HasSubstr("K_n = 1.8000+-0.0000 k_n + 300.0+-0.0 GPa/m"));
}

// Dispersed joints have no area of planes that a stiffness could be of; the curve of Eq. 1 is there.
TEST(Effects, WithoutPlanesNoMacroStiffness) {
  auto [plan, rows] = goodman_study();
  for (PlannedTest& t : plan.tests)
    for (BeddingRecipe& set : t.recipe.bedding) set.rule = BeddingRule::oriented;
  const JointFits fits = fit_joints(plan, rows, {"E_tangent"});
  EXPECT_EQ(fits.K_n.at(0).n, 0u);
  EXPECT_EQ(fits.K_s.at(0).n, 0u);
  EXPECT_NEAR(fits.R2.at(0).mean, 1.0, 1e-12);
  EXPECT_NEAR(fits.E[3].at(0).mean, 42e9, 1.0);
  EXPECT_EQ(effects_text(plan, rows).find("macro joint stiffness"), std::string::npos);
}

TEST(Effects, TextFitsTheTerminalAndExplainsWhatIsThere) {
  auto [plan, rows] = goodman_study();
  for (const int width : {40, 60}) {
    std::istringstream lines(effects_text(plan, rows, width));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), width) << line;
  }
  EXPECT_THAT(effects_text(plan, rows), HasSubstr("+-: 95 %"));
  for (auto& row : rows) row.reset();
  EXPECT_EQ(effects_text(plan, rows), "");
}

TEST(Effects, ATestThatIsMissingLeavesItsPackingOut) {
  auto [plan, rows] = goodman_study();
  rows[0].reset();  // 0 degrees, first level, packing 1
  EXPECT_EQ(fit_joints(plan, rows, {"E_tangent"}).K_n.at(0).n, 1u);
  const std::string csv = responses_csv(plan, all_responses(plan, rows));
  EXPECT_LT(csv.find("theta = 0 deg"), csv.find("theta = 30 deg")) << "the order of the design";
  EXPECT_THAT(csv, HasSubstr("E_tangent,Pa,theta = 0 deg,0,3.36e+12,1,"));
  EXPECT_THAT(csv, HasSubstr("E_tangent,Pa,theta = 30 deg,0,3.36e+12,2,"));
}

TEST(Effects, TestsThatDidNotPeakAreLeftOutAndCounted) {
  auto [plan, rows] = goodman_study();
  EXPECT_THAT(effects_text(plan, rows), testing::Not(HasSubstr("left out")));
  rows[0]->result.outcome.status = Status::not_peaked;  // 0 degrees, first level, packing 1
  rows[1]->result.outcome.status = Status::unstable;
  EXPECT_EQ(responses(plan, rows, "ucs")[0].at(0).n, 1u);
  EXPECT_EQ(fit_joints(plan, rows, {"E_tangent"}).K_n.at(0).n, 1u);
  EXPECT_THAT(effects_text(plan, rows),
              HasSubstr(fmt::format("left out: 2 of {} specimens, which did not peak", rows.size())));
}

TEST(Effects, TestsWithAKneeCountAndAreNamed) {
  auto [plan, rows] = goodman_study();
  rows[0]->result.outcome.status = Status::knee;
  EXPECT_EQ(responses(plan, rows, "ucs")[0].at(0).n, 2u);
  EXPECT_THAT(effects_text(plan, rows),
              testing::AllOf(HasSubstr(fmt::format("strength at a knee: 1 of {} specimens", rows.size())),
                             testing::Not(HasSubstr("left out"))));
}

TEST(Effects, IntervalsAreOverPackings) {
  const auto [plan, rows] = goodman_study();
  const Response intact = responses(plan, rows, "ucs").back();
  EXPECT_EQ(intact.specimen, "intact");
  EXPECT_NEAR(intact.at(1).mean, 105e6, 1.0);
  EXPECT_NEAR(intact.at(1).half_width, 12.7062047 * 5e6, 1e3);  // Student, one degree of freedom
}

TEST(Effects, TablesHaveARowPerResponseParameterAndEffect) {
  const auto [plan, rows] = goodman_study();
  const std::string csv = effects_csv(plan, all_responses(plan, rows));
  std::istringstream lines(csv);
  std::string line;
  std::size_t n = 0;
  while (std::getline(lines, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 8 + std::count(line.begin(), line.end(), '"') / 2)
        << line;
    ++n;
  }
  // two numbers at five specimens; K_n, K_s, R2 and four E by three references; E_small is not there
  EXPECT_EQ(n, 1u + (2 * 5 + 3 * 7 + 3) * 6);
}

}  // namespace
}  // namespace phy::study
