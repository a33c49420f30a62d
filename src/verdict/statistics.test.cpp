// What is said of thousands of tables whose rock is known: means of specimens with normal scatter, no press.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.hpp"
#include "base/stats.hpp"
#include "verdict/judge.hpp"
#include "verdict/margin.hpp"

namespace phy::verdict {
namespace {

constexpr std::uint32_t n_tables = 1000;

/// Values of a rock at seven angles: a straight line of the logarithm.
double truth_at(int cell) { return 100e6 * std::exp(0.1 * cell); }

/// Table k: replicates of scatter `cv`.
Rock table(std::uint32_t k, Property property, int n_cells, int n, double cv) {
  Rock rock;
  for (int cell = 0; cell < n_cells; ++cell)
    for (int i = 0; i < n; ++i) {
      RockReading r;
      r.property = property, r.theta = 15.0 * cell;
      r.value = truth_at(cell) * (1.0 + cv * normal(7, Stream::test, k, static_cast<std::uint32_t>(cell),
                                                    static_cast<std::uint32_t>(i)));
      rock.readings.push_back(r);
    }
  return rock;
}

/// Scatter drawn from the prior: s times the root of 4/chi-square of four degrees of freedom, which is twice
/// the sum of two exponential numbers.
double scatter_of_table(std::uint32_t k, double s) {
  const double chi_square = -2.0 * std::log(uniform(8, Stream::test, k, 0) * uniform(8, Stream::test, k, 1));
  return s * std::sqrt(4.0 / chi_square);
}

/// Percent of the 95 % intervals of the laboratory's means that hold the truth, of logarithms as the fits
/// have them.
double coverage_of_means(Property property, int n_cells, int n, double s, bool drawn) {
  int inside = 0;
  for (std::uint32_t k = 0; k < n_tables; ++k) {
    const double cv = drawn ? scatter_of_table(k, s) : s;
    const std::vector<Target> cells = targets_of(table(k, property, n_cells, n, cv));
    for (std::size_t c = 0; c < cells.size(); ++c)
      inside += std::fabs(std::log(cells[c].mean / truth_at(static_cast<int>(c)))) <=
                        cells[c].half_width() / cells[c].mean
                    ? 1
                    : 0;
  }
  return 100.0 * inside / (n_tables * static_cast<std::uint32_t>(n_cells));
}

/// The same of what a straight line through the logarithms says of the cells, weighted by their errors.
double coverage_of_fit(Property property, int n, double s, bool drawn) {
  int inside = 0, all = 0;
  for (std::uint32_t k = 0; k < n_tables; ++k) {
    const double cv = drawn ? scatter_of_table(k, s) : s;
    const std::vector<Target> cells = targets_of(table(k, property, 7, n, cv));
    double w = 0.0, wx = 0.0, wxx = 0.0, wy = 0.0, wxy = 0.0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const double x = static_cast<double>(c), y = std::log(cells[c].mean);
      const double weight = std::pow(cells[c].mean / cells[c].normal_error(), 2.0);
      w += weight, wx += weight * x, wxx += weight * x * x, wy += weight * y, wxy += weight * x * y;
    }
    const double det = w * wxx - wx * wx, a = (wxx * wy - wx * wxy) / det, b = (w * wxy - wx * wy) / det;
    for (int c = 0; c < 7; ++c, ++all) {
      const double sd = std::sqrt((wxx - 2.0 * c * wx + c * c * w) / det);
      inside += std::fabs(a + b * c - std::log(truth_at(c))) <= z_95 * sd ? 1 : 0;
    }
  }
  return 100.0 * inside / all;
}

struct Prior {
  Property property;
  double s;
};
constexpr Prior priors[] = {{Property::E, 0.08}, {Property::ucs, 0.10}, {Property::brazilian, 0.15}};

TEST(Statistics, IntervalsHoldTheTruthAsOftenAsTheySayWhereScatterIsDrawnFromThePrior) {
  for (const auto& [property, s] : priors)
    for (const int n : {1, 2, 3, 5}) {
      const double one = coverage_of_means(property, 1, n, s, true),
                   seven = coverage_of_means(property, 7, n, s, true),
                   fit = coverage_of_fit(property, n, s, true);
      std::printf("%s, n = %d: %.1f %% (one cell), %.1f %% (seven), fit %.1f %%\n", to_string(property), n,
                  one, seven, fit);
      for (const double percent : {one, seven, fit}) {
        EXPECT_GE(percent, 92.0) << to_string(property) << " n = " << n;
        EXPECT_LE(percent, 98.0) << to_string(property) << " n = " << n;
      }
    }
}

TEST(Statistics, AtAFixedScatterThreeSpecimensAreEnough) {
  for (const Property property : {Property::E, Property::ucs, Property::brazilian})
    for (const double cv : {0.02, 0.05, 0.10, 0.15})
      for (const int n : {3, 5}) {
        const double one = coverage_of_means(property, 1, n, cv, false),
                     seven = coverage_of_means(property, 7, n, cv, false),
                     fit = coverage_of_fit(property, n, cv, false);
        std::printf("%s, CV %.0f %%, n = %d: %.1f %% (one cell), %.1f %% (seven), fit %.1f %%\n",
                    to_string(property), 100.0 * cv, n, one, seven, fit);
        for (const double percent : {one, seven, fit})
          EXPECT_GE(percent, 85.0) << to_string(property) << " " << cv;
      }
}

/// A row of the verification: packings of a model that is the rock itself but for `miss`.
Comparison unseen(const Target& target, double truth, double miss, double packing_scatter, std::uint32_t k,
                  std::size_t n_packings) {
  std::vector<double> values;
  for (std::uint32_t packing = 0; packing < n_packings; ++packing)
    values.push_back(truth * (1.0 + miss) *
                     (1.0 + packing_scatter * normal(9, Stream::test, k, packing,
                                                     static_cast<std::uint32_t>(target.theta))));
  Comparison c;
  const Summary s = summarise(values);
  c.target = target, c.mean = s.mean, c.sd = s.sd, c.n_packings = static_cast<int>(n_packings);
  return c;
}

/// Percent of tables of UCS at seven angles with each verdict; the model misses UCS(45) by `miss`.
struct Shares {
  double calibrated = 0.0, except = 0.0, not_resolved = 0.0, out_of_reach = 0.0;
};
Shares verdicts(int n, double cv, double miss, double packing_scatter) {
  Shares shares;
  for (std::uint32_t k = 0; k < n_tables; ++k) {
    const Rock rock = table(k, Property::ucs, 7, n, cv);
    const std::vector<Target> targets = targets_of(rock);
    Results r;
    for (std::size_t n_packings = first_packings;; n_packings += first_packings) {  // as a calibration does
      r.verification.clear();
      for (int cell = 0; cell < 7; ++cell)
        r.verification.push_back(unseen(targets[static_cast<std::size_t>(cell)], truth_at(cell),
                                        cell == 3 ? miss : 0.0, packing_scatter, k, n_packings));
      if (!wants_packings(r.verification) || n_packings == most_packings) break;
    }
    const VerdictStatus status = judge(r).status;
    double* const share[] = {&shares.calibrated, &shares.except, &shares.not_resolved, &shares.out_of_reach};
    *share[static_cast<int>(status)] += 100.0 / n_tables;
  }
  return shares;
}

void print(const char* what, int n, const Shares& s) {
  std::printf("n = %d, %s: calibrated %.1f, except %.1f, not resolved %.1f, out of reach %.1f %%\n", n, what,
              s.calibrated, s.except, s.not_resolved, s.out_of_reach);
}

TEST(Statistics, AModelThatIsTheRockIsCalibratedAndOneThatMissesAStrengthIsNot) {
  for (const double packing_scatter : {0.0, 0.03, 0.05, 0.08})
    for (const int n : {1, 2, 3, 5}) {
      std::printf("scatter of packings %.0f %%, ", 100.0 * packing_scatter);
      print("no miss", n, verdicts(n, 0.05, 0.0, packing_scatter));
      print("miss of 15 %", n, verdicts(n, 0.05, 0.15, packing_scatter));
    }
  for (const double packing_scatter : {0.0, 0.03, 0.05, 0.08})
    EXPECT_GE(verdicts(3, 0.05, 0.0, packing_scatter).calibrated, 90.0);
  for (const double packing_scatter : {0.0, 0.03, 0.05})
    EXPECT_LE(verdicts(3, 0.05, 0.15, packing_scatter).calibrated, 5.0);
}

}  // namespace
}  // namespace phy::verdict
