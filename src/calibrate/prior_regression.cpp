#include "calibrate/prior_regression.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "base/check.hpp"
#include "calibrate/toughness.hpp"

namespace phy::calibrate {
namespace {

constexpr PriorWidth stand_in_width = {0.4, 0.2, 0.06};  // of direct tension of layered rock

using LogAnswer = std::function<double(std::size_t row)>;

/// Made once for what is asked of a family.
const ReachRegression& made_once(const ModelFamily& family, const std::string& what,
                                 const LogAnswer& answer) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, std::string>, std::unique_ptr<ReachRegression>> made;
  const std::scoped_lock lock(mutex);
  std::unique_ptr<ReachRegression>& one = made[{family.name, what}];
  if (!one) one = std::make_unique<ReachRegression>(reach_of(family), answer);
  return *one;
}

const ReachRegression& regression_of(const ModelFamily& family, const std::string& column) {
  return made_once(family, column,
                   [&](std::size_t row) { return std::log(reach_of(family).at(row, column)); });
}

/// Direct tension over Brazilian strength of bonds without layers.
const ReachRegression& tension_ratio_of(const ModelFamily& intact) {
  return made_once(intact, "DTS/BTS", [&table = reach_of(intact)](std::size_t row) {
    return std::log(table.at(row, "DTS/sigma_c") / table.at(row, "BTS/sigma_c"));
  });
}

/// Axial stress where cracks begin (a tenth of them in the maps), over sigma_c.
const ReachRegression& initiation_of(const ModelFamily& family, double theta) {
  const std::string ucs = column_at(family, measured(Property::ucs).map.as_read, theta),
                    share = column_at(family, "sigma_ci/UCS", theta);
  return made_once(family, share, [&table = reach_of(family), ucs, share](std::size_t row) {
    return std::log(table.at(row, ucs) * table.at(row, share));
  });
}

/// What confining stress adds to the strength, per unit of that stress, of bonds without layers.
const ReachRegression& growth_of(const ModelFamily& intact) {
  return made_once(intact, "growth", [&table = reach_of(intact)](std::size_t row) {
    const double sigma_3 = table.at(row, "sigma_3/sigma_c #2");  // a quarter of UCS, median
    return std::log(1.0 + (table.at(row, "q/sigma_c #2") - table.at(row, "UCS/sigma_c")) / sigma_3);
  });
}

/// Between the mapped angles. A disc is pulled a quarter turn from its load, and stands in for direct tension
/// where that was not mapped.
ReachRegression regression_at(const ModelFamily& family, Property property, double theta) {
  if (property == Property::crack_initiation) {
    const Bracket b = bracket_of(Property::ucs, theta);
    return {initiation_of(family, b.low), initiation_of(family, b.high), b.share};
  }
  const char* column = map_column(family, property, ModulusReading::tangent_50);
  if (column == nullptr) return regression_at(family, Property::brazilian, 90.0 - theta);
  const Bracket b = bracket_of(property, theta);
  return {regression_of(family, column_at(family, column, b.low)),
          regression_of(family, column_at(family, column, b.high)), b.share};
}

/// The family of the same bonds without layers.
const ModelFamily& without_layers(const ModelFamily& family) {
  for (const ModelFamily& f : model_families())
    if (!f.layered && f.base.matrix.model == family.base.matrix.model) return f;
  return family;
}

const ModelFamily& mapped_family(const Recipe& recipe) {
  const ModelFamily* family = family_of(recipe);
  PHY_CHECK(family != nullptr, "a family that was mapped");
  return *family;
}

}  // namespace

PriorRegression::PriorRegression(std::vector<const StrengthParameter*> ratios, const Recipe& recipe,
                                 Property property, double theta)
    : PriorRegression(std::move(ratios), recipe, mapped_family(recipe),
                      regression_at(mapped_family(recipe), property, theta)) {}

PriorRegression::PriorRegression(std::vector<const StrengthParameter*> ratios, const Recipe& recipe,
                                 const ModelFamily& family, ReachRegression regression)
    : regression_(std::move(regression)) {
  std::vector<double> places;
  std::vector<std::size_t> open;
  for (std::size_t l = 0; l < family.levers.size(); ++l) {
    const Lever& lever = family.levers[l];
    places.push_back(lever.place_of(lever.get(recipe)));
    const auto it = std::find(ratios.begin(), ratios.end(), lever.parameter);
    if (it == ratios.end()) continue;
    const auto place_at = [&](double z) { return lever.place_of((*it)->at_place(z)); };
    links_.push_back({static_cast<std::size_t>(it - ratios.begin()), *it, &lever, place_at(0.0),
                      0.5 * (place_at(1.0) - place_at(-1.0))});
    open.push_back(l);
  }
  regression_ = regression_.over(open, places);
}

double PriorRegression::Link::place(double z) const {
  return lever->logarithmic ? at_middle + slope * z : lever->place_of(parameter->at_place(z));
}

double PriorRegression::at(std::span<const double> z) const {
  std::vector<double> places(links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) places[i] = links_[i].place(z[links_[i].ratio]);
  return regression_.at(places);
}

namespace {

PriorMean prior_of(std::function<double(std::span<const double>)> value, const PriorWidth& width) {
  return {std::move(value), width.constant, width.slope, width.curvature};
}

/// UCS and what the confining stress adds. `z`: the ratios, then the place of sigma_c in its box.
PriorMean confined_strength(const Evidence& evidence, const Recipe& recipe, const ModelFamily& family,
                            const Target& target) {
  const std::vector<const StrengthParameter*> ratios = strength_ratios(evidence);
  const ModelFamily& intact = without_layers(family);
  const LogBox sigma = matrix_sigma_c.box(evidence.scales);
  return prior_of(
      [ucs = PriorRegression(ratios, recipe, Property::ucs, target.theta),
       growth = PriorRegression(ratios, recipe, intact, growth_of(intact)), sigma,
       stress = target.confining](std::span<const double> z) {
        const double sigma_c = std::exp(std::lerp(sigma.low, sigma.high, 0.5 * (z.back() + 1.0)));
        return std::log(std::exp(ucs.at(z)) + std::exp(growth.at(z)) * stress / sigma_c);
      },
      measured(target.property).prior);
}

}  // namespace

PriorMean prior_strength(const Evidence& evidence, const Recipe& recipe, const Target& target) {
  if (target.property == Property::fracture_toughness) {
    Target disc = target;
    disc.property = Property::brazilian;
    const bool mapped = evidence.maps && family_of(recipe) != nullptr;
    return prior_toughness(recipe,
                           mapped ? std::optional(prior_strength(evidence, recipe, disc)) : std::nullopt);
  }
  if (!evidence.maps) return {};
  const ModelFamily* family = family_of(recipe);
  if (family == nullptr) return {};
  const Property property = target.property;
  if (property == Property::confined) return confined_strength(evidence, recipe, *family, target);
  const std::vector<const StrengthParameter*> ratios = strength_ratios(evidence);
  PriorRegression known(ratios, recipe, property, target.theta);
  if (property == Property::direct_tension && family->layered) {
    const ModelFamily& intact = without_layers(*family);
    return prior_of(
        [disc = std::move(known), ratio = PriorRegression(ratios, recipe, intact, tension_ratio_of(intact))](
            std::span<const double> z) { return disc.at(z) + ratio.at(z); },
        stand_in_width);
  }
  return prior_of([k = std::move(known),
                   share = log_share(property)](std::span<const double> z) { return k.at(z) + share; },
                  measured(property).prior);
}

}  // namespace phy::calibrate
