#include "study/task_queue.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"

namespace phy::study {

PlanQueue::PlanQueue(const Plan& plan, int n_workers)
    : plan_(plan),
      n_workers_(static_cast<std::size_t>(n_workers)),
      waiting_(plan.batches.size()),
      n_inside_(plan.batches.size()) {
  for (const Batch& batch : plan.batches) {
    progress_.n_total += batch.tests.size();
    for (const std::size_t t : batch.tests) progress_.cost_left += plan.tests[t].cost;
  }
}

PlanQueue::PlanQueue(const Plan& plan, Hooks hooks, int n_workers) : PlanQueue(plan, n_workers) {
  hooks_ = std::move(hooks);
  for (const Batch& batch : plan.batches)
    for (const std::size_t t : batch.tests) enqueue(t);
}

void PlanQueue::finish(std::size_t test, Status status) {
  ++progress_.n_done;
  progress_.n_failed += has_answer(status) ? 0 : 1;
  progress_.cost_left -= plan_.tests[test].cost;
}

void PlanQueue::enqueue(std::size_t test) {
  Group& group = group_of(test);
  group.tests.push_back(test);
  group.work += plan_.tests[test].cost;
}

std::size_t PlanQueue::n_waiting(std::size_t batch) const {
  std::size_t n = 0;
  for (const auto& [number, group] : waiting_[batch]) n += group.tests.size();
  return n;
}

/// The batch with most tests waiting per worker already there (the new one counted): workers spread over the
/// packings. The number of batches where none waits.
std::size_t PlanQueue::best_batch() const {
  std::size_t best = waiting_.size();
  double most = 0.0;
  for (std::size_t b = 0; b < waiting_.size(); ++b) {
    const double share = static_cast<double>(n_waiting(b)) / static_cast<double>(n_inside_[b] + 1);
    if (share > most) most = share, best = b;
  }
  return best;
}

Assignment PlanQueue::enter() {
  const std::lock_guard lock(mutex_);
  if (stopped()) return {};
  std::size_t batch = best_batch();
  bool elsewhere = false;
  // Only when nothing waits: every claim that is looked at is a transaction of the store.
  if (batch == waiting_.size()) elsewhere = refresh_claims(), batch = best_batch();
  if (batch == waiting_.size())
    return {elsewhere ? Assignment::Kind::wait : Assignment::Kind::finished, 0, 0};
  // A fair share of all tests that wait, rounded up: it decides how many lanes the worker opens.
  std::size_t n = 0;
  for (std::size_t b = 0; b < waiting_.size(); ++b) n += n_waiting(b);
  ++n_inside_[batch];
  return {Assignment::Kind::work, batch, std::min(n_waiting(batch), (n + n_workers_ - 1) / n_workers_)};
}

void PlanQueue::leave(std::size_t batch, std::optional<std::size_t> last) {
  const std::lock_guard lock(mutex_);
  --n_inside_[batch];
  if (last) --group_of(*last).n_at;
}

/// The group of the last test. When none of it is left, a new group begins: the one with the most work per
/// worker times its longest test. Work alone would begin long tests late and leave workers idle at the end;
/// length alone would bring all angles together in one lane batch.
PlanQueue::Group& PlanQueue::choose(std::size_t batch, std::optional<std::size_t> last) {
  if (last && !group_of(*last).tests.empty()) return group_of(*last);
  const auto urgency = [&](const Group& g) {
    return g.work / (1.0 + g.n_at) * plan_.tests[g.tests.front()].cost;
  };
  Group* best = nullptr;
  for (auto& [number, group] : waiting_[batch])
    if (!group.tests.empty() && (best == nullptr || urgency(group) > urgency(*best))) best = &group;
  PHY_CHECK(best != nullptr, "a test waits in the batch");
  return *best;
}

std::optional<std::size_t> PlanQueue::take(std::size_t batch, std::optional<std::size_t> last) {
  const std::lock_guard lock(mutex_);
  // Claiming can fail where another process was faster: then the next test is tried.
  while (n_waiting(batch) > 0 && !stopped()) {
    Group& group = choose(batch, last);
    const std::size_t test = group.tests.front();
    group.tests.pop_front();
    group.work -= plan_.tests[test].cost;
    if (!claim(test)) continue;
    if (last) --group_of(*last).n_at;
    ++group.n_at;
    return test;
  }
  return {};
}

void PlanQueue::deliver(std::size_t test, TestResult result) {
  const std::lock_guard lock(mutex_);
  report(test, result, false);
}

void PlanQueue::report(std::size_t test, TestResult& result, bool on_guest) {
  // An interrupted test is not finished; what it has measured so far is shown all the same.
  if (result.outcome.status != Status::interrupted) {
    finish(test, result.outcome.status);
    ++progress_.n_new;
    progress_.n_guest += on_guest ? 1 : 0;
    progress_.cost_new += plan_.tests[test].cost;
    progress_.work_new += static_cast<double>(result.n_steps * result.n_grains);
  }
  if (hooks_.on_result) hooks_.on_result(test, result);
  if (hooks_.on_progress) hooks_.on_progress(progress_);
}

void PlanQueue::count(double work) {
  const std::lock_guard lock(mutex_);
  progress_.work += work;
  if (hooks_.on_progress) hooks_.on_progress(progress_);
}

void PlanQueue::read(std::size_t test, const RunningTest& now) {
  // Without a listener no lock is taken, which happens once per block.
  if (!hooks_.on_reading) return;
  const std::lock_guard lock(mutex_);
  hooks_.on_reading(test, now);
}

Progress PlanQueue::progress() {
  const std::lock_guard lock(mutex_);
  return progress_;
}

}  // namespace phy::study
