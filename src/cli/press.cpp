#include "cli/press.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/version.hpp"
#include "cli/live_plot.hpp"
#include "cli/machine.hpp"
#include "cli/progress.hpp"
#include "io/store.hpp"
#include "jobs/press_watch.hpp"
#include "jobs/study_folder.hpp"
#include "study/worker.hpp"

namespace phy::cli {

std::vector<TestResult> press(const Recipe& recipe,
                              const std::vector<std::shared_ptr<const Specimen>>& specimens,
                              const std::string& folder, const study::MachineOptions& machine) {
  ProgressLine line;
  LivePlot plot(recipe.test.kind->curve, specimens);
  // The line of progress stays the last one of the terminal.
  line.draw_above([&] { return plot.lines(); });
  study::Hooks hooks;
  jobs::PressWatch watch(folder);
  hooks.on_reading = [&](std::size_t i, const RunningTest& now) {
    plot.add(i, now.strain, now.stress);
    // The page of `phyllite gui` draws the specimen from this file, so the terminal is not the only
    // spectator.
    watch.reading(now);
  };
  hooks.stop = stop_on_interrupt();
  hooks.on_progress = [&](const study::Progress& p) {
    line.show([&](double seconds) { return jobs::progress_text(p, seconds); });
  };
  hooks.on_result = [&](std::size_t i, const TestResult& result) {
    // An interrupted test would stand beside finished ones as if it were a result.
    if (result.outcome.status == Status::interrupted) return;
    io::write_result((std::filesystem::path(folder) / io::folder_name(result.name)).string(), recipe,
                     phy::version, *specimens[i], result);
    // After the file: a note means that the result is kept.
    line.note(fmt::format("{}: {}", result.name, result.outcome.reason));
  };
  std::vector<TestResult> results = study::run_tests(specimens, recipe, machine, hooks);
  line.finish();
  return results;
}

}  // namespace phy::cli
