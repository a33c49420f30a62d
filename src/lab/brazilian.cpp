#include "lab/brazilian.hpp"

#include "genesis/cut.hpp"
#include "lab/rigs.hpp"

namespace phy {

BrazilianTest::BrazilianTest(std::shared_ptr<const Specimen> specimen, const Recipe& recipe, LaneGroup& group,
                             int lane)
    : LabTest(specimen, recipe, group, lane,
              jaws(*specimen->packing, disc_diameter(recipe), recipe.test.loading_angle)) {
  begin();
}

void BrazilianTest::drive() {
  const double speed = recipe_.test.platen_speed;
  const double ramp = recipe_.test.ramp_strain * disc_diameter(recipe_) / speed;
  group_.drive(lane_, 0, {{0.0, speed}, ramp, {}, {}});
  group_.drive(lane_, 1, {{0.0, -speed}, ramp, {}, {}});
}

AnalysisOptions BrazilianTest::analysis() const {
  AnalysisOptions options;
  options.disc_diameter = disc_diameter(recipe_);
  return options;
}

}  // namespace phy
