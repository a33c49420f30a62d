// The tests of a plan that a store does not hold yet. A test is claimed before it is given out, so that other
// processes on the same store leave it alone, and stored as soon as it is there.
#pragma once
#include <condition_variable>
#include <string>
#include <thread>
#include <vector>

#include "study/store.hpp"
#include "study/task_queue.hpp"

namespace phy::study {

class StoreQueue : public PlanQueue {
 public:
  StoreQueue(const Plan& plan, Store& store, Hooks hooks, int n_workers);
  ~StoreQueue() override;
  void deliver(std::size_t test, TestResult result) override { deliver_from("", test, std::move(result)); }
  /// A result of another host; "": of this one.
  void deliver_from(const std::string& host, std::size_t test, TestResult result);

 private:
  bool claim(std::size_t test) override;
  bool refresh_claims() override;
  void keep_claims();

  Store& store_;
  std::vector<std::size_t> elsewhere_;  // claimed by other processes
  std::condition_variable wake_;
  bool over_ = false;
  std::thread keeper_;
};

}  // namespace phy::study
