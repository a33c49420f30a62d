// Small groups made by hand, for the tests of the engine.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "base/exact_math.hpp"
#include "engine/lane_group.hpp"
#include "records/assembly.hpp"

namespace phy::engine {

inline constexpr Precision both_precisions[] = {Precision::double_precision, Precision::single_precision};

/// Of this machine: 4, in double 2 where its registers hold no more.
inline int some_lanes(Precision precision) { return std::min(4, native_lanes(precision, native_isa())); }

/// A group of these lanes, 0: some_lanes(), on this machine's instruction set.
inline std::unique_ptr<LaneGroup> small_group(const Specimen& s, Precision precision, int interval,
                                              int lanes = 0) {
  GroupOptions options;
  options.isa = native_isa();
  options.precision = precision;
  options.lanes = lanes > 0 ? lanes : some_lanes(precision);
  options.interval = interval;
  return make_group(s.packing, options);
}

inline std::shared_ptr<const Specimen> shared(Specimen s) {
  return std::make_shared<const Specimen>(std::move(s));
}
inline std::shared_ptr<const Boundary> shared(Boundary boundary) {
  return std::make_shared<const Boundary>(std::move(boundary));
}

/// A body that touches grains 0 ... n - 1 and pushes along +x (direction 1) or -x (-1).
inline BoundaryBody pusher(std::uint32_t n, double direction) {
  BoundaryBody t;
  for (std::uint32_t i = 0; i < n; ++i) t.touches.push_back({i, {direction, 0.0}, 0.0});
  return t;
}

/// Two loose discs of radius R side by side, `gap` apart, in a group without damping at a fiftieth of the
/// stable step, where a collision keeps its energy within 5e-3. The body that gives the step its stiffness is
/// placed with `jacket` only.
struct TwoDiscs {
  static constexpr double R = 3e-4, skin = 0.25 * R;
  MatrixRecipe m;
  double mass = m.density * pi * R * R, block = 0.0;
  std::unique_ptr<LaneGroup> group;

  TwoDiscs(double gap, bool jacket, Precision precision) {
    const auto s = std::make_shared<const Specimen>(assembly({{R, R, R}, {3.0 * R + gap, R, R}}, m));
    GroupOptions options;
    options.isa = native_isa();
    options.precision = precision;
    options.lanes = some_lanes(precision);
    options.interval = 400;
    group = make_group(s->packing, options);
    Boundary boundary;
    boundary.bodies = {pusher(2, 1.0)};
    for (Touch& t : boundary.bodies[0].touches) t.gap = 0.5 * R;  // counts for the step, is never reached
    boundary.jacket.sides = jacket;
    LaneSetup setup;
    setup.damping = 0.0, setup.step_safety = 0.02;
    setup.boundary = std::make_shared<const Boundary>(boundary);
    group->load(0, s, setup);
    if (jacket) group->place_boundary(0);
    block = group->time_step(0) * options.interval;
  }
  double moved(std::size_t disc) const { return group->grains(0)[disc].ux; }
};

}  // namespace phy::engine
