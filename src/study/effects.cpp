#include "study/effects.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "analysis/analyse.hpp"
#include "base/least_squares.hpp"
#include "base/nan.hpp"
#include "records/jointed.hpp"
#include "records/specimen_record.hpp"

namespace phy::study {
namespace {

/// Place of a run's packing and bond seed among the replicates.
std::size_t replicate_of(const Plan& plan, const Run& run) {
  const auto place = [](const std::vector<std::int64_t>& seeds, std::int64_t seed) {
    return static_cast<std::size_t>(std::find(seeds.begin(), seeds.end(), seed) - seeds.begin());
  };
  return place(plan.study.packings, run.packing) * plan.study.bond_seeds.size() +
         place(plan.study.bond_seeds, run.bond_seed);
}

const Number* number_of(const StudyRows& rows, const Run& run, const std::string& name) {
  // Without an answer (not peaked, untrusted, interrupted) there is no number to count.
  const auto& row = rows[run.test];
  const bool counts = row && has_answer(row->result.outcome.status);
  return counts ? analysis::find(row->result.numbers, name) : nullptr;
}

std::string name_of(const Recipe& single) {
  return layered(single) ? specimen_name(inclination(single)) : "intact";
}

std::vector<std::vector<double>> no_values(const Plan& plan) {
  return {n_replicates(plan.study), std::vector<double>(plan.points.size(), nan)};
}

/// Collects one kind of number over the replicates.
class Collected {
 public:
  void add(const std::string& name, const std::string& unit, double value) {
    for (auto& [known, of, values] : all_)
      // A handful of names, looked up a few times per replicate.
      if (known == name) return values.push_back(value);
    // In the order in which names first appear, which becomes the order of columns; a map would sort them.
    all_.push_back({name, unit, {value}});
  }
  std::vector<Effect> effects() const {
    std::vector<Effect> out;
    for (const auto& [name, unit, values] : all_) {
      std::vector<double> finite;
      // A replicate without a result (NaN) makes the sample smaller, not the mean NaN.
      std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
                   [](double v) { return std::isfinite(v); });
      out.push_back({name, unit, summarise(finite)});
    }
    return out;
  }

 private:
  struct Entry {
    std::string name, unit;
    std::vector<double> values;
  };
  std::vector<Entry> all_;
};

double range_of(const Plan& plan, std::size_t factor) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Point& p : plan.points)
    low = std::min(low, p.values[factor]), high = std::max(high, p.values[factor]);
  return high - low;
}

/// A line through the values `y` of one replicate by point.
LineFit curve_line(const Plan& plan, const std::vector<double>& y, const std::vector<std::size_t>& points,
                   std::size_t factor) {
  std::vector<double> x, finite;
  for (const std::size_t p : points)
    // Points without a result are left out: the line is through the others.
    if (std::isfinite(y[p])) x.push_back(plan.points[p].values[factor]), finite.push_back(y[p]);
  return fit_line(x, finite);
}

void add_line(Collected& all, const LineFit& line, const std::string& unit, const std::string& slope_unit) {
  all.add("slope", slope_unit, line.slope), all.add("slope se", slope_unit, line.slope_se);
  all.add("intercept", unit, line.intercept), all.add("intercept se", unit, line.intercept_se);
  all.add("R2", "1", line.R2);
}

/// The moduli of one point on one replicate.
struct Readings {
  std::vector<theory::ModulusReading> layered;
  double intact = nan, spacing = nan;
  bool whole = true;
};

/// By replicate and point.
std::map<std::pair<std::size_t, std::size_t>, Readings> readings_of(const Plan& plan, const StudyRows& rows,
                                                                    const std::string& modulus) {
  std::map<std::pair<std::size_t, std::size_t>, Readings> all;
  for (const Run& run : plan.runs) {
    Readings& r = all[{replicate_of(plan, run), run.point}];
    const Number* n = number_of(rows, run, modulus);
    const Recipe& recipe = plan.tests[run.test].recipe;
    const double E = n != nullptr ? n->value : nan;
    // One intact specimen serves as the reference E of all angles of its point.
    if (!layered(recipe)) {
      r.intact = E;
      continue;
    }
    if (!jointed_isotropic(recipe)) continue;
    // Eq. 1 is fitted to complete sets only: with angles missing, replicates could not be compared.
    r.whole = r.whole && std::isfinite(E);
    // Dispersed joints have no spacing, and no K_n and K_s per area.
    if (recipe.bedding.front().has_planes()) r.spacing = recipe.bedding.front().spacing;
    r.layered.push_back({recipe.bedding.front().theta, E});
  }
  return all;
}

}  // namespace

Summary Response::at(std::size_t point) const {
  std::vector<double> finite;
  for (const auto& replicate : values)
    if (std::isfinite(replicate[point])) finite.push_back(replicate[point]);
  return summarise(finite);
}

std::vector<Response> responses(const Plan& plan, const StudyRows& rows, const std::string& number) {
  std::vector<Response> all;
  for (const Run& run : plan.runs) {
    const Number* n = number_of(rows, run, number);
    const std::string specimen = name_of(plan.tests[run.test].recipe);
    // Angles are told apart by the specimen's name.
    auto r = std::find_if(all.begin(), all.end(), [&](const Response& x) { return x.specimen == specimen; });
    if (r == all.end()) r = all.insert(r, {number, "", specimen, no_values(plan)});
    if (n == nullptr) continue;
    r->unit = n->unit;
    r->values[replicate_of(plan, run)][run.point] = n->value;
  }
  // No unit: no test has given this number.
  std::erase_if(all, [](const Response& r) { return r.unit.empty(); });
  return all;
}

JointFits fit_joints(const Plan& plan, const StudyRows& rows, const MacroReading& reading) {
  JointFits fits;
  fits.fits.assign(n_replicates(plan.study), std::vector<std::optional<theory::Eq1Fit>>(plan.points.size()));
  fits.K_n = {"K_n", "Pa/m", "all angles", no_values(plan)};
  fits.K_s = {"K_s", "Pa/m", "all angles", no_values(plan)};
  fits.R2 = {"R2_eq1", "1", "all angles", no_values(plan)};
  for (const auto& [place, r] : readings_of(plan, rows, reading.modulus)) {
    const bool has_reference = reading.reference != theory::Eq1Reference::given || std::isfinite(r.intact);
    // With the intact rock as reference its modulus has to be there; other references need none.
    if (!r.whole || r.layered.empty() || !has_reference) continue;
    const theory::Eq1Fit fit =
        theory::fit_eq1(r.layered, {theory::Eq1Loss::compliance, reading.reference, r.intact});
    fits.fits[place.first][place.second] = fit;
    if (!fit.ok()) continue;
    // Theory gives K times the spacing of the planes, [Pa/m] times [m].
    fits.K_n.values[place.first][place.second] = fit.rock.K_n_delta / r.spacing;
    fits.K_s.values[place.first][place.second] = fit.rock.K_s_delta / r.spacing;
    fits.R2.values[place.first][place.second] = fit.R2;
    for (std::size_t i = 0; i < r.layered.size(); ++i) {
      const double theta = r.layered[i].theta;
      // A response per angle, made when the first fit gives it.
      if (i == fits.E.size()) fits.E.push_back({"E_eq1", "Pa", specimen_name(theta), no_values(plan)});
      fits.E[i].values[place.first][place.second] = theory::goodman_E(fit.rock, theta);
    }
  }
  return fits;
}

std::vector<std::size_t> curve_points(const Plan& plan, std::size_t factor) {
  std::vector<std::size_t> points;
  for (std::size_t p = 0; p < plan.points.size(); ++p)
    // The base (moved < 0) belongs to the curve of every parameter.
    if (plan.points[p].moved < 0 || plan.points[p].moved == static_cast<int>(factor)) points.push_back(p);
  std::stable_sort(points.begin(), points.end(), [&](std::size_t a, std::size_t b) {
    return plan.points[a].values[factor] < plan.points[b].values[factor];
  });
  return points;
}

std::vector<Effect> effects_of(const Plan& plan, const Response& response, std::size_t factor) {
  const RecipeKey& key = plan.study.vary[factor].key;
  const std::string slope_unit = response.unit + " per " + key.unit();
  Collected all;
  // Each replicate gives its own effect; the scatter of the effects is then their uncertainty.
  for (const std::vector<double>& y : response.values) {
    if (plan.study.design == Design::one_at_a_time) {
      const std::vector<std::size_t> points = curve_points(plan, factor);
      add_line(all, curve_line(plan, y, points, factor), response.unit, slope_unit);
      // Relative change from the lowest to the highest level.
      all.add("change", "1", y[points.back()] / y[points.front()] - 1.0);
    } else if (plan.study.design == Design::morris) {
      const ElementaryEffect e = elementary_effects(plan.points, y)[factor];
      all.add("mu", response.unit, e.mu), all.add("mu_star", response.unit, e.mu_star);
      all.add("sigma", response.unit, e.sigma);
    } else if (plan.study.design == Design::saltelli) {
      const VarianceIndex v = variance_indices(plan.study.vary.size(), y)[factor];
      all.add("S_first", "1", v.first), all.add("S_total", "1", v.total);
    } else {
      const PlaneFit fit = fit_plane(plan.points, y);
      all.add("slope", slope_unit, fit.slope[factor]), all.add("slope se", slope_unit, fit.se[factor]);
      all.add("slope x range", response.unit, fit.slope[factor] * range_of(plan, factor));
      all.add("R2", "1", fit.R2);
    }
  }
  return all.effects();
}

std::vector<Effect> beside_regressions(const Plan& plan, const Response& response, std::size_t factor,
                                       const std::vector<Effect>& effects) {
  std::vector<Effect> beside;
  for (const Regression& line : plan.study.regressions) {
    // Compared only where number, key and unit are the same.
    if (line.number != response.number || line.key != plan.study.vary[factor].key.field->path() ||
        line.unit != response.unit)
      continue;
    for (const Effect& e : effects) {
      Summary s = e.value;
      if (e.name == "slope") {
        // Relative to the published slope; sd and interval stay positive.
        s.mean /= line.slope, s.sd /= std::fabs(line.slope), s.half_width /= std::fabs(line.slope);
        beside.push_back({"slope over that of " + line.source, "1", s});
      } else if (e.name == "intercept") {
        s.mean -= line.intercept;
        beside.push_back({"intercept less that of " + line.source, response.unit, s});
      }
    }
  }
  return beside;
}

PlaneFit fit_plane(const std::vector<Point>& points, const std::vector<double>& y) {
  PlaneFit fit;
  const std::size_t k = points.empty() ? 0 : points.front().values.size();
  fit.slope.assign(k, nan), fit.se.assign(k, nan), fit.R2 = nan;
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::isfinite(y[i])) used.push_back(i);
  fit.n = used.size();
  const auto n = static_cast<Eigen::Index>(used.size()), m = static_cast<Eigen::Index>(k);
  // Slopes, mean and at least one degree of freedom for the residual.
  if (n < m + 2) return fit;
  Eigen::MatrixXd X(n, m);
  Eigen::VectorXd Y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    Y(i) = y[used[static_cast<std::size_t>(i)]];
    for (Eigen::Index j = 0; j < m; ++j)
      X(i, j) = points[used[static_cast<std::size_t>(i)]].values[static_cast<std::size_t>(j)];
  }
  // About the mean, which takes the intercept out of the system.
  Y.array() -= Y.mean();
  X.rowwise() -= X.colwise().mean().eval();
  const Eigen::VectorXd scale = X.colwise().norm();  // keys differ by twelve orders of magnitude
  if (!(scale.minCoeff() > 0.0)) return fit;
  X = X * scale.cwiseInverse().asDiagonal();
  const auto [b, rank] = linear_least_squares(X, Y);
  // Parameters that move together cannot be separated: no slopes rather than arbitrary ones.
  if (rank < m) return fit;
  const Eigen::VectorXd residual = Y - X * b;
  fit.R2 = Y.squaredNorm() > 0.0 ? 1.0 - residual.squaredNorm() / Y.squaredNorm() : 1.0;
  // Standard errors of least squares: s^2 (X^T X)^-1, scaled back to the units of the keys.
  const double s2 = residual.squaredNorm() / static_cast<double>(n - m - 1);
  const Eigen::MatrixXd inverse = inverse_of_squares(X);
  for (Eigen::Index j = 0; j < m; ++j) {
    fit.slope[static_cast<std::size_t>(j)] = b(j) / scale(j);
    fit.se[static_cast<std::size_t>(j)] = std::sqrt(s2 * inverse(j, j)) / scale(j);
  }
  return fit;
}

std::vector<ElementaryEffect> elementary_effects(const std::vector<Point>& points,
                                                 const std::vector<double>& y) {
  std::vector<std::vector<double>> effects(points.empty() ? 0 : points.front().values.size());
  for (std::size_t i = 1; i < points.size(); ++i) {
    // moved < 0 begins a new walk; differences are taken within a walk only.
    if (points[i].moved < 0 || !std::isfinite(y[i]) || !std::isfinite(y[i - 1])) continue;
    const auto k = static_cast<std::size_t>(points[i].moved);
    // By the direction of the step, or walks up and walks down would cancel.
    const double sign = points[i].values[k] > points[i - 1].values[k] ? 1.0 : -1.0;
    effects[k].push_back(sign * (y[i] - y[i - 1]) / morris_step);
  }
  std::vector<ElementaryEffect> all;
  for (std::vector<double>& e : effects) {
    // mu* is the mean of magnitudes: effects of opposite sign do not cancel.
    const Summary with_sign = summarise(e);
    for (double& v : e) v = std::abs(v);
    all.push_back({with_sign.mean, summarise(e).mean, with_sign.sd, e.size()});
  }
  return all;
}

std::vector<VarianceIndex> variance_indices(std::size_t k, const std::vector<double>& y) {
  // Blocks are A, k mixed points, B (design.cpp); an incomplete one would bias the sums.
  std::vector<std::size_t> blocks;
  for (std::size_t b = 0; b + k + 2 <= y.size(); b += k + 2)
    if (std::all_of(y.begin() + static_cast<std::ptrdiff_t>(b),
                    y.begin() + static_cast<std::ptrdiff_t>(b + k + 2),
                    [](double v) { return std::isfinite(v); }))
      blocks.push_back(b);
  std::vector<double> outer;  // A and B: independent points
  for (const std::size_t b : blocks) outer.push_back(y[b]), outer.push_back(y[b + k + 1]);
  // Subtracting the mean lowers the noise of the products below; differences are not affected.
  const Summary s = summarise(outer);
  std::vector<VarianceIndex> all(k, {nan, nan, blocks.size()});
  if (blocks.size() < 2 || !(s.sd > 0.0)) return all;
  const double variance = s.sd * s.sd, n = static_cast<double>(blocks.size());
  for (std::size_t i = 0; i < k; ++i) {
    double first = 0.0, total = 0.0;
    for (const std::size_t b : blocks) {
      // First order by Saltelli et al. (2010), total by Jansen (1999).
      const double A = y[b] - s.mean, B = y[b + k + 1] - s.mean, mixed = y[b + 1 + i] - s.mean;
      first += B * (mixed - A) / n;
      total += 0.5 * (A - mixed) * (A - mixed) / n;
    }
    all[i].first = first / variance, all[i].total = total / variance;
  }
  return all;
}

}  // namespace phy::study
