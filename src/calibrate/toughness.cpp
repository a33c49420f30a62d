#include "calibrate/toughness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/exact_math.hpp"
#include "base/nan.hpp"
#include "base/units.hpp"
#include "lab/semi_circular_bend/semi_circular_bend.hpp"
#include "records/recipe_schema.hpp"
#include "study/expected.hpp"

namespace phy::calibrate {
namespace {

/// K_Ic over Brazilian strength and the root of the grain size, 2.7: geometric mean over 22 models, without
/// layers and with planes at 0, 45 and 90 degrees, 1,197 to 7,481 discs (docs/calibration.md). They lie 0.33
/// about it (root mean square of the logarithm).
constexpr double alpha = 4.6;
constexpr double constant = 0.4, slope = 0.2, curvature = 0.06;  // what is believed of it
constexpr double usual_splitting = 0.5;                          // BTS over sigma_c
constexpr double fewest_in_radius = 20.0;                        // grains

lab::BendSpecimen half_disc(const Recipe& recipe, const Target& target) {
  Recipe one = recipe;
  if (target.diameter > 0.0) one.test.disc_diameter = target.diameter;
  return lab::bend_specimen(one);
}

/// Grains in a radius, rounding errors forgiven.
double whole_grains(double radius, double grain_size) { return std::floor(radius / grain_size + 1e-9); }

}  // namespace

PriorMean prior_toughness(const Recipe& recipe, const std::optional<PriorMean>& splitting) {
  const double root = 0.5 * std::log(pi * alpha * 0.5 * grain_size(recipe));
  if (!splitting) {
    PriorMean prior;
    prior.value = [root](std::span<const double>) { return std::log(usual_splitting) + root; };
    return prior;
  }
  return {[root, of = splitting->value](std::span<const double> z) { return of(z) + root; }, constant, slope,
          curvature};
}

double grain_size_to_meet(const std::vector<Comparison>& toughness, double grain_size) {
  double sum = 0.0;
  int n = 0;
  for (const Comparison& c : toughness)
    if (c.answered()) sum += std::log(c.target.mean / c.mean), ++n;
  return n > 0 ? grain_size * std::exp(2.0 * sum / n) : nan;
}

namespace {

/// How many grains of another size the smallest half disc of the rows has in its radius.
std::string in_radius(const std::vector<Comparison>& toughness, const Recipe& model, double grain_size) {
  double R = half_disc(model, toughness.front().target).radius;
  for (const Comparison& c : toughness) R = std::min(R, half_disc(model, c.target).radius);
  const double across = whole_grains(R, grain_size);
  return fmt::format("{:.0f} in the radius of the half disc{}", across,
                     across < fewest_in_radius
                         ? fmt::format(", fewer than {:g}: K_Ic comes out smaller there, and the size that "
                                       "meets it is larger",
                                       fewest_in_radius)
                         : "");
}

}  // namespace

bool can_hold(const Recipe& model, double size) {
  constexpr double fewest_across = 10.0;
  const SpecimenSize& s = model.specimen;
  const double n = study::expected_grains(model) * std::pow(grain_size(model) / size, 2.0);
  return size * fewest_across <= std::min(s.width, s.height) && n <= static_cast<double>(max_recipe_grains);
}

std::string compared_in_words(const std::vector<Comparison>& toughness, const Recipe& model) {
  std::string rows;
  for (const Comparison& c : toughness) {
    rows += fmt::format("{}{} = {}", rows.empty() ? "" : ", ", cell_name(c.target),
                        c.answered() ? fmt::format("{:.2f} instead of {:.2f} MPa sqrt(m) ({:+.0f} %)",
                                                   c.mean * 1e-6, c.target.mean * 1e-6, 100.0 * c.error())
                                     : "no answer");
  }
  const double now = grain_size(model), other = grain_size_to_meet(toughness, now);
  const std::string text = fmt::format("compared, not fitted, with grains of {:.3g} mm: {}", now * 1e3, rows);
  if (!std::isfinite(other)) return text;
  if (!can_hold(model, other))
    return text + fmt::format("; at the same strengths it asks for grains of {:.2g} mm, {} for this specimen",
                              other * 1e3, other > now ? "too large" : "too many");
  return text + fmt::format(
                    "; at the same strengths grain_size = \"{:.2g} mm\" would meet it (some {:.0f} grains "
                    "in the specimen, {}), and has it fitted",
                    other * 1e3, rounded(study::expected_grains(model) * std::pow(now / other, 2.0), 2),
                    in_radius(toughness, model, other));
}

}  // namespace phy::calibrate
