// What all tests of the laboratory have in common, for one lane of a group.
//
// Phases
//   settle    only for packings with a locked-in stress: breakage off, no bodies, damped cycles until the
//             mean unbalanced force is below 1e-3 of the mean contact force (joints replace bonds, walls
//             have gone)
//   prepare   the boundary is in place; what a kind of test does before it loads (affine pre-strain,
//             confinement)
//   load      up to test.approach_strain at test.approach_speed, then at test.platen_speed; a history row
//             every test.history_interval cycles, until the stop rule, the watchdog or the user ends it
// Stop rule, of the stress and strain that the kind calls its own (reading): the stress has fallen to
// test.stop_at of its peak; the strain exceeds that of the peak by test.post_peak without a new one; or
// test.max_strain is reached. A peak needs three broken bonds. A test that has reached test.max_strain and
// may harden has peaked all the same, or has a knee, where analysis/strength_rule.hpp finds one; else it has
// not peaked. The test reads rows and decides; the group computes. Strains count from the moment the boundary
// is in place.
#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/energy.hpp"
#include "analysis/strength_rule.hpp"
#include "engine/lane_group.hpp"
#include "events/recorder.hpp"
#include "lab/boundaries.hpp"
#include "lab/moments.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/running_test.hpp"
#include "records/specimen.hpp"
#include "records/test_description.hpp"

namespace phy::lab {

/// What is tested, and what holds it.
struct TestSetup {
  std::shared_ptr<const Specimen> specimen;
  const Recipe& recipe;  ///< outlives the test
  std::shared_ptr<const TestBoundary> boundary;
};

class Procedure {
 public:
  /// The group outlives the test.
  Procedure(TestSetup setup, engine::LaneGroup& group, int lane);
  virtual ~Procedure() = default;
  Procedure(Procedure&&) = default;
  /// Loads the specimen into the lane: before the first block, and to start over.
  void begin();
  /// Reads the lane after a block. True when the test is over.
  bool after_block();
  /// Ends an unfinished test.
  void interrupt();
  /// Goes on in a lane of another group of the same packing; no bit of the result changes.
  void move_to(engine::LaneGroup& group, int lane);
  /// The result; call once, when over.
  TestResult take_result();
  /// Strain over the strain at which the test would give up: a lower bound of the progress, 0 ... 1.
  double progress() const;
  /// What the stop rule watches, growing while the test loads: stress [Pa] and strain.
  struct Reading {
    double stress = 0.0, strain = 0.0;
  };
  /// After the last block; zeros before there is a row.
  Reading latest() const;
  /// Grains and cracks as they are.
  SpecimenNow now() const;

 protected:
  /// The boundary is in place: prepare, or call start_loading.
  virtual void on_placed() { start_loading(); }
  /// After a block of preparation: ends with start_loading or begin. True when the test is over.
  virtual bool prepare(std::int64_t /*n_blocks*/) { return false; }
  /// The watchdog has rejected what was prepared: begin without it? False: there is no other way.
  virtual bool begin_without() { return false; }
  /// Sets the bodies in motion: at the start of loading, and where the approach ends.
  virtual void prescribe_motion() = 0;
  virtual double max_strain() const { return recipe_.test.max_strain; }
  /// After each row of the history: how the test goes on. True when it is over.
  virtual bool after_row() { return false; }
  /// The stop rule is awake: what the test calls its stress may fall from now on.
  virtual bool may_peak() const { return true; }
  /// The test is over, its numbers are not yet read.
  virtual void finish() {}
  /// What the history of this test holds beyond strain and stress of its bodies (which `row` has already).
  virtual void read_more(HistoryRow& /*row*/) {}
  /// The numbers of the test, from result_. `path`: of a wave along the height of the specimen.
  virtual std::vector<Number> numbers(const analysis::WavePath& path) const = 0;

  /// What ends this test as peaked, for those who read its history.
  analysis::StopRule stop_rule() const { return {recipe_.test.stop_at, recipe_.test.post_peak}; }
  void start_loading();
  /// Of the bodies that load, before and behind the ramp that begins [m/s].
  struct Speeds {
    double before, now;
  };
  Speeds speeds() const;
  /// Time of a ramp in which two bodies come nearer by test.ramp_strain of `length` [s].
  double ramp_over(double length, const Speeds& speed) const;
  /// Both platens, bodies 0 and 1, close at their speed after test.ramp_strain of `length` [m].
  void close_platens(double length);
  bool end(Status status, std::string reason, std::string advice);
  /// While a stress is prepared: after each block, whether it has reached its full target and lies within
  /// `tolerance` of it. Loads once it has done so for some blocks; gives up (true: the test is over) when it
  /// never does.
  bool load_once_steady(bool at_target, double stress_over_target, double tolerance);
  const Packing& packing() const { return *specimen_->packing; }
  /// Bodies and axes, as they were put in place.
  const engine::Boundary& boundary() const { return boundary_->boundary; }
  /// State at the end of the block: the group's row with the strain and stress of this test.
  const HistoryRow& latest_row() const { return row_; }

  std::shared_ptr<const Specimen> specimen_;
  const Recipe& recipe_;
  engine::LaneGroup* group_;
  int lane_;
  TestResult result_;

 private:
  enum class Phase { settle, prepare, load, over };
  const TestDescription& test() const { return *recipe_.test.kind; }
  Reading reading(const HistoryRow& row) const;
  /// "strain 0.1234 %"; where a displacement loads, that, over the width.
  std::string extent(double strain, int digits) const;
  void place_boundary();
  void read_row();
  void write_load();
  void zero_strains();
  Snapshot snapshot() const;
  Frame frame() const;
  void keep_pictures();
  double thickness_of_events() const;  ///< [m]
  void begin_events();
  void keep_events();
  CrackEvent crack_of(const engine::Breakage& broken) const;
  /// All numbers of the test. What is beyond a limit of quality ends it with another outcome, or explains why
  /// it found no peak.
  void read_numbers();
  /// A test at its largest strain may have a strength all the same: a first peak, or a knee.
  double value(const std::string& name) const;  // of a number of the result
  void judge_approach();
  void accept_strength();
  void note_fall(double strain, double stress);  // behind a peak whose test ended before its end of fall
  void end_approach(double strain);
  bool check_stop();
  bool end_without_peak(const Reading& now);
  bool end_without_cracks(const std::string& what);
  bool end_unstable(const engine::LaneHealth& health);

  std::shared_ptr<const TestBoundary> boundary_;
  HistoryRow row_;
  double zero_axial_ = 0.0, zero_lateral_ = 0.0;  // where strains count from
  Phase phase_ = Phase::settle;
  bool approaching_ = false;                                            // at test.approach_speed
  std::int64_t loads_from_ = std::numeric_limits<std::int64_t>::max();  // cycle
  std::int64_t blocks_ = 0;                                             // in this phase
  std::int64_t n_at_target_ = 0;  // blocks of preparation at the full target
  std::int64_t n_steady_ = 0;     // of these, in a row close to it
  Moments<Snapshot> snapshots_;
  Moments<Frame> frames_;
  std::optional<events::Recorder> events_;
  std::size_t cracks_seen_ = 0;  // by events_
  Reading peak_;
};

/// The result of a test that has not begun: it knows whose it is.
TestResult blank_result(const Specimen& specimen, TestKind kind);

}  // namespace phy::lab
