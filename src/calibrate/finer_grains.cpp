#include "calibrate/finer_grains.hpp"

#include <algorithm>
#include <cmath>

#include "study/expected.hpp"
#include "verdict/cells.hpp"

namespace phy::calibrate {
namespace {

constexpr double times_finer = 2.0, most_grains = 10'000.0;

Recipe finer(Recipe recipe) {
  PackingRecipe& p = recipe.packing;
  p.radius_min /= times_finer, p.radius_max /= times_finer;
  p.n_grains = std::llround(static_cast<double>(p.n_grains) * times_finer * times_finer);
  return recipe;
}

/// Largest miss of these values; root mean square miss of E.
double largest_of(const ElasticFit& fit, const std::vector<Cell>& cells) {
  double most = 0.0;
  for (const Comparison& c : fit.comparisons)
    if (std::ranges::find(cells, cell_of(c.target)) != cells.end())
      most = std::fmax(most, c.answered() ? std::fabs(verdict::miss_of(c)) : infinity);
  return most;
}
double rms_of_E(const ElasticFit& fit) {
  double squares = 0.0;
  int n = 0;
  for (const Comparison& c : fit.comparisons)
    if (c.target.property == Property::E) squares += std::pow(verdict::miss_of(c), 2.0), ++n;
  return std::sqrt(squares / std::max(1, n));
}

}  // namespace

std::optional<Finding> grains_for_nu(const Evidence& table, const ElasticFit& fit,
                                     const std::vector<Cell>& missed, const std::vector<std::int64_t>& seeds,
                                     Simulator& simulator) {
  Rock rock = table.rock;
  rock.model = finer(rock.model);
  const double n = study::expected_grains(rock.model);
  // A file holds one packing: its grains cannot be made smaller.
  if (missed.empty() || n > most_grains || !rock.model.packing.file.empty()) return {};
  const ElasticFit anew =
      // Moduli anew, not the old ones on small grains: joints overlap otherwise there, and E would be off.
      fit_elastic(Evidence(rock, table.targets), seeds, {}, simulator, [](const Finding&) {});
  const double miss = largest_of(anew, missed);
  // nu must not be bought with E, unless E stays within its tolerance.
  if (miss > verdict::tolerance(Property::nu) ||
      rms_of_E(anew) > std::max(rms_of_E(fit), verdict::tolerance(Property::E)))
    return {};
  return Finding{FindingKind::grains_for_nu,
                 missed,
                 {{"grains", study::expected_grains(table.rock.model)},
                  {"finer", n},
                  {"miss", largest_of(fit, missed)},
                  {"miss_finer", miss}},
                 {},
                 Advice::smaller_grains};
}

}  // namespace phy::calibrate
