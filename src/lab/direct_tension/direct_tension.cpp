#include "lab/direct_tension/direct_tension.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/units.hpp"
#include "lab/boundaries.hpp"
#include "lab/direct_tension/reading.hpp"

namespace phy::lab {

double grip_thickness(const Recipe& recipe, const Packing& packing) {
  if (recipe.test.grip_thickness > 0.0) return recipe.test.grip_thickness;
  double largest = 0.0;
  for (const Disc& d : packing.discs) largest = std::max(largest, d.r);
  // Some two layers of grains: one would be torn out by its own few bonds.
  return 4.0 * largest;
}

TestBoundary grips(const Packing& packing, double thickness) {
  TestBoundary pull;
  engine::Boundary& boundary = pull.boundary;
  // No walls: a grip takes hold of whole grains.
  boundary.bodies = {{"bottom grip", {}, {}, false}, {"top grip", {}, {}, false}};
  for (std::uint32_t i = 0; i < packing.discs.size(); ++i) {
    const double y = packing.discs[i].y;
    // Free sideways and to turn: held, the ends could not contract, and would start the crack.
    if (y < thickness) boundary.bodies[0].grips.push_back({i, false, true, false});
    if (y > packing.height - thickness) boundary.bodies[1].grips.push_back({i, false, true, false});
  }
  // Strain counts over the length between the grips, which do not stretch.
  set_axial(pull, 0, 1, {0.0, 1.0}, {packing.height - 2.0 * thickness, packing.width});
  return pull;
}

namespace {

class DirectTensionTest final : public Procedure {
 public:
  using Procedure::Procedure;

 private:
  void prescribe_motion() override;
  std::vector<Number> numbers(const analysis::WavePath& path) const override;
};

void DirectTensionTest::prescribe_motion() {
  const Speeds speed = speeds();
  const double grip = grip_thickness(recipe_, packing()), free = packing().height - 2.0 * grip;
  // From rest the specimen is set in motion as a whole; only a change of speed needs a ramp.
  const double ramp = speed.before > 0.0 ? ramp_over(free, speed) : 0.0;
  for (const auto& [body, way] : {std::pair(0, -1.0), std::pair(1, 1.0)})
    group_->prescribe(
        lane_, body, {.velocity = {0.0, way * speed.now}, .ramp = ramp, .before = {0.0, way * speed.before}});
  if (speed.before > 0.0) return;
  group_->start_moving(lane_, [&](Vec2 x) {
    // Velocities linear from grip to grip: no wave runs in from the ends.
    return Vec2{0.0, speed.now * std::clamp(2.0 * (x.y - grip) / free - 1.0, -1.0, 1.0)};
  });
}

std::vector<Number> DirectTensionTest::numbers(const analysis::WavePath& path) const {
  return tension_numbers(result_.history, result_.cracks, grip_thickness(recipe_, packing()), path);
}

TestDescription description() {
  TestDescription d;
  d.name = "direct_tension", d.stress = "tension", d.body = "grip";
  d.columns =
      joined({clock_columns(),
              {{"axial_strain", "1", "approach of the grips / free length between them: negative",
                &HistoryRow::axial_strain}},
              gauge_columns(),
              {{"axial_stress", "Pa", "mean grip force / initial width, tension negative",
                &HistoryRow::axial_stress},
               {"grip_stress_top", "Pa", "top grip force / initial width", &HistoryRow::stress_top},
               {"grip_stress_bottom", "Pa", "bottom grip force / initial width", &HistoryRow::stress_bottom}},
              balance_columns()});
  d.hashed = hashed_fields({"axial_strain", "axial_strain_gauge", "lateral_strain_gauge", "axial_stress",
                            "grip_stress_top", "grip_stress_bottom"});
  // Tension is negative in the history, and drawn upwards.
  d.curve.strain = "elongation", d.curve.stress = "tensile stress", d.curve.sign = -1.0;
  d.curve.strength = "sigma_t", d.curve.strength_label = "direct tensile strength";
  d.table = {{"E tan50", "GPa", "E_tangent", 1e-9, 2},
             {"nu", "", "nu", 1.0, 3},
             {"sigma_t", "MPa", "sigma_t", 1e-6, 2},
             {"sigma_ci", "MPa", "sigma_ci", 1e-6, 2},
             {"cracks at", "the grips", "failure_at_grip", 1.0, 2}};
  d.loading_text = [](const Recipe& r) {
    return fmt::format("Grips on both ends, free to move sideways, pulled at {}; the sides were free.",
                       speed_text(r.test));
  };
  return d;
}

}  // namespace

const TestRoom& direct_tension_room() {
  static const TestRoom room = {
      description(),
      [](const Recipe& r) { return "direct_tension" + print_number(r.test.grip_thickness); },
      [](const Packing& packing, const Recipe& r) { return grips(packing, grip_thickness(r, packing)); },
      begin_test<DirectTensionTest>,
      {"test.grip_thickness", &TestRecipe::grip_thickness, "grips that reach discs",
       "raise it, or leave it out (four largest radii)"}};
  return room;
}

}  // namespace phy::lab
