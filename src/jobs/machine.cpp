#include "jobs/machine.hpp"

#include <sched.h>

#include <algorithm>

namespace phy::jobs {
namespace {

int available_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return std::max(1, CPU_COUNT(&set));
}

}  // namespace

int n_threads(int asked) { return asked > 0 ? asked : available_cores(); }

study::MachineOptions machine_of(int asked_threads) {
  study::MachineOptions machine;
  machine.isa = engine::native_isa();
  machine.threads = n_threads(asked_threads);
  return machine;
}

}  // namespace phy::jobs
