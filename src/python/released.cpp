#include "python/released.hpp"

#include <chrono>
#include <condition_variable>
#include <optional>
#include <thread>
#include <utility>

#include "io/reads.hpp"

namespace phy::python {
namespace {

namespace py = pybind11;

// A notebook redraws its line with every call; thousands of tests would hang it.
constexpr double seconds_between_states = 1.0;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The end of the work, to be waited for.
class End {
 public:
  void come() {
    const std::lock_guard lock(mutex_);
    here_ = true;
    wake_.notify_all();
  }
  bool wait_a_little() {
    std::unique_lock lock(mutex_);
    // 50 ms is little for a person who presses Ctrl-C, and costs next to nothing.
    return wake_.wait_for(lock, std::chrono::milliseconds(50), [&] { return here_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool here_ = false;
};

/// Handlers of signals that have come, then news to the caller's function.
void attend(const py::object& progress, Watch& watch, bool all) {
  // Python only notes a signal; its handler runs when somebody asks, here.
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  // Called on the caller's thread: a function of Python must not be called from a worker.
  for (const News& news : watch.take(all))
    if (!progress.is_none()) progress(news.text, news.n_done, news.n_total);
}

}  // namespace

void Watch::say(std::string text) {
  const std::lock_guard lock(mutex_);
  lines_.push_back({std::move(text)});
}

void Watch::show(News news) {
  const std::lock_guard lock(mutex_);
  // Only the newest state counts, every line does.
  state_ = {std::move(news)};
}

std::vector<News> Watch::take(bool all) {
  const std::lock_guard lock(mutex_);
  std::vector<News> news = std::exchange(lines_, {});
  // At the end the last state is shown at once, or a bar would stop at 97 %.
  if (state_.empty() || (!all && now() - shown_ < seconds_between_states)) return news;
  shown_ = now();
  news.push_back(std::move(state_.front()));
  state_.clear();
  return news;
}

void run_released(const py::object& progress, const std::function<void(Watch&)>& work) {
  // What was read cannot be written over by the same job; reads of an earlier call must not count.
  io::forget_reads();
  Watch watch;
  End end;
  std::exception_ptr failure;
  // The work on a thread of its own, so that the caller's stays free for signals and news.
  std::thread worker([&] {
    try {
      work(watch);
      // An exception that leaves a thread ends the process, and with it the notebook.
    } catch (...) {
      failure = std::current_exception();
    }
    end.come();
  });
  std::optional<py::error_already_set> raised;
  for (bool ended = false; !ended;) {
    {
      // Released while waiting only: other threads of Python go on meanwhile.
      const py::gil_scoped_release release;
      ended = end.wait_a_little();
    }
    try {
      attend(progress, watch, ended && !failure);
    } catch (py::error_already_set& e) {  // a second one changes nothing: the work is ending
      // The tests in flight end first: data they write to must not go away under them.
      watch.stop = true;
      if (!raised) raised.emplace(e);
    }
  }
  // Before anything is thrown: the thread refers to what lies on this stack.
  worker.join();
  // The interrupt goes before what it has caused.
  if (raised) throw py::error_already_set(*raised);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace phy::python
