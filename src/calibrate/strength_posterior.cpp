#include "calibrate/strength_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/exact_math.hpp"
#include "calibrate/ensemble.hpp"
#include "calibrate/experience.hpp"

namespace phy {

using Eigen::VectorXd;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int n_starts = 2048, n_walkers = 64, n_sweeps = 600, thin = 15;
constexpr double usual_ratio = 2.2;  // largest UCS over sigma_c

VectorXd mean_of(const std::vector<VectorXd>& points) {
  VectorXd mean = VectorXd::Zero(points.front().size());
  for (const VectorXd& p : points) mean += p / static_cast<double>(points.size());
  return mean;
}

}  // namespace

StrengthPosterior::StrengthPosterior(const Rock& rock, const Recipe& recipe,
                                     const std::vector<Target>& targets)
    : runs_(targets.size()), targets_(targets) {
  for (const Parameter& p : strength_parameters())
    if (!p.joint || rock.bedded) parameters_.push_back(&p);
  for (const Target& t : targets) {
    largest_ = std::max(largest_, t.mean);
    foretold_.push_back(foretold_strength(recipe, t.property, t.theta));
  }
  least_ = VectorXd::Constant(n_ratios(), -1.0);
  if (!rock.bedded) return;
  const Parameter& mu = *parameters_.back();
  const double rubs = std::max(mu.low, tan_degrees(recipe.bedding.front().psi) * (1.0 + 1e-9));
  least_[n_ratios() - 1] = 2.0 * std::log(rubs / mu.low) / std::log(mu.high / mu.low) - 1.0;
}

std::size_t StrengthPosterior::n_tension() const {
  return targets_.size() - of_property(targets_, Property::ucs).size();
}
double StrengthPosterior::box_low(std::size_t i) const {
  return std::log(parameter(i).low * (i == 0 ? largest_ : 1.0));
}
double StrengthPosterior::box_high(std::size_t i) const {
  return std::log(parameter(i).high * (i == 0 ? largest_ : 1.0));
}

VectorXd StrengthPosterior::middle_of_box() const {
  VectorXd x = VectorXd::Zero(n_ratios() + 1);
  x[0] = std::log(largest_ / usual_ratio);
  return x;
}

double StrengthPosterior::log_value(const VectorXd& x, std::size_t i) const {
  if (i == 0) return x[0];
  return box_low(i) + 0.5 * (x[static_cast<Eigen::Index>(i)] + 1.0) * (box_high(i) - box_low(i));
}

Recipe StrengthPosterior::recipe_at(Recipe recipe, const VectorXd& x) const {
  for (std::size_t i = 0; i < parameters_.size(); ++i) parameter(i).set(recipe, std::exp(log_value(x, i)));
  return recipe;
}

bool StrengthPosterior::has_runs() const {
  return std::all_of(runs_.begin(), runs_.end(), [](const auto& r) { return !r.empty(); });
}

void StrengthPosterior::learn() {
  models_.clear();
  discrepancy_ = 0.0;
  for (std::size_t i = 0; i < runs_.size(); ++i) models_.emplace_back(runs_[i], foretold_[i]);
}

Surrogate::Value StrengthPosterior::predict(const VectorXd& x, std::size_t target) const {
  Surrogate::Value v = models_[target].at(x.tail(n_ratios()));
  v.mean += x[0];
  return v;
}

double StrengthPosterior::variance(const Target& t) {
  const double relative = t.standard_error() / t.mean;
  return relative * relative;
}

double StrengthPosterior::log_density(const VectorXd& x, std::size_t left_out) const {
  const auto z = x.tail(n_ratios());
  if (x[0] < box_low(0) || x[0] > box_high(0) || z.maxCoeff() > 1.0 || (z - least_).minCoeff() < 0.0)
    return -infinity;
  double sum = 0.0;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (i == left_out) continue;
    const Surrogate::Value model = predict(x, i);
    const double error = std::log(targets_[i].mean) - model.mean,
                 v = model.variance + variance(targets_[i]) + discrepancy_;
    sum -= 0.5 * (error * error / v + std::log(v));
  }
  return sum;
}

bool StrengthPosterior::find_discrepancy(const std::vector<VectorXd>& draws) {
  double least = infinity;
  for (const VectorXd& x : draws) {
    double expected = 0.0, beyond = 0.0;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const Surrogate::Value model = predict(x, i);
      const double error = std::log(targets_[i].mean) - model.mean;
      expected += error * error + model.variance;
      beyond += error * error - model.variance - variance(targets_[i]);
    }
    if (expected < least)
      least = expected, discrepancy_ = std::max(0.0, beyond / static_cast<double>(targets_.size()));
  }
  return discrepancy_ > 0.0;
}

std::vector<VectorXd> StrengthPosterior::draws(std::size_t left_out, std::uint32_t seed) const {
  struct Start {
    double log_p;
    VectorXd x;
  };
  std::vector<Start> starts;
  for (VectorXd& x : spread_points(n_starts)) {
    x[0] = best_sigma(x, left_out);
    starts.push_back({log_density(x, left_out), x});
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.log_p > b.log_p; });
  std::vector<VectorXd> walkers;
  for (int i = 0; i < n_walkers; ++i) walkers.push_back(starts[static_cast<std::size_t>(i)].x);
  return sample([&](const VectorXd& x) { return log_density(x, left_out); }, std::move(walkers), n_sweeps,
                thin, seed);
}

/// Points that fill the box evenly: the additive recurrence of Roberts (2018) with powers of the
/// generalised golden ratio.
std::vector<VectorXd> StrengthPosterior::spread_points(int n) const {
  const auto d = static_cast<double>(n_ratios());
  double phi = 2.0;
  for (int i = 0; i < 60; ++i) phi = std::pow(1.0 + phi, 1.0 / (d + 1.0));
  std::vector<VectorXd> points;
  for (int i = 0; i < n; ++i) {
    VectorXd x = VectorXd::Zero(n_ratios() + 1);
    for (Eigen::Index j = 1; j <= n_ratios(); ++j) {
      const double u = 0.5 + (i + 1) / std::pow(phi, static_cast<double>(j));
      x[j] = 2.0 * (u - std::floor(u)) - 1.0;
    }
    points.push_back(x);
  }
  return points;
}

/// sigma_c that fits best with the ratios of a point.
double StrengthPosterior::best_sigma(const VectorXd& x, std::size_t left_out) const {
  double weight = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (i == left_out) continue;
    const Surrogate::Value f = models_[i].at(x.tail(n_ratios()));
    const double w = 1.0 / (f.variance + variance(targets_[i]) + discrepancy_);
    weight += w, sum += w * (std::log(targets_[i].mean) - f.mean);
  }
  return std::clamp(sum / weight, box_low(0) + 1e-6, box_high(0) - 1e-6);
}

std::size_t middle(const StrengthPosterior& posterior, const std::vector<VectorXd>& draws) {
  std::vector<VectorXd> seen;
  std::vector<double> misfit;
  for (const VectorXd& x : draws) {
    VectorXd y(static_cast<Eigen::Index>(posterior.n_targets()) + x.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < posterior.n_targets(); ++i) {
      const Target& t = posterior.targets()[i];
      const Surrogate::Value v = posterior.predict(x, i);
      const double lab = StrengthPosterior::variance(t), error = std::log(t.mean) - v.mean;
      y[static_cast<Eigen::Index>(i)] = v.mean / std::sqrt(lab);
      sum += (v.variance + error * error) / lab;
    }
    misfit.push_back(sum);
    y.tail(x.size()) = x;
    seen.push_back(y);
  }
  const VectorXd centre = mean_of(seen);
  const auto distance = [&](std::size_t i) { return (seen[i] - centre).squaredNorm() + misfit[i]; };
  std::size_t best = 0;
  for (std::size_t i = 1; i < seen.size(); ++i)
    if (distance(i) < distance(best)) best = i;
  return best;
}

std::vector<VectorXd> spread_draws(const StrengthPosterior& posterior, const std::vector<VectorXd>& draws,
                                   std::size_t n) {
  std::vector<VectorXd> chosen = {draws[middle(posterior, draws)]};
  const auto d = posterior.n_ratios();
  while (chosen.size() < n) {
    double furthest = -1.0;
    const VectorXd* next = &draws.front();
    for (const VectorXd& x : draws) {
      double nearest = infinity;
      for (const VectorXd& c : chosen) nearest = std::min(nearest, (x.tail(d) - c.tail(d)).squaredNorm());
      if (nearest > furthest) furthest = nearest, next = &x;
    }
    chosen.push_back(*next);
  }
  return chosen;
}

}  // namespace phy
