#include "lab/direct_tension/reading.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/analyse.hpp"
#include "base/nan.hpp"

namespace phy::lab {
namespace {

constexpr double grip_reach = 1.5;  // of the grip's thickness: its edge concentrates the stress

}  // namespace

History mirrored(History history) {
  for (HistoryRow& r : history.rows)
    for (double* v : {&r.axial_strain, &r.axial_strain_gauge, &r.lateral_strain_gauge, &r.axial_stress,
                      &r.stress_top, &r.stress_bottom, &r.lateral_strain, &r.lateral_stress})
      // Not -x: zero keeps its sign.
      *v = 0.0 - *v;
  return history;
}

std::vector<CrackEvent> mirrored(std::vector<CrackEvent> cracks) {
  for (CrackEvent& c : cracks) c.strain = 0.0 - c.strain;
  return cracks;
}

std::vector<Number> place_of_failure(const History& history, const std::vector<CrackEvent>& cracks,
                                     double peak_strain, double grip_thickness) {
  Number position{"failure_position", nan, "1",
                  "median height of the cracks from the peak on, over the specimen's height (0 = bottom)",
                  ""};
  Number at_grip{"failure_at_grip", nan, "1",
                 "share of the cracks from the peak on that lie within 1.5 grip thicknesses of an end", ""};
  std::vector<double> heights;
  double near = 0.0;
  for (const CrackEvent& c : cracks) {
    // Strains of tension are negative: from the peak on they are below that of the peak.
    if (!(c.strain <= peak_strain)) continue;
    heights.push_back(c.position.y / history.height);
    const double end = std::min(c.position.y, history.height - c.position.y);
    near += end < grip_reach * grip_thickness ? 1.0 : 0.0;
  }
  if (heights.empty()) {
    position.note = at_grip.note = "no cracks from the peak on";
    return {position, at_grip};
  }
  // The median: single cracks far from the fracture do not move it.
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  position.value = *middle;
  at_grip.value = near / static_cast<double>(heights.size());
  return {position, at_grip};
}

std::vector<Number> tension_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                    double grip_thickness, const analysis::WavePath& path) {
  const History pulled = mirrored(history);
  const analysis::LoadingBranch branch = analysis::loading_branch(pulled);
  std::vector<Number> out = analysis::axial_numbers(pulled, branch, mirrored(cracks), {path});
  std::erase_if(out, [](const Number& n) {  // notions of compression
    return n.name == "sigma_cd" || n.name == "sigma_cd_volume" || n.name == "sigma_ci_strain";
  });
  const std::vector<Number> place = place_of_failure(history, cracks, -branch.strain, grip_thickness);
  // The edge of a grip concentrates the stress, so that the rock would have borne more.
  if (place.back().value > 0.5)
    out.front().note =
        analysis::joined(out.front().note, "failed at the grip: a lower bound of the strength");
  out.insert(out.begin() + 2, place.begin(), place.end());
  return out;
}

}  // namespace phy::lab
