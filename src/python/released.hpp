// Long work: done by a thread of its own without the interpreter lock, while the thread that called looks
// after Python's signals and hands progress on. A Ctrl-C, or an exception of the caller's function, sets the
// stop flag; the work then ends soon and keeps what is finished, as it does for the command.
#pragma once
#include <pybind11/pybind11.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace phy::python {

/// What the work has to say.
struct News {
  std::string text;
  std::size_t n_done = 0, n_total = 0;
};

class Watch {
 public:
  std::atomic<bool> stop{false};
  /// A line that is not to be missed.
  void say(std::string text);
  /// The state of things; the next one replaces it.
  void show(News news);
  /// What is to be handed on now. `all`: the state of things too, however fresh the last one is.
  std::vector<News> take(bool all);

 private:
  std::mutex mutex_;
  std::vector<News> lines_, state_;
  double shown_ = -1e9;  // [s] of the steady clock
};

/// Calls `work`, and `progress` (text, tests done, tests in all) with its news; None: nothing. Rethrows what
/// work or progress threw, or KeyboardInterrupt.
void run_released(const pybind11::object& progress, const std::function<void(Watch&)>& work);

}  // namespace phy::python
