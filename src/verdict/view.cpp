#include "verdict/view.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "verdict/margin.hpp"

namespace phy::verdict {

namespace {

std::size_t place_of(Part part) { return static_cast<std::size_t>(part); }

}  // namespace

double scaled_error(const Comparison& c) { return miss_of(c) / margin(c); }

double error_of_laboratory(const Comparison& c) { return c.target.standard_error() / c.target.mean; }
double error_of_model(const Comparison& c) {
  return std::isfinite(c.sd) && c.n_packings > 0 ? c.sd / std::sqrt(c.n_packings) / c.mean : 0.0;
}

double EndRatio::error() const { return std::hypot(error_of_laboratory, error_of_model); }
double EndRatio::difference() const { return std::fabs(std::log(laboratory / model)); }

View::View(const Calibration& c) : of(c) {
  for (const Comparison& fit : c.fitted) {
    const Comparison* unseen = row_of(c.verification, fit.target);
    rows.push_back(unseen != nullptr && unseen->answered() ? *unseen : fit);
    if (rows.back().answered())
      misfit[place_of(measured(fit.target.property).part)] += std::pow(scaled_error(rows.back()), 2.0);
  }
}

std::vector<Comparison> View::answered(Property p) const {
  std::vector<Comparison> some;
  for (const Comparison& c : rows)
    if (c.target.property == p && c.answered()) some.push_back(c);
  return some;
}

const Comparison* View::at(Property p, double theta) const {
  for (const Comparison& c : rows)
    if (c.target.property == p && c.target.theta == theta && c.answered()) return &c;
  return nullptr;
}

bool View::moduli_alone() const {
  return std::none_of(rows.begin(), rows.end(),
                      [](const Comparison& c) { return is_strength(c.target.property); });
}

double View::share(Part part) const {
  const double all = std::accumulate(misfit.begin(), misfit.end(), 0.0);
  return all > 0.0 ? misfit[place_of(part)] / all : 0.0;
}

std::optional<EndRatio> View::end_ratio(Property p) const {
  const Comparison* across = at(p, 0.0);
  if (across == nullptr) return {};
  const auto along = std::find_if(rows.begin(), rows.end(), [&](const Comparison& c) {
    return c.answered() && c.target.theta == 90.0 && same_test(c.target, across->target);
  });
  if (along == rows.end() || along->mean / across->mean <= 0.0 ||
      along->target.mean / across->target.mean <= 0.0)
    return {};
  return EndRatio{along->target.mean / across->target.mean, along->mean / across->mean,
                  std::hypot(error_of_laboratory(*along), error_of_laboratory(*across)),
                  std::hypot(error_of_model(*along), error_of_model(*across))};
}

}  // namespace phy::verdict
