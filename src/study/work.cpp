#include "study/work.hpp"

#include <algorithm>

namespace phy::study {

double Progress::seconds_left(double seconds) const {
  // Expected costs are guesses with a common factor, which finished tests reveal: work done over work
  // expected.
  if (!(cost_new > 0.0 && work_new > 0.0)) return 0.0;
  return seconds * std::max(0.0, work_new / cost_new * (cost_new + cost_left) - work) / work;
}

void LaneUse::add(const LaneUse& other) {
  test_steps += other.test_steps, lane_steps += other.lane_steps, alone_steps += other.alone_steps;
  contact_steps += other.contact_steps, seconds += other.seconds;
}

}  // namespace phy::study
