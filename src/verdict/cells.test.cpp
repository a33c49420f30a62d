// Cells judged together, against hand calculations.
#include "verdict/cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace phy::verdict {
namespace {

/// UCS of 100 MPa, n specimens of known scatter; the model off by `miss`, packings alike.
Comparison row(double miss, double sd = 6e6, int n = 4, Property p = Property::ucs) {
  Comparison c;
  c.target = {p, 0.0, 100e6, sd, n, false};
  c.mean = 100e6 * (1.0 + miss), c.n_packings = 5;
  return c;
}
Outcome outcome_of(const std::vector<Comparison>& rows) { return judge_cells(rows).front().outcome; }

// Standard error 3 %: one value alone is missed beyond 1.96 times that, ln(1.061); met below 15 % less 1.64
// times that: ln(1.15) = 0.1398, less 0.0493.
TEST(Cells, OneValueAloneIsJudgedByItsOwnInterval) {
  EXPECT_EQ(outcome_of({row(0.055)}), Outcome::met) << "within the tolerance";
  EXPECT_EQ(outcome_of({row(0.070)}), Outcome::missed);
  EXPECT_EQ(outcome_of({row(0.200, 24e6)}), Outcome::open) << "12 % of standard error";
  EXPECT_NEAR(judge_cells({row(0.05)}).front().bound, std::exp(std::log(1.05) + 1.6449 * 0.03) - 1.0, 1e-4);
  Comparison none = row(0.0);
  none.mean = std::nan("");
  EXPECT_EQ(outcome_of({none}), Outcome::unanswered);
}

// Seven strengths: the largest is compared at 5/7 %, 2.69 standard errors, the next at 5/6 %, 2.64.
TEST(Cells, ManyValuesAskForMoreOfEach) {
  std::vector<Comparison> rows(7, row(0.0));
  rows[0] = row(std::exp(2.68 * 0.03) - 1.0);
  EXPECT_NE(outcome_of(rows), Outcome::missed);
  rows[0] = row(std::exp(2.70 * 0.03) - 1.0);
  EXPECT_EQ(outcome_of(rows), Outcome::missed);
  rows[1] = row(std::exp(2.66 * 0.03) - 1.0);
  EXPECT_EQ(judge_cells(rows)[1].outcome, Outcome::missed) << "a step down";
  rows[0] = row(0.0);
  EXPECT_NE(judge_cells(rows)[1].outcome, Outcome::missed) << "alone it is the largest";
}

// Fourteen moduli take a fifth of the level: 4/7 % are left for each strength, 2.76 standard errors.
TEST(Cells, ModuliDoNotHideAStrength) {
  std::vector<Comparison> rows(7, row(0.0));
  for (int i = 0; i < 14; ++i) rows.push_back(row(0.0, 6e6, 4, Property::E));
  rows[0] = row(std::exp(2.78 * 0.03) - 1.0);
  EXPECT_EQ(outcome_of(rows), Outcome::missed);
  rows[0] = row(std::exp(2.74 * 0.03) - 1.0);
  EXPECT_NE(outcome_of(rows), Outcome::missed);
}

// A third may be missed while half are met; beyond, the table is not met, whatever the rest.
TEST(Cells, ExceptionsAreFew) {
  const auto status = [](int met, int missed, int open) {
    std::vector<JudgedCell> cells;
    const auto add = [&](int n, Outcome outcome) {
      for (int i = 0; i < n; ++i) cells.push_back({row(0.0), outcome});
    };
    add(met, Outcome::met), add(missed, Outcome::missed), add(open, Outcome::open);
    return status_of(cells);
  };
  EXPECT_EQ(status(9, 0, 1), VerdictStatus::calibrated);
  EXPECT_EQ(status(8, 0, 2), VerdictStatus::not_decided);
  EXPECT_EQ(status(2, 1, 0), VerdictStatus::calibrated_except);
  EXPECT_EQ(status(6, 1, 0), VerdictStatus::calibrated_except);
  EXPECT_EQ(status(3, 2, 0), VerdictStatus::not_calibrated);
  EXPECT_EQ(status(1, 1, 3), VerdictStatus::not_calibrated);
  EXPECT_EQ(status(1, 4, 0), VerdictStatus::not_calibrated);
}

TEST(Cells, SpecimensThatAreMissing) {
  // one specimen of 10 %: 16.4 %; of two 11.6 %
  EXPECT_EQ(specimens_missing(judge_cells({row(0.0, 10e6, 1)}).front()), 1);
  EXPECT_EQ(specimens_missing(judge_cells({row(0.16, 24e6)}).front()), std::nullopt) << "15 % may be off";
}

TEST(Cells, TheTablesOwnScatterGoesBeforeTheUsualOne) {
  Comparison c = row(0.10, 20e6);
  EXPECT_EQ(outcome_of({c}), Outcome::open);
  c.target.stated_sd = 4e6, c.target.stated_degrees = 12;
  EXPECT_EQ(outcome_of({c}), Outcome::missed);
}

}  // namespace
}  // namespace phy::verdict
