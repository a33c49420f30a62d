// `phyllite compare THEIRS.csv FOLDER`: a curve of another program or of a laboratory beside a result.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "analysis/comparison.hpp"
#include "base/check.hpp"
#include "base/quote.hpp"
#include "cli/commands.hpp"
#include "cli/machine.hpp"
#include "cli/provenance.hpp"
#include "cli/terminal.hpp"
#include "events/counts.hpp"
#include "io/load.hpp"
#include "io/program.hpp"
#include "records/test_description.hpp"
#include "report/curves.hpp"
#include "report/gnuplot_figure.hpp"
#include "report/run_figures.hpp"
#include "report/words_of_events.hpp"
#include "rock/curve.hpp"

namespace phy::cli {
namespace {

struct CompareArguments {
  std::string theirs, folder, figure;
};

/// The one specimen of the folder, of a test whose curve is that of uniaxial compression.
const SpecimenRecord& the_test(const RunRecord& run, const std::string& folder) {
  // A foreign curve is one test: which of several specimens it belongs to nobody can guess.
  if (run.tests.size() != 1)
    throw InputError(
        Problem{folder, "", fmt::format("{} specimens", run.tests.size()), "one specimen",
                fmt::format("name its folder, {}/{}", folder,
                            std::filesystem::path(io::result_folders(folder).front()).filename().string())});
  const SpecimenRecord& test = run.tests.front();
  // Curves of other tests have other axes.
  if (test.recipe.test.kind != TestKind())
    throw InputError(Problem{folder, "test.kind", test.recipe.test.kind->name, "uniaxial",
                             "curves of other tests are not compared"});
  return test;
}

std::string difference_text(const analysis::ComparedNumber& n) {
  // A curve may lack what a number needs, such as a lateral strain for Poisson's ratio.
  return std::isfinite(n.difference()) ? fmt::format("{:+.2f} %", 100.0 * n.difference()) : "-";
}

std::string value_text(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-"; }

void print_table(const std::vector<analysis::ComparedNumber>& numbers, int width) {
  Column label = column_of("", "", numbers, [](const auto& n) { return n.name + " [" + n.unit + "]"; });
  label.left = true;
  const Columns columns = {
      column_of("ours", "", numbers, [](const auto& n) { return value_text(n.ours); }),
      column_of("theirs", "", numbers, [](const auto& n) { return value_text(n.theirs); }),
      column_of("difference", "", numbers, difference_text)};
  print_out("{}\n", text_table(label, {columns}, width));
  for (const analysis::ComparedNumber& n : numbers)
    if (!n.note.empty()) print_wrapped(width, 2, "{}: {}\n", n.name, n.note);
}

/// Acoustic events beside those that a laboratory has counted.
std::string counts_text(const SpecimenRecord& test, const History& theirs) {
  if (test.result.events.empty())
    return "The result has no acoustic events to compare the counts with: events = true in [test] finds "
           "them.";
  return report::text_of_counts(
      events::compared(events::counts_of(test.result.events, test.recipe.test.kind->curve.sign,
                                         std::fabs(report::value_of(test, "peak_strain"))),
                       events::counts_of(theirs)));
}

constexpr double column_width = 90.0;  // [mm] of a journal

/// By the ending of --figure, before anything is read. Throws InputError.
/// gnuplot writes after both files have been read, so a wrong ending would cost the whole reading.
auto format_of(const CompareArguments& args) {
  const std::string ending = std::filesystem::path(args.figure).extension().string();
  const auto format = report::figure_formats().find(ending.empty() ? ending : ending.substr(1));
  if (format == report::figure_formats().end() || !is_plain(args.figure))
    throw InputError(Problem{"command line", "--figure", args.figure,
                             "a file that ends in .svg, .pdf or .png", "for example --figure compared.svg"});
  return format->second;
}

void draw(const CompareArguments& args, const History& ours, const History& theirs) {
  make_file_or_stop(args.figure, [&](const std::string& temporary) {
    const report::Figure figure =
        // The legend shows the file name alone: a path would not fit into the width of a column.
        report::two_curves_figure(ours, theirs, std::filesystem::path(args.theirs).filename().string());
    const std::string script =
        report::gnuplot_script(figure, {format_of(args), column_width, 0.0, temporary});
    io::run_program("gnuplot", {"-"}, "gnuplot-nox", [&](const auto& write) { write(script); });
  });
  print_out("{}\n", args.figure);
}

int compare(const CompareArguments& args, const Session& session) {
  const int width = session.terminal_width;
  // Wrong names are found before anything is read.
  if (!args.figure.empty()) format_of(args);
  const rock::ForeignCurve theirs = rock::read_curve(args.theirs);
  const RunRecord run = io::read_run(args.folder);
  const SpecimenRecord& test = the_test(run, args.folder);
  const History& ours = test.result.history;
  // Both curves are cut by the same rule: a laboratory that presses on would else have other strains at the
  // end.
  const analysis::StopRule stop{test.recipe.test.stop_at, test.recipe.test.post_peak};
  print_wrapped(width, 10, "ours      {}, {} ({} rows)\n", test.recipe.name, test.result.name,
                ours.rows.size());
  print_wrapped(width, 10, "theirs    {} ({} rows)\n", args.theirs, theirs.history.rows.size());
  print_notes(theirs.notes, width);
  print_table(analysis::compared_numbers(ours, theirs.history, stop), width);
  const double distance = analysis::distance_of_curves(ours, theirs.history, stop);
  // Curves without a common range of strain have no distance, and the table above says so already.
  if (std::isfinite(distance))
    print_wrapped(
        width, 2,
        "stress at equal strain up to the peak: {:.2f} % of our strength apart (root mean square)\n",
        100.0 * distance);
  if (std::isfinite(theirs.history.rows.front().n_cracks))
    print_wrapped(width, 2, "{}\n", counts_text(test, theirs.history));
  if (!args.figure.empty()) draw(args, ours, theirs.history);
  return tell_provenance(run, width);
}

}  // namespace

void add_compare_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<CompareArguments>();
  CLI::App* verb = app.add_subcommand(
      "compare", "a stress-strain curve of another program or a laboratory beside a result");
  verb->add_option("theirs", args->theirs,
                   "table (CSV) with axial_strain and axial_stress, units in brackets in the header")
      ->required()
      ->type_name("FILE");
  verb->add_option("folder", args->folder, "result of one specimen")->required()->type_name("FOLDER");
  verb->add_option("--figure", args->figure, "also draw both curves: a file ending in .svg, .pdf or .png")
      ->type_name("FILE");
  verb->callback([args, &session] { session.exit_code = compare(*args, session); });
}

}  // namespace phy::cli
