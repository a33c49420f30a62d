// How long a calibration goes on: a range, from what lies ahead (calibrate/outlook.hpp) and the speed of this
// machine, which every stage that ends shows anew. The lower end counts the stages that will come, the upper
// one all that may.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "calibrate/outlook.hpp"
#include "calibrate/simulator.hpp"

namespace phy::jobs {

struct SecondsRange {
  double low = 0.0, high = 0.0;
};

/// Seconds of `threads` per unit of cost, as a short test on this machine shows; measured once.
double seconds_per_cost(int threads);

/// `course_expected`: tests and time of a calibration by one model, before it begins.
Finding expected_course(const calibrate::Outlook& outlook, int threads);

/// A clock fed with what happens; times are seconds since any one moment.
class TimeLeft {
 public:
  explicit TimeLeft(double seconds_per_cost) : first_speed_(seconds_per_cost) {}

  void outlook(const calibrate::Outlook& ahead, double now);
  /// False: it is no stage of its own, as moduli that are fitted again within another.
  bool begins(FindingKind stage, double now);
  void tests(const calibrate::TestProgress& progress);
  /// Nothing before an outlook.
  std::optional<SecondsRange> at(double now) const;

  /// Where the calibration is: the stage of how many at least and at most, in the model of at most how many.
  struct Place {
    int model = 0, models = 0;  ///< model 0: they are compared
    std::size_t stage = 0, least = 0, most = 0;
  };
  Place place() const;
  /// "model 1 of at most 3, stage 4 of 9 to 16, 2 to 9 min left"
  std::string text(double now) const;

 private:
  /// What the stages of a sort that have ended have shown of their speed: tests, and direct solutions.
  struct Speed {
    double prior = 0.0, cost = 0.0, seconds = 0.0;  // prior: what the first guess weighs, as cost
  };
  double first_speed_;  // [s per cost]
  Speed of_tests_, of_solutions_;
  std::optional<calibrate::Outlook> ahead_;
  std::size_t next_ = 0;   // behind the stage that runs, in those of the outlook
  std::size_t begun_ = 0;  // of this model
  double since_ = 0.0;
  calibrate::TestProgress tests_;

  SecondsRange of_stage(const calibrate::PlannedStage& stage) const;
  SecondsRange of_this_stage(double now) const;
  SecondsRange range_of(const Speed& speed, double least_cost, double most_cost) const;
  void end_stage(double now);
};

}  // namespace phy::jobs
