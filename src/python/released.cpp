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
    return wake_.wait_for(lock, std::chrono::milliseconds(50), [&] { return here_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool here_ = false;
};

/// Handlers of signals that have come, then news to the caller's function.
void attend(const py::object& progress, Watch& watch, bool all) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
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
  state_ = {std::move(news)};
}

std::vector<News> Watch::take(bool all) {
  const std::lock_guard lock(mutex_);
  std::vector<News> news = std::exchange(lines_, {});
  if (state_.empty() || (!all && now() - shown_ < seconds_between_states)) return news;
  shown_ = now();
  news.push_back(std::move(state_.front()));
  state_.clear();
  return news;
}

void run_released(const py::object& progress, const std::function<void(Watch&)>& work) {
  io::forget_reads();
  Watch watch;
  End end;
  std::exception_ptr failure;
  std::thread worker([&] {
    try {
      work(watch);
    } catch (...) {
      failure = std::current_exception();
    }
    end.come();
  });
  std::optional<py::error_already_set> raised;
  for (bool ended = false; !ended;) {
    {
      const py::gil_scoped_release release;
      ended = end.wait_a_little();
    }
    try {
      attend(progress, watch, ended && !failure);
    } catch (py::error_already_set& e) {  // a second one changes nothing: the work is ending
      watch.stop = true;
      if (!raised) raised.emplace(e);
    }
  }
  worker.join();
  if (raised) throw py::error_already_set(*raised);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace phy::python
