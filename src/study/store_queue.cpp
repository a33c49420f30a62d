#include "study/store_queue.hpp"

#include <chrono>
#include <utility>

#include "base/check.hpp"
#include "base/parallel.hpp"
#include "io/toml_in.hpp"

namespace phy::study {
namespace {

constexpr auto renewal = std::chrono::seconds(20);  // well within lease_seconds

}  // namespace

StoreQueue::StoreQueue(const Plan& plan, Store& store, Hooks hooks, int n_workers)
    : PlanQueue(plan, n_workers), store_(store) {
  hooks_ = std::move(hooks);
  for (const Batch& batch : plan.batches) {
    std::vector<std::string> keys;
    for (const std::size_t t : batch.tests) keys.push_back(plan.tests[t].key);
    const auto rows = store.rows(keys);
    for (std::size_t i = 0; i < keys.size(); ++i)
      // A failed test counts as finished too: the same recipe would fail again.
      if (rows[i])
        finish(batch.tests[i], rows[i]->result.outcome.status);
      else
        enqueue(batch.tests[i]);
  }
  if (has_threads()) keeper_ = std::thread([this] { keep_claims(); });
}

StoreQueue::~StoreQueue() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  wake_.notify_all();
  if (keeper_.joinable()) keeper_.join();
}

/// Renews the claims while their tests run: a test may take longer than a lease.
void StoreQueue::keep_claims() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, renewal, [this] { return over_; })) {
    // The store has a lock of its own. Holding ours while the disk is slow would stop all workers.
    lock.unlock();
    try {
      store_.renew();
    } catch (const IoError&) {  // the next put() reports it; the lease is still valid
    }
    lock.lock();
  }
}

bool StoreQueue::claim(std::size_t test) {
  if (store_.claim(plan_.tests[test].key) == Claim::mine) return true;
  elsewhere_.push_back(test);  // or done meanwhile: refresh_claims() finds out
  return false;
}

/// Tests that other processes had claimed may be finished meanwhile, or free again because the process is
/// dead.
bool StoreQueue::refresh_claims() {
  std::vector<std::size_t> still;
  for (const std::size_t test : elsewhere_) {
    const std::string& key = plan_.tests[test].key;
    const Claim claim = store_.claim(key);
    if (claim == Claim::elsewhere) still.push_back(test);
    // Only whether it is free was asked; take() claims it for the worker that will run it.
    if (claim == Claim::mine) store_.release(key), enqueue(test);
    if (claim == Claim::done) finish(test, store_.rows({key}).front()->result.outcome.status);
  }
  elsewhere_ = std::move(still);
  return !elsewhere_.empty();
}

void StoreQueue::deliver_from(const std::string& host, std::size_t test, TestResult result) {
  const PlannedTest& t = plan_.tests[test];
  // An interrupted test has no result: another process, or the next run, may take it. A calibration has no
  // next run of a plan: where one rank alone was stopped the others take its tests.
  if (result.outcome.status == Status::interrupted) {
    store_.release(t.key);
    const std::lock_guard lock(mutex_);
    if (!stopped()) enqueue(test);
    return;
  }
  // Stored first, counted afterwards: what is reported as finished is on the disk.
  store_.put(t.key, io::write_recipe(t.recipe), result, host);
  const std::lock_guard lock(mutex_);
  report(test, result, !host.empty());
}

}  // namespace phy::study
