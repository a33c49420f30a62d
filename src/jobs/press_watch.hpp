// The specimen in the press as others can see it while it is tested: a file in the folder of the results,
// rewritten a few times a second, with its discs, how they have moved, what has broken, and the curve so far
// (docs/formats.md, "Press"). `phyllite run`, calibrations and Python leave the same one.
#pragma once
#include <chrono>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "records/running_test.hpp"

namespace phy::jobs {

/// Its name. It belongs to the program, and to no result: it goes when nothing is tested any more.
constexpr const char* press_file = ".press.json";

/// All may be called from any thread. A file that cannot be written is no failure: nobody will see it.
class PressWatch {
 public:
  /// A test that has not been heard of for `patience` is over.
  explicit PressWatch(const std::string& folder,
                      std::chrono::milliseconds patience = std::chrono::milliseconds(3000));
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
  std::chrono::milliseconds patience_;
  std::mutex mutex_;
  std::map<const Specimen*, Pressed> pressed_;  // the addresses are names: never followed
  const Specimen* shown_ = nullptr;             // of these
  Clock::time_point written_;

  bool shown_is_over(Clock::time_point now) const;
  void choose(const RunningTest& test, Clock::time_point now);
  void write(const RunningTest& test, Pressed& pressed);
};

}  // namespace phy::jobs
