#include "cli/machine.hpp"

#include <fmt/format.h>

#include "base/check.hpp"
#include "io/program.hpp"
#include "jobs/machine.hpp"
#include "system/terminal.hpp"

namespace phy::cli {
int n_threads(const Session& session) { return jobs::n_threads(session.threads); }

std::string speed_words(const TestRecipe& test) {
  std::string words = fmt::format("{:.3f} m/s per platen", test.platen_speed);
  // Both speeds, since the strength depends on the last and the duration on the first.
  if (test.approach_strain > 0.0)
    words +=
        fmt::format(" behind {:.3f} m/s up to a strain of {:g}", test.approach_speed, test.approach_strain);
  return words;
}

study::MachineOptions machine_of(const Session& session) { return jobs::machine_of(session.threads); }

const std::atomic<bool>* stop_on_interrupt() {
  // Not at the start: until input has been read a signal should simply end the program.
  return &system::stop_requested();
}

void make_file_or_stop(const std::string& path,
                       const std::function<void(const std::string& temporary)>& make) {
  const std::atomic<bool>& stop_requested = *stop_on_interrupt();
  try {
    io::make_file(path, [&](const std::string& temporary) {
      make(temporary);
      // gnuplot gets the same Ctrl-C and may end with a whole-looking part of a picture.
      if (stop_requested) throw IoError("stopped");
    });
  } catch (const IoError&) {
    if (!stop_requested) throw;  // else the other program has ended with this one's signal
    throw IoError(path + ": interrupted, nothing was written");
  }
}

}  // namespace phy::cli
