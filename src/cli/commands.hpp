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

void add_run_command(CLI::App& app, Session& session);
void add_specimen_command(CLI::App& app, Session& session);
void add_verify_command(CLI::App& app, Session& session);
void add_recipe_command(CLI::App& app, Session& session);
void add_rock_command(CLI::App& app, Session& session);
void add_contact_command(CLI::App& app, Session& session);
void add_replay_command(CLI::App& app, Session& session);
void add_show_command(CLI::App& app, Session& session);
void add_calibrate_command(CLI::App& app, Session& session);
void add_report_command(CLI::App& app, Session& session);
/// Writes report.html of a study or calibration into its folder and prints its name.
void write_report(const std::string& folder);
void add_export_command(CLI::App& app, Session& session);
void add_compare_command(CLI::App& app, Session& session);
void add_figure_command(CLI::App& app, Session& session);
void add_film_command(CLI::App& app, Session& session);
void add_envelope_command(CLI::App& app, Session& session);
void add_study_command(CLI::App& app, Session& session);
void add_elastic_command(CLI::App& app, Session& session);
/// What people and shells know of all other verbs: comes last.
void add_gui_command(CLI::App& app, Session& session);
void add_man_command(CLI::App& app, Session& session);
void add_completion_command(CLI::App& app, Session& session);

}  // namespace phy::cli
