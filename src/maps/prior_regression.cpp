#include "maps/prior_regression.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "base/exact_math.hpp"

namespace phy::maps {
namespace {

constexpr PriorWidth stand_in_width = {0.4, 0.2, 0.06};  // of direct tension of layered rock
// K_Ic over Brazilian strength and the root of the grain size, 2.7: geometric mean over 22 models, without
// layers and with planes at 0, 45 and 90 degrees, 1,197 to 7,481 discs (docs/calibration.md). They lie 0.33
// about it (root mean square of the logarithm).
constexpr double toughness_alpha = 4.6;
constexpr double usual_splitting = 0.5;  // BTS over sigma_c

/// Direct tension over Brazilian strength of bonds without layers.
const MapRegression& tension_ratio_of(const MappedModel& intact) {
  return regression_of(intact, "DTS/BTS", [&table = map_of(intact)](std::size_t row) {
    return std::log(table.at(row, "DTS/sigma_c") / table.at(row, "BTS/sigma_c"));
  });
}

/// Axial stress where cracks begin (a tenth of them in the maps), over sigma_c.
const MapRegression& initiation_of(const MappedModel& model, double theta) {
  const std::string ucs = column_at(model, measured(Property::ucs).map.as_read, theta),
                    share = column_at(model, "sigma_ci/UCS", theta);
  return regression_of(model, share, [&table = map_of(model), ucs, share](std::size_t row) {
    return std::log(table.at(row, ucs) * table.at(row, share));
  });
}

/// What confining stress adds to the strength, per unit of that stress, of bonds without layers.
const MapRegression& growth_of(const MappedModel& intact) {
  return regression_of(intact, "growth", [&table = map_of(intact)](std::size_t row) {
    const double sigma_3 = table.at(row, "sigma_3/sigma_c #2");  // a quarter of UCS, median
    return std::log(1.0 + (table.at(row, "q/sigma_c #2") - table.at(row, "UCS/sigma_c")) / sigma_3);
  });
}

/// Between the mapped angles. A disc is pulled a quarter turn from its load, and stands in for direct tension
/// where that was not mapped.
MapRegression regression_at(const MappedModel& model, Property property, double theta) {
  if (property == Property::crack_initiation) {
    const Bracket b = bracket_of(Property::ucs, theta);
    return {initiation_of(model, b.low), initiation_of(model, b.high), b.share};
  }
  const char* column = map_column(model, property, ModulusReading::tangent_50);
  if (column == nullptr) return regression_at(model, Property::brazilian, 90.0 - theta);
  const Bracket b = bracket_of(property, theta);
  return {regression_of(model, column_at(model, column, b.low)),
          regression_of(model, column_at(model, column, b.high)), b.share};
}

/// The same bonds without layers.
const MappedModel& without_layers(const MappedModel& model) {
  for (const MappedModel& m : mapped_models())
    if (!m.layered() && m.model->matrix == model.model->matrix) return m;
  return model;
}

const MappedModel& mapped(const Recipe& recipe) {
  const MappedModel* model = mapped_model_of(recipe);
  PHY_CHECK(model != nullptr, "a model that was mapped");
  return *model;
}

}  // namespace

PriorRegression::PriorRegression(std::vector<const Parameter*> ratios, const Recipe& recipe,
                                 Property property, double theta)
    : PriorRegression(std::move(ratios), recipe, mapped(recipe),
                      regression_at(mapped(recipe), property, theta)) {}

PriorRegression::PriorRegression(std::vector<const Parameter*> ratios, const Recipe& recipe,
                                 const MappedModel& model, MapRegression regression)
    : regression_(std::move(regression)) {
  std::vector<double> places;
  std::vector<std::size_t> open;
  // variables that a calibration leaves alone stay where the recipe has them, and fold into the constant
  for (std::size_t l = 0; l < model.variables.size(); ++l) {
    const MapVariable& variable = model.variables[l];
    places.push_back(variable.normalised(variable.get(recipe)));
    const auto it = std::find(ratios.begin(), ratios.end(), variable.parameter);
    if (it == ratios.end()) continue;
    // of a logarithmic variable the place is linear in that of the ratio: two values fix it
    const auto place_at = [&](double z) { return variable.normalised((*it)->from_normalised(z)); };
    links_.push_back({static_cast<std::size_t>(it - ratios.begin()), *it, &variable, place_at(0.0),
                      0.5 * (place_at(1.0) - place_at(-1.0))});
    open.push_back(l);
  }
  regression_ = regression_.over(open, places);
}

double PriorRegression::Link::place(double z) const {
  return variable->logarithmic ? at_middle + slope * z : variable->normalised(parameter->from_normalised(z));
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
PriorMean confined_strength(const Evidence& evidence, const Recipe& recipe, const MappedModel& model,
                            const Target& target) {
  const std::vector<const Parameter*> ratios = strength_ratios(evidence);
  const MappedModel& intact = without_layers(model);
  const LogBox sigma = matrix_sigma_c.box(evidence.scales);
  return prior_of(
      [ucs = PriorRegression(ratios, recipe, Property::ucs, target.theta),
       growth = PriorRegression(ratios, recipe, intact, growth_of(intact)), sigma,
       stress = target.confining](std::span<const double> z) {
        const double sigma_c = std::exp(std::lerp(sigma.low, sigma.high, 0.5 * (z.back() + 1.0)));
        // the regressions are of logarithms, the stress adds to the strength itself
        return std::log(std::exp(ucs.at(z)) + std::exp(growth.at(z)) * stress / sigma_c);
      },
      measured(target.property).prior);
}

/// Of layered rock by a disc, times direct tension over Brazilian strength of the same bonds without layers.
PriorMean tension_by_discs(const Evidence& evidence, const Recipe& recipe, const MappedModel& model,
                           PriorRegression disc) {
  const MappedModel& intact = without_layers(model);
  return prior_of([disc = std::move(disc), ratio = PriorRegression(strength_ratios(evidence), recipe, intact,
                                                                   tension_ratio_of(intact))](
                      std::span<const double> z) { return disc.at(z) + ratio.at(z); },
                  stand_in_width);
}

/// Joints that share one plane (docs/theory/calibration.md, "Direct shear of bedding"): their length over
/// that of the plane is left out. `z`: the ratios, then the place of sigma_c where there is a stress.
PriorMean sheared_bedding(const Evidence& evidence, const Recipe& recipe, const Target& target) {
  return prior_of(
      [ratios = strength_ratios(evidence), recipe, target,
       sigma = matrix_sigma_c.box(evidence.scales)](std::span<const double> z) {
        Recipe at = recipe;
        const bool has_scale = z.size() > ratios.size();
        const double sigma_c =
            has_scale ? std::exp(std::lerp(sigma.low, sigma.high, 0.5 * (z.back() + 1.0))) : 1.0;
        matrix_sigma_c.set(at, sigma_c);
        for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i]->set(at, ratios[i]->from_normalised(z[i]));
        const BeddingRecipe& joint = at.bedding.front();
        const double slides = joint.mu * target.confining,
                     breaks = joint.cohesion + tan_degrees(joint.phi) * target.confining;
        const bool peak = target.property == Property::shear_peak;
        return std::log((peak ? std::max(breaks, slides) : slides) / sigma_c);
      },
      measured(target.property).prior);
}

}  // namespace

PriorMean prior_toughness(const Recipe& recipe, const std::optional<PriorMean>& splitting) {
  // sqrt(pi alpha R), R half of the mean diameter
  const double root = 0.5 * std::log(pi * toughness_alpha * 0.5 * grain_size(recipe));
  if (!splitting) {
    PriorMean prior;
    prior.value = [root](std::span<const double>) { return std::log(usual_splitting) + root; };
    return prior;
  }
  return prior_of([root, of = splitting->value](std::span<const double> z) { return of(z) + root; },
                  measured(Property::fracture_toughness).prior);
}

PriorMean prior_strength(const Evidence& evidence, const Recipe& recipe, const Target& target) {
  const MappedModel* model = evidence.maps ? mapped_model_of(recipe) : nullptr;
  const Property property = target.property;
  if (property == Property::fracture_toughness) {
    Target disc = target;
    disc.property = Property::brazilian;
    return prior_toughness(
        recipe, model == nullptr ? std::nullopt : std::optional(prior_strength(evidence, recipe, disc)));
  }
  if (measured(property).along_bedding) {
    // Bonds alone, and bedding that slides under no stress, are nothing that joints tell.
    const bool slides = property == Property::shear_residual;
    if (recipe.bedding.empty() || (slides && target.confining == 0.0)) return {};
    return sheared_bedding(evidence, recipe, target);
  }
  if (model == nullptr) return {};  // nothing is expected, and the surrogate begins wide
  if (property == Property::confined) return confined_strength(evidence, recipe, *model, target);
  PriorRegression known(strength_ratios(evidence), recipe, property, target.theta);
  if (property == Property::direct_tension && model->layered())
    return tension_by_discs(evidence, recipe, *model, std::move(known));
  return prior_of([k = std::move(known),
                   share = log_share(property)](std::span<const double> z) { return k.at(z) + share; },
                  measured(property).prior);
}

}  // namespace phy::maps
