#include "report/baselines.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angle_process.hpp"
#include "base/least_squares.hpp"
#include "base/nan.hpp"
#include "report/words.hpp"
#include "theory/jaeger_fit.hpp"

namespace phy::report {
namespace {

using Known = std::span<const Target* const>;

/// The straight line between the neighbours; NaN at the ends.
double line(Known others, const Target& cell) {
  const Target *below = nullptr, *above = nullptr;
  for (const Target* t : others) {
    if (t->theta < cell.theta && (below == nullptr || t->theta > below->theta)) below = t;
    if (t->theta > cell.theta && (above == nullptr || t->theta < above->theta)) above = t;
  }
  if (below == nullptr || above == nullptr) return nan;
  return std::lerp(below->mean, above->mean, (cell.theta - below->theta) / (above->theta - below->theta));
}

/// The sum of terms(theta) that fits the others best.
template <class Terms>
double sum_of(Known others, const Target& cell, const Terms& terms) {
  const Eigen::VectorXd here = terms(cell.theta);
  Eigen::MatrixXd all(static_cast<Eigen::Index>(others.size()), here.size());
  Eigen::VectorXd values(all.rows());
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    const Target& t = *others[static_cast<std::size_t>(i)];
    all.row(i) = terms(t.theta).transpose(), values[i] = t.mean;
  }
  const LinearFit fit = linear_least_squares(all, values);
  // Fewer distinct angles than terms leave the curve open, and any value would be as good.
  return fit.rank == here.size() ? here.dot(fit.x) : nan;
}

double parabola(Known others, const Target& cell) {
  return sum_of(others, cell, [](double theta) {
    const double x = theta / 90.0;  // in quarters of a turn
    return Eigen::Vector3d(1.0, x, x * x);
  });
}

// Even periods alone: rock is the same after half a turn, and mirrored at the layers.
double cosine(double theta, int times) { return std::cos(times * theta * std::numbers::pi / 180.0); }

double one_cosine(Known others, const Target& cell) {
  return sum_of(others, cell, [](double theta) { return Eigen::Vector2d(1.0, cosine(theta, 2)); });
}

double two_cosines(Known others, const Target& cell) {
  return sum_of(others, cell,
                [](double theta) { return Eigen::Vector3d(1.0, cosine(theta, 2), cosine(theta, 4)); });
}

double jaeger(Known others, const Target& cell) {
  // Jaeger's plane is a law of strength in compression; E and tension have no such curve.
  if (cell.property != Property::ucs) return nan;
  std::vector<theory::StrengthReading> readings;
  for (const Target* t : others) readings.push_back({t->theta, t->mean});
  const theory::JaegerFit fit = theory::fit_jaeger_and_matrix(readings);
  return fit.ok ? theory::jaeger_sigma_1(fit.plane, fit.matrix_ucs, cell.theta, 0.0) : nan;
}

/// Kriging of the logarithms about their mean.
double gaussian_process(Known others, const Target& cell) {
  constexpr double usual_size = 0.3;  // strengths of layered rock differ over the angles by a factor of two
  std::vector<AngleCell> cells;
  double mean = 0.0;
  for (const Target* t : others) {
    // The logarithm of a zero would take the whole curve along.
    if (!(t->mean > 0.0)) return nan;
    // To first order the error of a logarithm is the relative error.
    const double relative = t->normal_error() / t->mean;
    cells.push_back({{t->theta, 0.0}, std::log(t->mean), relative * relative, 0.0});
    mean += cells.back().value / static_cast<double>(others.size());
  }
  // The process returns to zero far from its cells: that must be the mean, not a strength of 1 Pa.
  for (AngleCell& c : cells) c.value -= mean;
  return std::exp(mean + AngleProcess(cells, usual_size).at({cell.theta, 0.0}).mean);
}

double rms(const std::vector<Comparison>& rows, Property property) {
  double squares = 0.0;
  int n = 0;
  for (const Comparison& c : rows)
    if (c.target.property == property) {
      // Relative, or absolute for nu: as the tolerances of the property are.
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
    // At the ends of a table every curve would extrapolate; the model need not, and would win unfairly.
    if (std::isfinite(interpolated(table, c.target))) some.push_back(c);
  return some;
}

std::vector<Comparison> with_discrepancies(std::vector<Comparison> rows) {
  for (Comparison& c : rows) c.mean = c.with_discrepancy;
  return rows;
}

std::vector<Comparison> by_curve(const Baseline& curve, std::vector<Comparison> cells,
                                 const std::vector<Comparison>& table) {
  for (Comparison& c : cells) c.mean = curve.predict(table, c.target);
  return cells;
}

bool any_known(const ErrorRow& row) {
  return std::any_of(row.rms.begin(), row.rms.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

const std::vector<Baseline>& baselines() {
  static const std::vector<Baseline> list = {{"interpolated", "straight line", 2, line},
                                             {"parabola", "parabola", 3, parabola},
                                             {"cos_2", "a + b cos 2 theta", 2, one_cosine},
                                             {"cos_4", "a + b cos 2 theta + c cos 4 theta", 3, two_cosines},
                                             {"jaeger", "weak plane", 4, jaeger},
                                             {"gaussian_process", "Gaussian process", 3, gaussian_process}};
  return list;
}

double Baseline::predict(const std::vector<Comparison>& rows, const Target& cell) const {
  std::vector<const Target*> others;
  for (const Comparison& c : rows)
    // Replicates at the same angle would give the answer away.
    if (same_test(c.target, cell) && c.target.theta != cell.theta) others.push_back(&c.target);
  return others.size() < fewest ? nan : curve(others, cell);
}

std::vector<ErrorRow> error_rows(const Calibration& c) {
  std::vector<ErrorRow> rows = {row_for("packings of the fit", c.fitted)};
  if (!c.verification.empty())
    rows.push_back(
        row_for(fmt::format("{} unseen packings", c.verification.front().n_packings), c.verification));
  const std::vector<Comparison> table = inside(c.fitted, c.fitted), ours = inside(c.left_out, c.fitted);
  // Of fewer than three angles none lies between others.
  if (table.empty()) return rows;
  const auto add = [&](const std::string& of, const std::vector<Comparison>& cells, const char* baseline) {
    ErrorRow row = row_for("left out, " + of, cells);
    row.is_left_out = true, row.baseline = baseline;
    // A curve with too few angles would be a row of dashes.
    if (any_known(row)) rows.push_back(row);
  };
  add("model alone", ours, ""), add("model with discrepancy", with_discrepancies(ours), "");
  for (const Baseline& y : baselines()) add(y.name, by_curve(y, table, c.fitted), y.key);
  return rows;
}

std::vector<LeftOutErrors> left_out_errors(const Calibration& c) {
  std::vector<LeftOutErrors> all;
  const std::vector<Comparison> ours = inside(c.left_out, c.fitted), corrected = with_discrepancies(ours);
  for (const MeasuredProperty& p : measured_properties()) {
    LeftOutErrors e;
    e.property = p.property, e.model = rms(ours, p.property);
    e.with_discrepancy = rms(corrected, p.property);
    e.cells = static_cast<int>(std::count_if(
        ours.begin(), ours.end(), [&](const Comparison& row) { return row.target.property == p.property; }));
    if (e.cells == 0) continue;
    for (const Baseline& y : baselines())
      if (const double error = rms(by_curve(y, ours, c.fitted), p.property);
          // The best of all curves after the fact: a harder yardstick than any that one would choose before.
          error < e.curve || (std::isnan(e.curve) && std::isfinite(error)))
        e.best = &y, e.curve = error;
    all.push_back(e);
  }
  return all;
}

std::string sentence(const LeftOutErrors& e) {
  // The model with its discrepancy is what is recommended for new angles, so it is what is judged.
  const double ours = std::isfinite(e.with_discrepancy) ? e.with_discrepancy : e.model;
  if (!std::isfinite(ours)) return "";
  std::string text = fmt::format("Left out one at a time, {} of {} {} predicted within {} (rms)",
                                 counted_text(static_cast<double>(e.cells), "value"), to_string(e.property),
                                 e.cells == 1 ? "is" : "are", miss_text(e.property, ours));
  text += std::isfinite(e.with_discrepancy)
              ? fmt::format(" by the model with its discrepancy, {} by the model alone.",
                            miss_text(e.property, e.model))
              : ".";
  if (e.best == nullptr) return text + " The table has too few angles for a curve.";
  return text + fmt::format(" The best curve, {}, has {}.{}", e.best->name, miss_text(e.property, e.curve),
                            ours > e.curve ? " Between the angles of this table, take the curve." : "");
}

}  // namespace phy::report
