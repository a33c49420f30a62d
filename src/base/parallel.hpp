// A loop over independent pieces of work on several threads.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace phy {

/// Calls worker(i) for i = 0 ... n - 1 on up to `threads` threads. Each thread has its own worker, made by
/// make_worker(): what a worker keeps from one piece to the next must not change any answer, since the order
/// of the pieces is open. After an exception no new piece is begun; the first one is thrown again at the end.
template <class MakeWorker>
void for_all(std::size_t n, int threads, const MakeWorker& make_worker) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;
  const auto work = [&] {
    try {
      auto worker = make_worker();
      for (std::size_t i = next++; i < n; i = next++) worker(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
      next = n;
    }
  };
  {
    std::vector<std::jthread> workers;
    for (std::size_t i = 0; i < std::min(n, static_cast<std::size_t>(std::max(1, threads))); ++i)
      workers.emplace_back(work);
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace phy
