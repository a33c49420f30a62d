#include "report/baselines.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "base/least_squares.hpp"
#include "base/nan.hpp"
#include "report/words.hpp"
#include "theory/jaeger_fit.hpp"

namespace phy::report {
namespace {

/// The cells of the same test at other angles.
std::vector<const Target*> others(const std::vector<Comparison>& rows, const Target& cell) {
  std::vector<const Target*> some;
  for (const Comparison& c : rows)
    if (same_test(c.target, cell) && c.target.theta != cell.theta) some.push_back(&c.target);
  return some;
}

double parabola(const std::vector<Comparison>& rows, const Target& cell) {
  const std::vector<const Target*> known = others(rows, cell);
  const auto n = static_cast<Eigen::Index>(known.size());
  if (n < 3) return nan;
  Eigen::MatrixXd terms(n, 3);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {  // in quarters of a turn from the cell: its value is the constant
    const Target& t = *known[static_cast<std::size_t>(i)];
    const double x = (t.theta - cell.theta) / 90.0;
    terms.row(i) << 1.0, x, x * x;
    values[i] = t.mean;
  }
  return linear_least_squares(terms, values).x[0];
}

double jaeger(const std::vector<Comparison>& rows, const Target& cell) {
  if (cell.property != Property::ucs) return nan;
  std::vector<theory::StrengthReading> readings;
  for (const Target* t : others(rows, cell)) readings.push_back({t->theta, t->mean});
  const theory::JaegerFit fit = theory::fit_jaeger_and_matrix(readings);
  return fit.ok ? theory::jaeger_sigma_1(fit.plane, fit.matrix_ucs, cell.theta, 0.0) : nan;
}

double rms(const std::vector<Comparison>& rows, Property property) {
  double squares = 0.0;
  int n = 0;
  for (const Comparison& c : rows)
    if (c.target.property == property) {
      const double off = miss(c);
      squares += off * off, ++n;
    }
  return n > 0 ? std::sqrt(squares / n) : nan;
}

ErrorRow row_for(std::string of, const std::vector<Comparison>& rows) {
  ErrorRow row{std::move(of), {}};
  for (int i = 0; i < n_properties; ++i)
    row.rms[static_cast<std::size_t>(i)] = rms(rows, static_cast<Property>(i));
  return row;
}

/// Those with neighbours on both sides.
std::vector<Comparison> inside(const std::vector<Comparison>& rows, const std::vector<Comparison>& table) {
  std::vector<Comparison> some;
  for (const Comparison& c : rows)
    if (std::isfinite(interpolated(table, c.target))) some.push_back(c);
  return some;
}

}  // namespace

const std::vector<Baseline>& baselines() {
  static const std::vector<Baseline> list = {{"interpolated", "straight line", interpolated},
                                             {"parabola", "parabola", parabola},
                                             {"jaeger", "weak plane", jaeger}};
  return list;
}

std::vector<ErrorRow> error_rows(const Calibration& c) {
  std::vector<ErrorRow> rows = {row_for("packings of the fit", c.fitted)};
  if (!c.verification.empty())
    rows.push_back(
        row_for(fmt::format("{} unseen packings", c.verification.front().n_packings), c.verification));
  const std::vector<Comparison> table = inside(c.fitted, c.fitted), ours = inside(c.left_out, c.fitted);
  if (table.empty()) return rows;
  if (!ours.empty()) rows.push_back(row_for("left out, this model", ours)), rows.back().is_left_out = true;
  for (const Baseline& y : baselines()) {
    std::vector<Comparison> predicted = table;
    for (Comparison& p : predicted) p.mean = y.predict(c.fitted, p.target);
    ErrorRow row = row_for(fmt::format("left out, {}", y.name), predicted);
    row.is_left_out = true, row.baseline = y.key;
    if (std::any_of(row.rms.begin(), row.rms.end(), [](double v) { return std::isfinite(v); }))
      rows.push_back(row);
  }
  return rows;
}

}  // namespace phy::report
