#include "cli/machine.hpp"

#include <sched.h>

#include <algorithm>
#include <cctype>
#include <csignal>

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

std::string folder_name(const std::string& name) {
  std::string folder;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.')
      folder += c;
    else if (!folder.ends_with('_'))
      folder += '_';
  return folder;
}

}  // namespace phy
