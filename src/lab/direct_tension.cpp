#include "lab/direct_tension.hpp"

#include <algorithm>

#include "lab/rigs.hpp"

namespace phy {

DirectTensionTest::DirectTensionTest(const std::shared_ptr<const Specimen>& specimen, const Recipe& recipe,
                                     LaneGroup& group, int lane)
    : LabTest(specimen, recipe, group, lane) {
  begin();
}

void DirectTensionTest::drive() {
  const double speed = recipe_.test.platen_speed;
  const double grip = grip_thickness(recipe_, packing()), free = packing().height - 2.0 * grip;
  group_->drive(lane_, 0, {{0.0, -speed}, 0.0, {}, {}});
  group_->drive(lane_, 1, {{0.0, speed}, 0.0, {}, {}});
  group_->start_moving(lane_, [&](Vec2 x) {
    return Vec2{0.0, speed * std::clamp(2.0 * (x.y - grip) / free - 1.0, -1.0, 1.0)};
  });
}

AnalysisOptions DirectTensionTest::analysis() const {
  AnalysisOptions options;
  options.grip_thickness = grip_thickness(recipe_, packing());
  return options;
}

}  // namespace phy
