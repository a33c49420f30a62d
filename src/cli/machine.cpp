#include "cli/machine.hpp"

#include <fmt/format.h>

#include <csignal>

#include "base/check.hpp"
#include "io/program.hpp"
#include "jobs/machine.hpp"

namespace phy::cli {
namespace {

std::atomic<bool> stop_requested{false};

/// The second one ends the program, as it would have without this. Not SIGHUP: of a terminal that closes,
/// kernel and shell both tell.
void on_signal(int signal) {
  // Only flags and signals here: nothing else is allowed in a handler.
  if (!stop_requested.exchange(true) || signal == SIGHUP) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Ctrl-C, what batch systems and `kill` send, a terminal that has closed. Under nohup SIGHUP comes ignored,
/// and stays so.
bool catch_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (signal != SIGHUP || action.sa_handler != SIG_IGN) std::signal(signal, on_signal);
  }
  return true;
}

}  // namespace

int n_threads(const Session& session) { return jobs::n_threads(session.threads); }

std::string speed_words(const TestRecipe& test) {
  std::string words = fmt::format("{:.3f} m/s per platen", test.platen_speed);
  if (test.approach_strain > 0.0)
    words +=
        fmt::format(" behind {:.3f} m/s up to a strain of {:g}", test.approach_speed, test.approach_strain);
  return words;
}

study::MachineOptions machine_of(const Session& session) { return jobs::machine_of(session.threads); }

const std::atomic<bool>* stop_on_interrupt() {
  // Not at the start: until input has been read a signal should simply end the program.
  static const bool once = catch_signals();
  static_cast<void>(once);
  return &stop_requested;
}

void make_file_or_stop(const std::string& path,
                       const std::function<void(const std::string& temporary)>& make) {
  stop_on_interrupt();
  try {
    io::make_file(path, [&](const std::string& temporary) {
      make(temporary);
      if (stop_requested) throw IoError("stopped");
    });
  } catch (const IoError&) {
    if (!stop_requested) throw;  // else the other program has ended with this one's signal
    throw IoError(path + ": interrupted, nothing was written");
  }
}

}  // namespace phy::cli
