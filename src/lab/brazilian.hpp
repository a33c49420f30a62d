// Brazilian test: a disc pressed along a diameter until it splits.
//
// The disc is cut from the middle of the recipe's packing (genesis/cut.hpp) and loaded along y; bedding at
// theta = 0 lies across the loading diameter. With test.loading_angle = 0 two flat rigid platens touch the
// rim where it stands out most; a few grains carry the load, and the rim may crush before the centre splits.
// With an angle (usual: 10 degrees) two rigid jaws hold that arc of the rim: every grain that a ray from
// outside meets first has a frictionless contact along its radius, stress-free at the start, as a jaw bedded
// on the rough rim. Platens and jaws approach at test.platen_speed each. Stop rule: lab_test.hpp.
//
// History: stress is the tension at the centre of an elastic isotropic disc under the platen force,
// 2P/(pi D t) times Hondros' factor for the arc; strain is the approach of the platens over the diameter.
// Numbers: analysis/brazilian.hpp.
#pragma once
#include "lab/lab_test.hpp"

namespace phy {

class BrazilianTest final : public LabTest {
 public:
  BrazilianTest(const std::shared_ptr<const Specimen>& specimen, const Recipe& recipe, LaneGroup& group,
                int lane);

 private:
  void drive() override;
  AnalysisOptions analysis() const override;
};

}  // namespace phy
