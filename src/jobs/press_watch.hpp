// The specimen in the press as others can see it while it is tested: a file in the folder of the results,
// rewritten up to four times a second, with its discs, how they have moved, what has broken, and the curve so
// far. `phyllite run` and calibrations leave the same one. Version 1; arrays are base64 of little-endian
// numbers:
//   specimen, test, over       its name, the kind of test, whether this is its end
//   strain, stress [Pa]        the curve so far, at most 400 points
//   width, height, bedding     the specimen [m]; theta, spacing, offset of regular planes
//   disc_quantum [m], discs    int16: x, y from the centre, and r of each disc
//   jointed                    uint8: 1 where the disc carries a joint
//   displacement_quantum [m]   of moves, int16: u_x, u_y of each disc
//   crack_kinds                names of the kinds, from 0
//   cracks                     pairs uint32: both discs; shapes int16: normal times 32767, length in disc
//                              quanta; kinds uint8
#pragma once
#include <chrono>
#include <ctime>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "records/running_test.hpp"

namespace phy::jobs {

/// Its name. It belongs to the program, and to no result: it goes when nothing is tested any more.
constexpr const char* press_file = ".press.json";

struct PressWatchOptions {
  std::chrono::milliseconds patience{3000};  ///< a test that has not been heard of for so long is over
  double most_share = 0.01;                  ///< of the CPU time of this process, for pictures
};

/// All may be called from any thread. A file that cannot be written is no failure: nobody will see it.
class PressWatch {
 public:
  explicit PressWatch(const std::string& folder, const PressWatchOptions& options = {});
  ~PressWatch();
  PressWatch(const PressWatch&) = delete;
  PressWatch& operator=(const PressWatch&) = delete;
  /// Of all tests that run one is shown, to its end and a moment longer, then the one that is heard next. The
  /// curves of all are kept, so that each is shown from its beginning.
  void reading(const RunningTest& now);
  /// Nothing is shown until a test is heard again; one that runs on keeps its beginning.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  struct Pressed {
    std::string head;  // what stays as it is: name, discs, layers
    std::vector<double> strain, stress;
    bool over = false;
    Clock::time_point heard;
  };
  std::string file_;
  PressWatchOptions options_;
  std::mutex mutex_;
  std::map<const Specimen*, Pressed> pressed_;  // the addresses are names: never followed
  const Specimen* shown_ = nullptr;             // of these
  Clock::time_point written_;
  double cost_ = 0.0;            // of the last picture [s]
  std::clock_t written_at_ = 0;  // CPU time of the process by then

  bool shown_is_over(Clock::time_point now) const;
  void choose(const RunningTest& test, Clock::time_point now);
  bool may_cost(bool over) const;
  void write(const RunningTest& test, Pressed& pressed);
};

}  // namespace phy::jobs
