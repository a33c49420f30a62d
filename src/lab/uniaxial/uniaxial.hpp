// Uniaxial compression between two rigid platens, as a rock laboratory does it.
//
//   prepare   only with test.jump_strain > 0: affine strain with breakage off, damped cycles; if a bond or
//             joint is then at its strength the specimen starts again without the jump
//   load      both platens close at test.platen_speed after a short ramp
//
// History: stress is the mean platen force over the initial width, strain the closure over the initial
// height. Numbers: analysis/analyse.hpp. Common phases and stop rule: lab_test.hpp.
#pragma once
#include "lab/room.hpp"

namespace phy::lab {

class UniaxialTest final : public LabTest {
 public:
  UniaxialTest(const std::shared_ptr<const Specimen>& specimen, const Recipe& recipe,
               engine::LaneGroup& group, int lane);

 private:
  void on_placed() override;
  bool prepare(std::int64_t n_blocks) override;
  void drive() override;
  double first_stop_strain() const override { return 2e-4; }
  std::vector<Number> numbers(const analysis::WavePath& path) const override;

  bool may_jump_;
  bool jumped_ = false;  // the jump was made and kept
};

const TestRoom& uniaxial_room();

}  // namespace phy::lab
