#include "lab/brazilian/reading.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/analyse.hpp"
#include "analysis/strength.hpp"
#include "base/exact_math.hpp"
#include "base/nan.hpp"

namespace phy::lab {

double brazilian_arc_factor(double alpha) {
  if (alpha == 0.0) return 1.0;
  // Hondros (1959): pressure over an arc of 2 alpha instead of two lines of force.
  return (sin_cos_degrees(2.0 * alpha).sin - alpha * (pi / 180.0)) / sin_cos_degrees(alpha).sin;
}

std::vector<Number> place_of_splitting(const History& history, const analysis::LoadingBranch& branch,
                                       const std::vector<CrackEvent>& cracks, double diameter) {
  Number y{"first_crack_y", nan, "1", "height of the first crack above the centre / diameter", ""};
  Number x{"first_crack_x", nan, "1", "distance of the first crack to the right of the centre / diameter",
           ""};
  Number share{
      "central_cracks", nan, "1",
      "share of the cracks up to the peak within a sixth of the diameter of the centre, along and across "
      "the load",
      ""};
  double n = 0.0, central = 0.0;
  for (const CrackEvent& c : cracks) {
    // Behind the peak the halves crush each other; NaN, without a peak, takes none either.
    if (!(c.strain <= branch.strain)) continue;
    const double dx = (c.position.x - 0.5 * history.width) / diameter;
    const double dy = (c.position.y - 0.5 * history.height) / diameter;
    if (n == 0.0) x.value = dx, y.value = dy;
    // Cracks come in the order of their cycles: the first is the first.
    n += 1.0;
    central += std::fmax(std::fabs(dx), std::fabs(dy)) <= central_third ? 1.0 : 0.0;
  }
  if (n > 0.0)
    share.value = central / n;
  else
    x.note = y.note = share.note = "no crack before the peak";
  return {y, x, share};
}

std::vector<Number> disc_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                 double diameter, double density) {
  const analysis::LoadingBranch branch = analysis::loading_branch(history);
  std::vector<Number> out = analysis::strength(branch);
  const std::vector<Number> place = place_of_splitting(history, branch, cracks, diameter);
  const double y = place[0].value, x = place[1].value;
  // The formula holds for a disc that splits from its centre: a crack at the jaws measures something else.
  if (std::fmax(std::fabs(x), std::fabs(y)) > central_third)
    out.front().note = analysis::joined(
        out.front().note, fmt::format("no tensile strength: the first crack came {:.2f} diameters from the "
                                      "centre, outside the central third",
                                      std::hypot(x, y)));
  analysis::add(out, place);
  analysis::add(out, analysis::crack_initiation(branch, cracks, 0.0));
  analysis::add(out, analysis::common_numbers(history, branch, cracks, {density, diameter, disc_approach}));
  return out;
}

}  // namespace phy::lab
