// Tests on several machines: MPI ranks whose workers take their tests from the task queue of rank 0.
//
// Rank 0 reads the files, owns the store and decides: a study, or a calibration that asks for plan after
// plan. The other ranks read nothing. They get every plan as recipes, work on it, and wait for the next one.
// Rank 0 has a worker for each of its threads as without MPI, and one more thread that answers the others:
// what next, here is a result, is there a stop. A request takes a millisecond and a block of cycles fifty, so
// no worker waits noticeably. A test gives the same bits on every rank, so the store has the hash of a run on
// threads.
//
// If a rank is lost, mpirun ends the others: finished tests are in the store, the same command goes on.
// Rejected: a store per rank with a merge at the end, which could not give work to the rank that runs dry
// first; that is what shards are for, where there is no MPI.
#pragma once
#include <atomic>

#include "study/work.hpp"

namespace phy::study {

struct Plan;
class StoreQueue;

/// MPI from construction to destruction; one object per process, made on all ranks. When rank 0 ends it the
/// others are let go. Throws InputError if the program was built without MPI.
class Ranks {
 public:
  /// `threads` of this rank.
  explicit Ranks(int threads);
  ~Ranks();  // NOLINT(performance-trivially-destructible): not with MPI
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Of all ranks.
  int n_threads() const { return n_threads_; }

 private:
  int rank_ = 0, size_ = 1, n_threads_ = 1;
};

/// Threads of all ranks; of this process, which has `threads`, where it is alone.
inline int n_workers(const Ranks* ranks, int threads) {
  return ranks != nullptr ? ranks->n_threads() : threads;
}

/// Rank 0: runs the tests of a plan like any study and serves the other ranks. The report is about all
/// workers of all ranks. Without ranks this process is alone.
WorkReport work_as_host(const Ranks* ranks, StoreQueue& queue, const Plan& plan,
                        const MachineOptions& machine);
/// The other ranks: plan after plan, until rank 0 lets them go. `stop` ends the work of this one soon: the
/// others go on without it, and take its tests.
void work_as_guest(const Ranks& ranks, const MachineOptions& machine, const std::atomic<bool>& stop);

}  // namespace phy::study
