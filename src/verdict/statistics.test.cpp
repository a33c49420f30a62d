// What is said of thousands of tables whose rock is known: means of specimens with normal scatter, no press.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/rng.hpp"
#include "base/stats.hpp"
#include "verdict/cells.hpp"
#include "verdict/judge.hpp"

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

// ---- verdicts of whole tables

/// A rock at seven angles, as its specimens and a model's packings are drawn: every value one at a time.
struct DrawnTable {
  std::uint32_t k;
  int n;
  double cv;
  double miss = 0.0;  ///< of the model's UCS at 45 degrees

  static double truth(Property p, int cell) {
    return p == Property::E ? 30e9 + 2e9 * cell : p == Property::nu ? 0.2 + 0.01 * cell : truth_at(cell);
  }
  double drawn(std::uint32_t what, Property p, int cell, int i) const {
    return normal(what, Stream::test, k,
                  100U * static_cast<std::uint32_t>(p) + static_cast<std::uint32_t>(cell),
                  static_cast<std::uint32_t>(i));
  }
  std::vector<Target> targets() const {
    Rock rock;
    for (const Property p : {Property::E, Property::nu, Property::ucs})
      for (int cell = 0; cell < 7; ++cell)
        for (int i = 0; i < n; ++i) {
          RockReading r;
          r.property = p, r.theta = 15.0 * cell,
          r.value = truth(p, cell) * (1.0 + cv * drawn(17, p, cell, i));
          rock.readings.push_back(r);
        }
    return targets_of(rock);
  }
  /// Ten packings that differ by 3 % in E, 0.02 in nu, 6 % in UCS.
  std::vector<Comparison> unseen() const {
    std::vector<Comparison> rows;
    for (const Target& t : targets()) {
      const int cell = static_cast<int>(std::lround(t.theta / 15.0));
      const double of =
          truth(t.property, cell) * (t.property == Property::ucs && cell == 3 ? 1.0 + miss : 1.0);
      const double scatter = t.property == Property::nu  ? 0.02
                             : t.property == Property::E ? 0.03 * of
                                                         : 0.06 * of;
      std::vector<double> values;
      for (int packing = 0; packing < 10; ++packing)
        values.push_back(of + scatter * drawn(18, t.property, cell, packing));
      const Summary s = summarise(values);
      Comparison c;
      c.target = t, c.mean = s.mean, c.sd = s.sd, c.n_packings = 10;
      rows.push_back(c);
    }
    return rows;
  }
  Verdict verdict() const {
    Results r;
    r.verification = unseen();
    return judge(r);
  }
};

/// Percent of so many tables.
double percent(std::uint32_t n_drawn, double miss,
               const std::function<std::pair<int, double>(std::uint32_t)>& table,
               const std::function<bool(const Verdict&)>& is) {
  int n = 0;
  for (std::uint32_t k = 0; k < n_drawn; ++k) {
    const auto [specimens, cv] = table(k);
    n += is(DrawnTable{k, specimens, cv, miss}.verdict()) ? 1 : 0;
  }
  return 100.0 * n / n_drawn;
}

bool accuses(const Verdict& v) {
  return v.status != VerdictStatus::calibrated && v.status != VerdictStatus::not_decided;
}
bool names_the_miss(const Verdict& v) {
  return std::any_of(v.findings.begin(), v.findings.end(), [](const Finding& f) {
    return f.kind == FindingKind::value_missed && f.cells.front() == Cell{Property::ucs, 45.0};
  });
}

TEST(Statistics, AModelThatIsTheRockIsAccusedInOneTableOfTwentyAtMost) {
  const double mixed = percent(
      2000, 0.0,
      [](std::uint32_t k) {
        return std::pair(3 + static_cast<int>(k % 3), 0.05 + 0.05 * uniform(19, Stream::test, k, 0));
      },
      accuses);
  std::printf("the rock itself, n 3 to 5, scatter 5 to 10 %%: accused %.1f %%\n", mixed);
  EXPECT_LE(mixed, 5.0);
  for (const int n : {1, 3, 5})
    for (const double cv : {0.05, 0.10, 0.20}) {
      const auto table = [&](std::uint32_t) { return std::pair(n, cv); };
      const double accused = percent(300, 0.0, table, accuses);
      const double calibrated =
          percent(300, 0.0, table, [](const Verdict& v) { return v.status == VerdictStatus::calibrated; });
      std::printf("the rock itself, n = %d, scatter %.0f %%: accused %.1f %%, calibrated %.1f %%\n", n,
                  100.0 * cv, accused, calibrated);
      // one specimen a cell states no scatter: nothing shows that it is twice the usual one
      if (n > 1 || cv <= 0.10) {
        EXPECT_LE(accused, 9.0) << "poor data are no reason for alarms";
      }
      if (n == 3 && cv == 0.05) {
        EXPECT_GE(calibrated, 80.0);
      }
      if (cv == 0.20) {
        EXPECT_LE(calibrated, 10.0);
      }
    }
}

TEST(Statistics, AStrengthThatIsFarOffIsNamed) {
  const auto three = [](std::uint32_t) { return std::pair(3, 0.05); };
  const double low = percent(2000, -0.15, three, names_the_miss),
               high = percent(2000, 0.15, three, names_the_miss);
  std::printf("UCS(45) of the model 15 %% low: named %.1f %%; high: %.1f %%\n", low, high);
  EXPECT_GE(low, 90.0);
  EXPECT_GE(high, 80.0);
  EXPECT_GE(percent(300, 0.20, three, names_the_miss), 95.0);
}

/// UCS at four angles, 30 % too high in the model; by the maps so much.
Results strengths_missed(double in_maps) {
  Results r;
  r.reach = {{FindingKind::forecast_out_of_reach}};
  for (const double theta : {0.0, 30.0, 60.0, 90.0}) {
    Comparison c;
    c.target.theta = theta, c.target.property = Property::ucs;
    c.target.mean = 100e6, c.target.sd = 4e6, c.target.n = 4;
    c.mean = 130e6, c.sd = 2e6, c.n_packings = 5;
    r.verification.push_back(c);
    r.reach.push_back({FindingKind::map_expected,
                       {cell_of(c.target)},
                       {{"model", (1.0 + in_maps) * c.target.mean}, {"laboratory", c.target.mean}}});
  }
  return r;
}

TEST(Verdict, OutOfReachIsALimitOfTheModelAndNotOfItsSearch) {
  Results r = strengths_missed(0.02);
  EXPECT_EQ(judge(r).status, VerdictStatus::not_calibrated) << "E alone is out of reach in the maps";
  EXPECT_NE(first_of(judge(r).findings, FindingKind::strengths_missed), nullptr);
  r.search_settled = true;
  EXPECT_EQ(judge(r).status, VerdictStatus::out_of_reach);
  EXPECT_EQ(judge(strengths_missed(0.25)).status, VerdictStatus::out_of_reach) << "whatever the search";
  r = strengths_missed(0.25), r.reach.front().kind = FindingKind::forecast_excepted;
  EXPECT_EQ(judge(r).status, VerdictStatus::not_calibrated) << "the maps know little of such a table";
}

}  // namespace
}  // namespace phy::verdict
