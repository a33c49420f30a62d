#include "calibrate/prior_regression.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "base/check.hpp"

namespace phy::calibrate {
namespace {

/// How far a rock may lie from what is expected: points left out are missed by 0.09 - 0.25 in UCS, by 0.2 -
/// 0.4 in Brazilian strength.
struct Belief {
  double constant, slope, curvature;
};
constexpr Belief compression = {0.15, 0.06, 0.04}, tension = {0.3, 0.15, 0.06}, stand_in = {0.4, 0.2, 0.06};

/// Made once for a column of a table.
const ReachRegression& regression_of(const ModelFamily& family, const std::string& column) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, std::string>, std::unique_ptr<ReachRegression>> made;
  const std::scoped_lock lock(mutex);
  std::unique_ptr<ReachRegression>& one = made[{family.name, column}];
  if (!one) one = std::make_unique<ReachRegression>(reach_of(family), column);
  return *one;
}

/// The two mapped angles about theta, and the share of the second.
struct Bracket {
  double low, high, share;
};
Bracket bracket_of(std::span<const double> mapped, double theta) {
  theta = std::clamp(theta > 90.0 ? 180.0 - theta : theta, 0.0, 90.0);  // mirror images
  std::size_t i = 0;
  while (i + 2 < mapped.size() && mapped[i + 1] < theta) ++i;
  return {mapped[i], mapped[i + 1], (theta - mapped[i]) / (mapped[i + 1] - mapped[i])};
}

}  // namespace

PriorRegression::PriorRegression(std::vector<const StrengthParameter*> ratios, const Recipe& recipe,
                                 Property property, double theta)
    : ratios_(std::move(ratios)) {
  const ModelFamily* family = family_of(recipe);
  PHY_CHECK(family != nullptr, "a family that was mapped");
  levers_ = family->levers;
  for (std::size_t l = 0; l < levers_.size(); ++l) {
    places_.push_back(levers_[l].place_of(levers_[l].get(recipe)));
    for (std::size_t r = 0; r < ratios_.size(); ++r)
      if (levers_[l].parameter == ratios_[r]) links_.push_back({r, l});
  }
  if (property == Property::direct_tension && family->layered)
    property = Property::brazilian, theta = 90.0 - theta;
  const bool disc = property == Property::brazilian;
  const Bracket b = bracket_of(disc ? std::span<const double>(mapped_disc_angles) : mapped_angles, theta);
  share_ = family->layered ? b.share : 0.0;
  for (const double angle : {b.low, b.high})
    at_.push_back(&regression_of(*family, strength_column(*family, property, angle)));
}

double PriorRegression::at(std::span<const double> z) const {
  std::vector<double> places = places_;
  for (const auto& [ratio, lever] : links_)
    places[lever] = levers_[lever].place_of(ratios_[ratio]->at_place(z[ratio]));
  return (1.0 - share_) * at_[0]->at(places) + (share_ > 0.0 ? share_ * at_[1]->at(places) : 0.0);
}

PriorMean prior_strength(const Evidence& evidence, const Recipe& recipe, Property property, double theta) {
  const ModelFamily* family = family_of(recipe);
  if (family == nullptr) return {};
  PriorRegression known(strength_ratios(evidence), recipe, property, theta);
  const bool stands_in = property == Property::direct_tension && family->layered;
  const Belief& believed = property == Property::ucs ? compression : stands_in ? stand_in : tension;
  return {[k = std::move(known)](std::span<const double> z) { return k.at(z); }, believed.constant,
          believed.slope, believed.curvature};
}

}  // namespace phy::calibrate
