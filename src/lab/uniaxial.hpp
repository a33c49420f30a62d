// Uniaxial compression between two rigid platens, as a rock laboratory does it, for one lane of a group.
//
// Phases of a test
//   settle     only for packings with a locked-in stress: breakage off, no platens, damped cycles until the
//   mean
//              unbalanced force is below 1e-3 of the mean contact force (joints replace bonds, walls have
//              gone)
//   jump       only with test.jump_strain > 0: affine strain with breakage off, damped cycles; if a bond or
//   joint is then
//              at its strength the specimen starts again without the jump
//   load       both platens close at test.platen_speed after a short ramp; a history row every
//   test.history_interval
//              cycles; ends when the stress has fallen to test.stop_at of the peak, when the strain has
//              exceeded that of the peak by test.post_peak without a new one, at test.max_strain (not
//              peaked), when the watchdog objects (unstable) or when the user stops (interrupted)
// The test reads rows and decides; the group computes. Strains count from the moment the platens touch.
#pragma once
#include <memory>

#include "engine/lane_group.hpp"
#include "lab/moments.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy {

class UniaxialTest {
 public:
  /// Loads the specimen into a lane of the group. Both outlive the test.
  UniaxialTest(std::shared_ptr<const Specimen> specimen, const Recipe& recipe, LaneGroup& group, int lane);
  /// Reads the lane after a block. True when the test is over.
  bool after_block();
  /// Ends an unfinished test.
  void interrupt();
  /// The result; call once, when over.
  TestResult take_result();
  /// Axial strain over the strain at which the test would give up: a lower bound of the progress, 0 ... 1.
  double progress() const;

 private:
  enum class Phase { settle, jump, load, over };
  void start_loading();
  void begin();
  Frame frame() const;
  void keep_pictures();
  bool end(Status status, std::string reason, std::string advice);
  bool check_stop();

  std::shared_ptr<const Specimen> specimen_;
  const Recipe& recipe_;
  LaneGroup& group_;
  int lane_;
  Phase phase_ = Phase::settle;
  bool may_jump_;
  bool jumped_ = false;      // the jump was made and kept
  std::int64_t blocks_ = 0;  // in this phase
  Moments<Snapshot> snapshots_;
  Moments<Frame> frames_;
  double peak_ = 0.0, peak_strain_ = 0.0;
  TestResult result_;
};

}  // namespace phy
