// The verbs of `phyllite`. Each file registers one and returns its exit code through `exit_code`:
// 0 all well; 1 a test did not succeed (Outcome); 2 the input cannot be used; 3 a file; 4 our own bug.
#pragma once
#include <CLI/CLI.hpp>

namespace phy::cli {

/// State shared by the verbs of one call.
struct Session {
  int exit_code = 0;
  int threads = 0;         ///< 0: all cores
  int terminal_width = 0;  ///< columns of the terminal; 0, no limit, when the output is no terminal
};

/// Of an option that is a number: unlike CLI::Range it refuses "nan".
inline CLI::Validator within(double low, double high) {
  const std::string range =
      "a number from " + CLI::detail::to_string(low) + " to " + CLI::detail::to_string(high);
  return {[=](const std::string& text) {
            double value = 0.0;
            const bool ok = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
            return ok ? std::string() : text + " is not " + range;
          },
          range};
}

/// `--reference`, which prints a page and ends, whatever else the verb requires.
inline void add_reference(CLI::App& verb, std::string (*page)(), const char* meaning) {
  verb.add_flag_callback(
      "--reference",
      [page] {
        const std::string text = page();
        throw CLI::CallForVersion(text.substr(0, text.rfind('\n')), 0);  // the parser ends the line itself
      },
      meaning);
}

/// Registers a verb of the program.
using AddVerb = void(CLI::App& app, Session& session);
AddVerb add_run_command, add_specimen_command, add_verify_command, add_recipe_command, add_contact_command,
    add_study_command, add_elastic_command, add_rock_command, add_rocks_command, add_show_command,
    add_replay_command, add_calibrate_command, add_report_command, add_figure_command, add_film_command,
    add_export_command, add_compare_command, add_envelope_command, add_design_command, add_gui_command,
    add_man_command, add_completion_command;

/// Writes report.html of a study or calibration into its folder and prints its name.
void write_report(const std::string& folder);

}  // namespace phy::cli
