// A study on several machines: MPI ranks whose workers take their tests from the task queue of rank 0.
//
// Rank 0 owns the store, has a worker for each of its threads like any study, and one more thread that
// answers the other ranks: what next, here is a result, is there a stop. A request takes a millisecond and a
// block of cycles fifty, so no worker waits noticeably. Every rank makes the plan by itself; that all made
// the same one is checked. A test gives the same bits on every rank, so the store has the hash of a run on
// threads.
//
// If a rank is lost, mpirun ends the others: finished tests are in the store, the same command goes on.
// Rejected: a store per rank with a merge at the end, which could not give work to the rank that runs dry
// first; that is what shards are for, where there is no MPI.
#pragma once
#include "study/store_queue.hpp"
#include "study/worker.hpp"

namespace phy::study {

/// MPI from construction to destruction; one object per process. Throws InputError if the program was built
/// without MPI.
class Ranks {
 public:
  Ranks();
  ~Ranks();  // NOLINT(performance-trivially-destructible): not with MPI
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Sum over all ranks, on all ranks.
  int sum(int value) const;
  /// Throws InputError on every rank unless all hold the same plan.
  void check_same(const Plan& plan) const;

 private:
  int rank_ = 0, size_ = 1;
};

/// Rank 0: runs tests like any study and serves the other ranks. The report is about all workers of all
/// ranks.
WorkReport work_as_host(const Ranks& ranks, StoreQueue& queue, const Plan& plan,
                        const MachineOptions& machine);
/// The other ranks. `stop` ends this one soon: rank 0 goes on without it, its tests are left for a resume.
void work_as_guest(const Ranks& ranks, const Plan& plan, const MachineOptions& machine,
                   const std::atomic<bool>& stop);

}  // namespace phy::study
