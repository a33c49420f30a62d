// Work on several threads, whose exceptions come back to the caller.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "base/option.hpp"

namespace phy {

#ifdef __EMSCRIPTEN__
extern "C" bool phyllite_begins_threads();  // src/system/process_web.cpp
/// Without, what is done on threads elsewhere is done one after the other.
inline bool has_threads() { return phyllite_begins_threads(); }
#else
constexpr bool has_threads() { return true; }
#endif

/// Calls work(i) for i = 0 ... n - 1, each on a thread of its own, and returns when all have ended. Each of
/// the n ends with leave(), also one for which there was no thread: the others may wait for it. The first
/// exception sets `broken`, so that the others can stop soon, and is thrown again at the end.
template <class Work, class Leave>
void on_threads(std::size_t n, std::atomic<bool>& broken, const Work& work, const Leave& leave) {
  std::mutex mutex;
  std::exception_ptr error;
  const auto fail = [&](const std::exception_ptr& e) {
    const std::lock_guard lock(mutex);
    if (!error) error = e;
    broken = true;
  };
  const auto run = [&](std::size_t i) {
    try {
      work(i);
    } catch (...) {
      fail(std::current_exception());
    }
    leave();
  };
  std::vector<std::thread> threads;
  threads.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!has_threads()) {
      run(i);
      continue;
    }
    try {
      threads.emplace_back(run, i);
    } catch (const std::system_error& e) {
      const std::string what = "thread " + std::to_string(i + 1) + " of " + std::to_string(n);
      fail(std::make_exception_ptr(
          std::system_error(e.code(), what + " cannot be started; use fewer (" + option("threads") + ")")));
      leave();
    }
  }
  for (std::thread& thread : threads) thread.join();
  if (error) std::rethrow_exception(error);
}

/// Calls worker(i) for i = 0 ... n - 1 on up to `threads` threads. Each thread has its own worker, made by
/// make_worker(): what a worker keeps from one piece to the next must not change any answer, since the order
/// of the pieces is open. After an exception no new piece is begun; the first one is thrown again at the end.
template <class MakeWorker>
void for_all(std::size_t n, int threads, const MakeWorker& make_worker) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> broken{false};
  on_threads(
      std::min(n, static_cast<std::size_t>(std::max(1, threads))), broken,
      [&](std::size_t) {
        auto worker = make_worker();
        for (std::size_t i = next++; i < n && !broken; i = next++) worker(i);
      },
      [] {});
}

}  // namespace phy
