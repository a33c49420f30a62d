#include "design/draws.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/stats.hpp"

namespace phy::design {
namespace {

/// Where a draw has these two constants.
struct Pair {
  double a = 0.0, b = 0.0, covariance = 0.0;
};

/// Of all draws that have both.
std::vector<Pair> pairs_of(const std::vector<Fit>& draws, const Key& a, const Key& b) {
  std::vector<Pair> pairs;
  // A draw may have one of the two: of an inclination that it could not fit.
  for (const Fit& f : draws) {
    const auto i = std::find(f.keys.begin(), f.keys.end(), a), j = std::find(f.keys.begin(), f.keys.end(), b);
    if (!f.ok() || i == f.keys.end() || j == f.keys.end()) continue;
    const auto p = i - f.keys.begin(), q = j - f.keys.begin();
    pairs.push_back({f.x[p], f.x[q], f.covariance(p, q)});
  }
  return pairs;
}

/// Rubin's variances of two means, or of one with itself.
struct Variances {
  double mean = 0.0, within = 0.0, between = 0.0;  ///< the last with the share of the mean itself
  std::size_t n = 0;
  double total() const { return within + between; }
  /// Student's degrees of freedom.
  std::size_t degrees() const {
    constexpr double most = 1e6;
    const double ratio = between > 0.0 ? 1.0 + within / between : most;
    return static_cast<std::size_t>(std::min(most, static_cast<double>(n - 1) * ratio * ratio));
  }
};

Variances variances_of(const std::vector<Pair>& pairs) {
  Variances v{.n = pairs.size()};
  const auto m = static_cast<double>(pairs.size());
  double mean_b = 0.0;
  for (const Pair& p : pairs) v.mean += p.a / m, mean_b += p.b / m, v.within += p.covariance / m;
  for (const Pair& p : pairs) v.between += (p.a - v.mean) * (p.b - mean_b) / (m - 1.0);
  v.between *= 1.0 + 1.0 / m;
  return v;
}

ConstantEstimate estimate_of(const Key& key, const Variances& v) {
  // On the scale of the fit: an interval of a modulus cannot reach below zero, nor one of an angle.
  const double half = student_t_95(v.degrees()) * std::sqrt(v.total());
  const Constant c = key.constant;
  return {key,
          outer(c, v.mean),
          outer_end(c, v.mean - half),
          outer_end(c, v.mean + half),
          outer_slope(c, v.mean) * std::sqrt(v.total()),
          v.n};
}

/// In the order of their first appearance, those of at least two draws.
std::vector<Key> keys_of(const std::vector<Fit>& draws) {
  std::vector<Key> keys;
  for (const Fit& f : draws)
    for (const Key& k : f.keys)
      if (std::find(keys.begin(), keys.end(), k) == keys.end() && pairs_of(draws, k, k).size() >= 2)
        keys.push_back(k);
  // A draw may lack an inclination in between.
  std::stable_sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return a.constant != b.constant ? a.constant < b.constant : a.theta < b.theta;
  });
  return keys;
}

double rms(const std::vector<double>& values) {
  double squares = 0.0;
  std::size_t n = 0;
  for (const double v : values)
    // A draw without the number says nothing of its error.
    if (std::isfinite(v)) squares += v * v, ++n;
  return n > 0 ? std::sqrt(squares / static_cast<double>(n)) : nan;
}

/// The most frequent one.
Refusal usual_refusal(const std::vector<Fit>& draws) {
  std::map<Refusal, int> counts;
  for (const Fit& f : draws)
    if (!f.ok()) ++counts[f.refusal];
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most != counts.end() ? most->first : Refusal::too_few;
}

}  // namespace

const ConstantEstimate* Pooled::find(const Key& key) const {
  const auto it = std::find_if(constants.begin(), constants.end(),
                               [&](const ConstantEstimate& e) { return e.key == key; });
  return it != constants.end() ? &*it : nullptr;
}

double Pooled::value(const Key& key) const {
  const ConstantEstimate* e = find(key);
  return e != nullptr ? e->value : nan;
}

Fit Pooled::mean() const {
  Fit fit{.refusal = refusal, .error = error};
  fit.x.resize(static_cast<Eigen::Index>(constants.size()));
  for (std::size_t i = 0; i < constants.size(); ++i) {
    fit.keys.push_back(constants[i].key);
    fit.x[static_cast<Eigen::Index>(i)] = inner(constants[i].key.constant, constants[i].value);
  }
  return fit;
}

Pooled pool(const std::vector<Fit>& draws) {
  Pooled all;
  std::vector<double> errors;
  for (const Fit& f : draws) f.ok() ? errors.push_back(f.error) : void(++all.n_without);
  all.n_draws = errors.size();
  all.error = rms(errors);
  const std::vector<Key> keys = keys_of(draws);
  if (all.n_draws < 2 || keys.empty()) {
    // Draws may have fits, each at other inclinations.
    all.refusal = all.n_draws < 2 ? usual_refusal(draws) : Refusal::no_common;
    return all;
  }
  all.refusal = Refusal::none;
  const auto n = static_cast<Eigen::Index>(keys.size());
  // Pairs that no two draws have in common stay unknown.
  all.covariance = Eigen::MatrixXd::Constant(n, n, nan);
  std::vector<double> slopes;
  for (const Key& k : keys) {
    const Variances v = variances_of(pairs_of(draws, k, k));
    all.constants.push_back(estimate_of(k, v)), slopes.push_back(outer_slope(k.constant, v.mean));
  }
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto p = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
      const std::vector<Pair> pairs = pairs_of(draws, keys[p], keys[q]);
      if (pairs.size() >= 2) all.covariance(i, j) = slopes[p] * slopes[q] * variances_of(pairs).total();
    }
  return all;
}

}  // namespace phy::design
