#include "calibrate/strength_posterior.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "maps/prior_regression.hpp"
#include "verdict/cells.hpp"

namespace phy::calibrate {

using verdict::tolerance;

namespace {

// The second half of 600 sweeps, every fifteenth of them: 20 states of 64 walkers are 1,280 draws.
constexpr int n_starts = 2048, n_walkers = 64, n_sweeps = 600, thin = 15;
constexpr double usual_ratio = 2.2;  // largest UCS over sigma_c
// What a packing does to one strength in compression, and to another at another angle: the correlation. Over
// 60 packings of 1,197 discs UCS at two of seven angles correlates by 0.15 (zone), 0.20 (crossing), and less
// than half of the variance of single tests is their packing's (surrogate.cpp).
constexpr double common_share = 0.4;
constexpr int most_passes = 2;     // of draws with another discrepancy
constexpr double no_change = 0.3;  // change of a squared discrepancy, of itself, that is none

double squared_distance(std::span<const double> a, std::span<const double> b) {
  using Vector = Eigen::Map<const Eigen::VectorXd>;
  const auto n = static_cast<Eigen::Index>(a.size());
  return (Vector(a.data(), n) - Vector(b.data(), n)).squaredNorm();
}

}  // namespace

StrengthPosterior::StrengthPosterior(const Evidence& evidence, const Recipe& recipe, const ReadModuli* read)
    : runs_(evidence.strengths.size()),
      targets_(evidence.strengths),
      parameters_(strength_parameters(evidence)),
      middle_sigma_(std::log(evidence.scales.strength / usual_ratio)),
      read_(read) {
  for (const Target& t : targets_) {
    prior_.push_back(maps::prior_strength(evidence, recipe, t));
    // Once, as the sampler asks for them some hundred thousand times.
    variances_.push_back(variance(t)), log_means_.push_back(std::log(t.mean));
  }
  for (const Parameter* p : parameters_) boxes_.push_back(p->box(evidence.scales));
  for (const Parameter* p : strength_ratios(evidence)) {
    const auto least = p->strength->least;
    least_.push_back(p->normalised(least == nullptr ? p->range.low : std::max(p->range.low, least(recipe))));
  }
}

std::size_t StrengthPosterior::index_of(const Parameter& p) const {
  const auto it = std::find(parameters_.begin(), parameters_.end(), &p);
  PHY_CHECK(it != parameters_.end(), "a parameter of this rock");
  return static_cast<std::size_t>(it - parameters_.begin());
}

Point StrengthPosterior::middle_of_box() const {
  Point x(parameters_.size(), 0.0);
  x.front() = middle_sigma_;
  return x;
}

double StrengthPosterior::log_value(const Point& x, const Parameter& p) const {
  if (&p == &matrix_sigma_c) return log_sigma_c(x);
  return box(p).low + 0.5 * (x[index_of(p)] + 1.0) * (box(p).high - box(p).low);
}

double StrengthPosterior::prior_spread(std::size_t coordinate) const {
  const LogBox& box = boxes_[coordinate];
  return box.spread() * (coordinate == 0 ? 1.0 : 2.0 / (box.high - box.low));
}

Recipe StrengthPosterior::recipe_at(Recipe recipe, const Point& x) const {
  for (const Parameter* p : parameters_) p->set(recipe, std::exp(log_value(x, *p)));
  return recipe;
}

Point StrengthPosterior::held(Point x) const {
  const LogBox& sigma = box(matrix_sigma_c);
  x.front() = std::clamp(x.front(), sigma.low, sigma.high);
  for (std::size_t i = 0; i < least_.size(); ++i) x[i + 1] = std::clamp(x[i + 1], least_[i], 1.0);
  return x;
}

void StrengthPosterior::take_moduli(const Evidence& evidence, const Recipe& recipe) {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    maps::PriorMean now = maps::prior_strength(evidence, recipe, targets_[i]);
    // Otherwise a batch of tests would be lost whenever the moduli move by some per cent.
    for (SurrogateRun& run : runs_[i]) run.y += now.value(run.z) - prior_[i].value(run.z);
    prior_[i] = std::move(now);
  }
}

std::vector<Target> StrengthPosterior::without_runs() const {
  std::vector<Target> silent;
  for (std::size_t i = 0; i < runs_.size(); ++i)
    if (runs_[i].empty() && !measured(targets_[i].property).read_in) silent.push_back(targets_[i]);
  return silent;
}

void StrengthPosterior::learn() {
  models_.clear();
  for (std::size_t i = 0; i < runs_.size(); ++i) models_.emplace_back(runs_[i], prior_[i]);
}

std::vector<double> StrengthPosterior::inputs(const Point& x, std::size_t target) const {
  std::vector<double> all = places(x);
  all.resize(n_inputs(target, all));
  return all;
}

std::vector<double> StrengthPosterior::places(const Point& x) const {
  const std::span<const double> z = ratios(x);
  std::vector<double> all(z.begin(), z.end());
  const LogBox& sigma = box(matrix_sigma_c);
  all.push_back(2.0 * (log_sigma_c(x) - sigma.low) / (sigma.high - sigma.low) - 1.0);
  return all;
}

Surrogate::Value StrengthPosterior::response(const std::vector<double>& places, std::size_t target) const {
  const Surrogate& model = models_[target];
  Surrogate::Value v = model.at(std::span(places).first(n_inputs(target, places)));
  v.mean += 0.5 * model.scatter_variance();  // log-normal: the mean lies above the median
  return v;
}

Surrogate::Value StrengthPosterior::predict(const Point& x, std::size_t target) const {
  Surrogate::Value v = response(places(x), target);
  v.mean += log_sigma_c(x);
  return v;
}

double StrengthPosterior::variance(const Target& t) {
  const double relative = t.normal_error() / t.mean;
  return relative * relative;
}

void StrengthPosterior::use_full_errors() { errors_count_ = true; }

double StrengthPosterior::counted(Property property, double squared) const {
  return errors_count_ ? squared : std::min(squared, std::pow(0.5 * tolerance(property), 2.0));
}

bool StrengthPosterior::inside(const Point& x) const {
  const LogBox& sigma = box(matrix_sigma_c);
  if (log_sigma_c(x) < sigma.low || log_sigma_c(x) > sigma.high) return false;
  const std::span<const double> z = ratios(x);
  for (std::size_t i = 0; i < z.size(); ++i)
    if (z[i] > 1.0 || z[i] < least_[i]) return false;
  return true;
}

std::vector<StrengthPosterior::Miss> StrengthPosterior::misses(const Point& x) const {
  std::vector<Miss> all;
  all.reserve(targets_.size());
  const std::vector<double> at = places(x);
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Surrogate::Value model = response(at, i);
    const double mean = model.mean + log_sigma_c(x);
    all.push_back({targets_[i].property, log_means_[i] - mean, model.variance, scatter_of(i)});
  }
  if (read_ != nullptr)
    for (Miss m : read_->misses(at)) m.scatter = counted(m.property, m.scatter), all.push_back(m);
  return all;
}

double StrengthPosterior::log_density(const Point& x, std::size_t left_out) const {
  if (!inside(x)) return -infinity;
  const std::vector<Miss> all = misses(x);
  double sum = log_prior(x), alike = 0.0,
         errors = 0.0;  // of the common error: its weight, what all say of it
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == left_out) continue;
    const Miss& m = all[i];
    const double common = i < targets_.size() ? common_variance(i, m.variance) : 0.0;
    const double v = m.variance + m.scatter + discrepancy(m.property) - common;
    sum -= 0.5 * (m.error * m.error / v + std::log(v)) + pull(m);
    alike += common / v, errors += std::sqrt(common) * m.error / v;
  }
  return sum + 0.5 * (errors * errors / (1.0 + alike) - std::log1p(alike));  // Sherman & Morrison 1950
}

double StrengthPosterior::log_prior(const Point& x) const {
  double sum = 0.0;
  for (const Parameter* p : parameters_) sum -= 0.5 * std::pow(box(*p).strangeness(log_value(x, *p)), 2);
  return sum;
}

double StrengthPosterior::common_variance(std::size_t target, double variance) const {
  if (!errors_count_ || !is_compressive(targets_[target].property)) return 0.0;
  // Never more than the whole variance, which many runs near a point may have brought below this share.
  return common_share * std::min(models_[target].packing_variance(), variance);
}

double StrengthPosterior::pull(const Miss& m) const {
  return discrepancy(m.property) > 0.0 ? std::fabs(m.error) / std::sqrt(m.scatter) : 0.0;
}

bool StrengthPosterior::find_discrepancy(const std::vector<Point>& draws) {
  struct Beyond {
    double sum = 0.0;
    int n = 0;
  };
  double least = infinity;
  std::map<Property, Beyond> beyond;  // at the best of the draws
  for (const Point& x : draws) {
    double expected = 0.0;
    std::map<Property, Beyond> here;
    for (const Miss& m : misses(x)) {
      // no squares: a row that cannot be met must not decide for the others
      expected += std::sqrt((m.error * m.error + m.variance) / m.scatter);
      Beyond& b = here[m.property];
      // Squared misses beyond what scatter and ignorance explain: on average zero where the model is right.
      b.sum += m.error * m.error - m.variance - m.scatter, ++b.n;
    }
    if (expected < least) least = expected, beyond = std::move(here);
  }
  bool changed = false;
  for (const auto& [property, b] : beyond) {
    const double found = std::max(0.0, b.sum / b.n);
    double& known = discrepancy_[static_cast<std::size_t>(property)];
    if (std::fabs(found - known) <= no_change * std::max(found, known)) continue;
    known = found, changed = true;
  }
  return changed;
}

std::vector<Point> StrengthPosterior::draws(std::size_t left_out, std::uint32_t seed, int length) const {
  struct Start {
    double log_p;
    Point x;
  };
  std::vector<Start> starts;
  for (Point& x : spread_points(n_starts)) {
    x.front() = best_sigma(x, left_out);
    starts.push_back({log_density(x, left_out), x});
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.log_p > b.log_p; });
  std::vector<Point> walkers;
  for (int i = 0; i < n_walkers; ++i) walkers.push_back(starts[static_cast<std::size_t>(i)].x);
  return sample([&](const Point& x) { return log_density(x, left_out); }, std::move(walkers),
                length * n_sweeps, length * thin, seed);
}

Mixing StrengthPosterior::mixing_of(const std::vector<Point>& draws) { return mixing(draws, n_walkers); }

std::vector<Point> StrengthPosterior::draws_with_discrepancy(std::uint32_t seed, int length) {
  std::vector<Point> settling = draws(none, seed, length);
  // what one property misses draws the others along until its own discrepancy is known
  for (int pass = 0; pass < most_passes && find_discrepancy(settling); ++pass)
    settling = draws(none, seed, length);
  return settling;
}

/// Points that fill the box evenly: the additive recurrence of Roberts (2018) with powers of the
/// generalised golden ratio.
std::vector<Point> StrengthPosterior::spread_points(int n) const {
  const auto d = static_cast<double>(least_.size());
  double phi = 2.0;
  for (int i = 0; i < 60; ++i) phi = std::pow(1.0 + phi, 1.0 / (d + 1.0));
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) {
    Point x(parameters_.size(), 0.0);
    for (std::size_t j = 1; j < x.size(); ++j) {
      const double u = 0.5 + (i + 1) / std::pow(phi, static_cast<double>(j));
      x[j] = 2.0 * (u - std::floor(u)) - 1.0;
    }
    points.push_back(x);
  }
  return points;
}

/// sigma_c that fits best with the ratios of a point.
double StrengthPosterior::best_sigma(const Point& x, std::size_t left_out) const {
  double weight = 0.0, sum = 0.0;
  const std::vector<double> at = places(x);
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    // Under a stress on the sides strength is not proportional to sigma_c, and has no best value in closed
    // form.
    if (i == left_out || targets_[i].confining > 0.0) continue;
    const Surrogate::Value f = response(at, i);
    const double w = 1.0 / (f.variance + (scatter_of(i) + discrepancy(targets_[i].property)));
    weight += w, sum += w * (log_means_[i] - f.mean);
  }
  if (weight == 0.0) return likeliest_sigma(x, left_out);
  // Just inside: a walker that begins where the density is zero may stay there.
  return std::clamp(sum / weight, box(matrix_sigma_c).low + 1e-6, box(matrix_sigma_c).high - 1e-6);
}

/// The same by trial: strengths under confinement are not proportional to sigma_c.
double StrengthPosterior::likeliest_sigma(Point x, std::size_t left_out) const {
  constexpr int n_trials = 24;
  const LogBox& sigma = box(matrix_sigma_c);
  double best = middle_sigma_, highest = -infinity;
  for (int i = 0; i < n_trials; ++i) {
    x.front() = std::lerp(sigma.low, sigma.high, (i + 0.5) / n_trials);
    if (const double log_p = log_density(x, left_out); log_p > highest) highest = log_p, best = x.front();
  }
  return best;
}

std::vector<Point> spread_draws(const Point& first, const std::vector<Point>& draws, std::size_t n) {
  std::vector<Point> chosen = {first};
  while (chosen.size() < n) {
    double furthest = -1.0;
    const Point* next = &draws.front();
    // The draw that is farthest from all chosen: draws crowd where they are likely, and would teach one place
    // again and again. Ratios alone count, since sigma_c costs no run.
    for (const Point& x : draws) {
      double nearest = infinity;
      for (const Point& c : chosen)
        nearest =
            std::min(nearest, squared_distance(StrengthPosterior::ratios(x), StrengthPosterior::ratios(c)));
      if (nearest > furthest) furthest = nearest, next = &x;
    }
    chosen.push_back(*next);
  }
  return chosen;
}

}  // namespace phy::calibrate
