#include "lab/opening/reading.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/analyse.hpp"
#include "analysis/specimen_checks.hpp"
#include "analysis/strength.hpp"
#include "base/nan.hpp"

namespace phy::lab {
namespace {

/// Clarity of a breakout on both sides, 109 degrees wide: a wider one, or two far apart, points nowhere.
constexpr double clear_axis = 0.5;

/// The history of the stress that the opening bears: what every test reads of its own stress.
History borne(History history) {
  for (HistoryRow& row : history.rows) row.axial_stress = row.borne_stress;
  return history;
}

/// The sector of the largest hoop stress, or by `less` of another.
template <class Less>
const WallPoint& extreme(const std::vector<WallPoint>& points, const Less& less) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const WallPoint& p, const WallPoint& q) { return less(p.hoop, q.hoop); });
}

/// Hoop stresses when it stood.
std::vector<Number> hoop_numbers(const OpeningReading& read, const std::string& note) {
  std::vector<Number> out;
  const auto add = [&](const std::string& name, const char* what, const auto& less) {
    const WallPoint p =
        read.standing ? extreme(read.standing->points, less) : WallPoint{.angle = nan, .hoop = nan};
    out.push_back({name, p.hoop, "Pa",
                   std::string(what) + " hoop stress one to five grains behind the wall when it stood",
                   note});
    out.push_back({name + "_direction", std::fmod(p.angle, 180.0), "deg",
                   "where that is, from the horizontal, anticlockwise", note});
  };
  add("hoop_max", "largest", std::less<>());
  add("hoop_min", "smallest", std::greater<>());
  return out;
}

std::vector<Number> breakout_numbers(const std::optional<OpeningState>& state, double radius,
                                     const std::string& suffix, const std::string& when,
                                     const std::string& note) {
  const analysis::Breakout* const b = state ? &state->breakout : nullptr;
  const bool any = b != nullptr && b->depth > 0.0, axis = any && b->clarity >= clear_axis;
  const double depth = b == nullptr ? nan : b->depth / radius;
  const std::string none = b == nullptr ? note : any ? "" : "no breakout";
  return {
      {"breakout_depth" + suffix, depth, "1", "depth of rock without a bond to the rest" + when + " / radius",
       std::isinf(depth) ? "through to the outside" : note},
      {"breakout_direction" + suffix, axis ? b->direction : nan, "deg",
       "its direction, from the horizontal, anticlockwise", any && !axis ? "on no clear axis" : none},
      {"breakout_width" + suffix, any ? 0.5 * (b->width[0] + b->width[1]) : nan, "deg",
       "broken wall" + when + ", mean of both sides", none}};
}

/// Of the wall, where what hangs on the rest by no bond goes through to the outside.
double share_to_edge(const OpeningState& state) {
  const auto n = std::count_if(state.points.begin(), state.points.end(),
                               [](const WallPoint& p) { return std::isinf(p.breakout); });
  return static_cast<double>(n) / static_cast<double>(state.points.size());
}

/// What the far field broke before there was an opening began at none of the stresses that it bears.
std::vector<Number> initiation(const analysis::LoadingBranch& branch, std::vector<CrackEvent> cracks) {
  const double begun = branch.empty() ? 0.0 : branch.rows.front().step;
  std::erase_if(cracks, [&](const CrackEvent& c) { return static_cast<double>(c.step) <= begun; });
  std::vector<Number> out = analysis::crack_initiation(branch, cracks, 0.0);
  for (Number& n : out) n.definition += "; since the excavation began";
  return out;
}

}  // namespace

OpeningState opening_state(const Specimen& specimen, const OpeningBegin& begin, const Snapshot& now,
                           const HistoryRow& row, WallMoment moment) {
  const double grain = analysis::grain_diameter(specimen);
  const analysis::OpeningPlace& place = begin.place;
  OpeningState state;
  state.closure = row.closure;
  const auto stress = analysis::stress_around(
      *specimen.packing, now,
      {place.centre, place.radius + hoop_ring[0] * grain, place.radius + hoop_ring[1] * grain},
      n_wall_sectors);
  const auto wall = analysis::wall_motion(specimen, now, place, n_wall_sectors, &begin.shot);
  const auto depths = analysis::breakout_depths(specimen, now, place.centre, n_wall_sectors);
  const double least = 0.5 * grain;
  state.breakout = analysis::breakout_of(depths, least);
  for (std::size_t k = 0; k < stress.size(); ++k) {
    const analysis::SectorStress& s = stress[k];
    state.points.push_back({moment, s.angle, row.borne_stress, s.hoop, s.radial, s.shear, wall.inwards[k],
                            depths[k] > least ? depths[k] : 0.0});
  }
  return state;
}

std::vector<Number> opening_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                    const OpeningReading& read, double diameter) {
  const History own = borne(history);
  analysis::LoadingBranch branch = analysis::loading_branch(own);
  const bool closed = read.at_end && read.at_end->closure > collapsed;
  // What closes ends the test while the stress may still rise. An opening that only stands has borne its
  // stress in more than one row, which is no fall.
  branch.peaked = !branch.empty() && (closed || (read.raised && branch.peaked));
  const std::string begun = read.at_end ? "" : "the excavation did not begin";
  const std::string stood = read.standing ? ""
                            : closed      ? "it did not stand"
                            : read.at_end ? "it did not come to rest"
                                          : begun;
  std::vector<Number> out = analysis::strength(branch);
  Number& collapse = out.front();
  collapse.definition =
      "largest vertical far-field stress borne; while it is excavated, times the share excavated";
  Number factor{"collapse_factor", collapse.value / read.vertical_stress, "1",
                "collapse stress / vertical far-field stress; below 1: the share of the excavation at which "
                "it collapses",
                collapse.note};
  out.insert(out.begin() + 1, std::move(factor));
  out.push_back({"closure", read.standing ? read.standing->closure : nan, "1",
                 "mean displacement of the wall inwards when it stood / radius", stood});
  out.push_back({"closure_at_end", read.at_end ? read.at_end->closure : nan, "1",
                 "the same when the test ended", begun});
  analysis::add(out, hoop_numbers(read, stood));
  analysis::add(out, breakout_numbers(read.standing, read.radius, "", " when it stood", stood));
  analysis::add(out, breakout_numbers(read.at_end, read.radius, "_at_end", " at the end", begun));
  out.push_back({"hole_diameter", 2.0 * read.radius, "m", "diameter of the opening", ""});
  out.push_back({"hoop_distance", 0.5 * (hoop_ring[0] + hoop_ring[1]) * diameter, "m",
                 "from the wall to the middle of the ring that the hoop stress is a mean of", ""});
  out.push_back({"wall_to_edge", read.at_end ? share_to_edge(*read.at_end) : nan, "1",
                 "share of the wall whose loose rock reaches the edge of the block at the end", begun});
  out.push_back({"grains_in_radius", read.radius / diameter, "1", "radius / mean grain diameter", ""});
  analysis::add(out, initiation(branch, cracks));
  analysis::add(out, analysis::common_numbers(own, branch, cracks, read.path));
  // While it is excavated, no strain of the block leads to the collapse.
  if (!read.raised) std::erase_if(out, [](const Number& n) { return n.name == "wave_transits"; });
  // What has closed needs no fall of stress behind it to be sure.
  if (closed) std::erase_if(out, [](const Number& n) { return n.name == "peak_confirmed"; });
  return out;
}

}  // namespace phy::lab
