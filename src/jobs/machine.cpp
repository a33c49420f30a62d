#include "jobs/machine.hpp"

#include "base/parallel.hpp"
#include "system/process.hpp"

namespace phy::jobs {
int n_threads(int asked) {
  // Without threads of its own it speaks for the commands that it starts.
  return asked > 0 && has_threads() ? asked : system::n_processors();
}

study::MachineOptions machine_of(int asked_threads) {
  study::MachineOptions machine;
  // The widest always: results have the same bits by every instruction set.
  machine.isa = engine::native_isa();
  machine.threads = n_threads(asked_threads);
  return machine;
}

}  // namespace phy::jobs
