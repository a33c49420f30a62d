#include "cli/machine.hpp"

#include <sched.h>

#include <algorithm>
#include <csignal>

#include "base/check.hpp"
#include "io/program.hpp"

namespace phy {
namespace {

std::atomic<bool> stop_requested{false};
void on_interrupt(int) {
  stop_requested = true;
  std::signal(SIGINT, SIG_DFL);
}

int available_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return std::max(1, CPU_COUNT(&set));
}

}  // namespace

int n_threads(const Session& session) { return session.threads > 0 ? session.threads : available_cores(); }

MachineOptions machine_of(const Session& session) {
  MachineOptions machine;
  machine.isa = native_isa();
  machine.threads = n_threads(session);
  return machine;
}

const std::atomic<bool>* stop_on_interrupt() {
  static const auto before = std::signal(SIGINT, on_interrupt);  // once
  static_cast<void>(before);
  return &stop_requested;
}

void make_file_or_stop(const std::string& path,
                       const std::function<void(const std::string& temporary)>& make) {
  stop_on_interrupt();
  try {
    make_file(path, make);
  } catch (const IoError&) {
    if (!stop_requested) throw;  // else the other program has ended with this one's Ctrl-C
    throw IoError(path + ": interrupted, nothing was written");
  }
}

}  // namespace phy
