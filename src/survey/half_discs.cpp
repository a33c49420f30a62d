#include "survey/half_discs.hpp"

#include <algorithm>
#include <cmath>

#include "lab/semi_circular_bend/semi_circular_bend.hpp"
#include "records/quality.hpp"

namespace phy::survey {
namespace {

/// To hundredths of a mm: the advice has to be enough.
double rounded_down(double size) { return std::floor(size * 1e5 + 1e-9) * 1e-5; }

}  // namespace

double radius_of(Recipe model, const Target& toughness) {
  if (toughness.diameter > 0.0) model.test.disc_diameter = toughness.diameter;
  return lab::bend_specimen(model).radius;
}

double grains_in(double radius, double grain_size) { return std::floor(radius / grain_size + 1e-9); }

std::vector<Finding> few_grains_between(const Evidence& evidence) {
  const Recipe& model = evidence.rock.model;
  const auto limit = std::ranges::find(quality_limits(), std::string_view("grains_per_spacing"),
                                       [](const QualityLimit& q) { return std::string_view(q.number); });
  double spacing = HUGE_VAL;  // the narrowest planes decide
  for (const BeddingRecipe& set : model.bedding)
    if (set.has_planes()) spacing = std::min(spacing, set.spacing);
  const double grains = spacing / grain_size(model);
  if (grains >= limit->warning) return {};
  return {{FindingKind::few_grains_between,
           {},
           {{"grains", grains},
            {"fewest", limit->warning},
            {"spacing", spacing},
            {"wanted", rounded_down(spacing / limit->warning)}}}};
}

std::vector<Finding> coarse_half_discs(const Evidence& evidence) {
  std::vector<Finding> found;
  const Recipe& model = evidence.rock.model;
  for (const Target& t : of_property(evidence.targets, Property::fracture_toughness)) {
    const double R = radius_of(model, t), grains = grains_in(R, grain_size(model));
    if (grains >= fewest_in_radius ||
        std::any_of(found.begin(), found.end(), [&](const Finding& f) { return f.number("radius") == R; }))
      continue;
    const double fine = rounded_down(R / fewest_in_radius);
    found.push_back({FindingKind::coarse_half_disc,
                     {},
                     {{"grains", grains}, {"radius", R}, {"fewest", fewest_in_radius}, {"wanted", fine}},
                     {},
                     Advice::finer_half_disc});
  }
  return found;
}

}  // namespace phy::survey
