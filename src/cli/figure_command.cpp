// `phyllite figure RESULT --kind KIND`: a figure for print through gnuplot.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/quote.hpp"
#include "cli/machine.hpp"
#include "cli/provenance.hpp"
#include "cli/suggested.hpp"
#include "cli/terminal.hpp"
#include "io/load.hpp"
#include "io/load_variation.hpp"
#include "io/output.hpp"
#include "io/program.hpp"
#include "jobs/calibration_folder.hpp"
#include "jobs/report.hpp"
#include "jobs/run_folder.hpp"
#include "records/test_description.hpp"
#include "report/event_figures.hpp"
#include "report/figures.hpp"
#include "rock/curve.hpp"
#include "rock/file.hpp"

namespace phy::cli {
namespace {

constexpr double least_size = 30.0, most_size = 1000.0;  // [mm]

struct FigureArguments {
  std::string result, rock, counts, kind, format, size, out, data;
};

/// What a folder holds, in words.
// Found by the files themselves: users name a folder and seldom remember which verb wrote it.
struct Held {
  bool variation, calibration;
  explicit Held(const std::string& folder)
      : variation(io::holds_variation(folder)), calibration(jobs::holds_calibration(folder)) {}
  const char* usual_kind() const {
    return variation ? "modulus" : calibration ? "anisotropy" : "stress_strain";
  }
};

/// Names of all kinds, of a study or of all else, with the paper's numbers if wanted.
std::vector<std::string> names_of_kinds(std::optional<bool> varied, bool with_numbers) {
  std::vector<std::string> names;
  for (const report::FigureKind& k : report::figure_kinds()) {
    if (varied && *varied != k.varied) continue;
    names.emplace_back(k.name);
    if (with_numbers && *k.paper != 0) names.emplace_back(k.paper);
  }
  return names;
}

void read_study(const std::string& folder, report::FigureData& data) {
  data.variation = io::read_variation(folder);
  // With several parameters moving at once there is no curve over one of them to draw.
  if (data.variation.parameters.empty())
    throw InputError(Problem{folder, "", "",
                             "a study of the design one_at_a_time or full_factorial: figures show parameters "
                             "that vary one at a time",
                             "`phyllite study effects FOLDER` has the effects of any design"});
}

/// The specimens of a calibration: it has none where no strength was fitted.
RunRecord specimens_of(const std::string& folder) {
  // Curves and pictures are of the calibrated rock as it broke, whose specimens lie below the calibration.
  const std::string specimens = jobs::specimens_in(folder);
  if (!jobs::holds_results(specimens))
    throw InputError(Problem{folder, "", "", "specimens of the calibrated rock",
                             "this calibration has tested none: draw --kind anisotropy"});
  return io::read_run(specimens);
}

/// Counts of a laboratory beside a run. Throws InputError where they cannot stand there.
report::LaboratoryCounts counts_for(const RunRecord& run, const std::string& file) {
  for (const SpecimenRecord& t : run.tests)
    if (t.recipe.test.kind != TestKind())
      throw InputError(
          Problem{"command line", "--counts", file, "a result of uniaxial compression",
                  fmt::format("counts beside a test {} are not compared", t.recipe.test.kind->name)});
  History curve = rock::read_curve(file).history;
  if (!std::isfinite(curve.rows.front().n_cracks))
    throw InputError(
        Problem{file, "counts", "",
                fmt::format("a column of counts so far, one of {}", fmt::join(rock::names_of_counts(), ", ")),
                "rename the one that it is; rates must be summed up"});
  return {std::move(curve), std::filesystem::path(file).filename().string()};
}

report::FigureData data_for(const report::FigureKind& kind, const Held& held, const FigureArguments& args) {
  // Figures of a study need parameters that vary, all others specimens.
  if (kind.varied != held.variation)
    throw InputError(Problem{"command line", "--kind", args.kind,
                             fmt::format("one of {}", fmt::join(names_of_kinds(held.variation, false), ", ")),
                             fmt::format("{} holds {} study", args.result, held.variation ? "a" : "no")});
  const bool over_angles = std::string(kind.name) == "anisotropy";
  if (!args.rock.empty() && (!over_angles || held.calibration))
    throw InputError(Problem{"command line", "--rock", args.rock, "none here",
                             held.calibration && over_angles
                                 ? "a calibration has its laboratory values already"
                                 : "only --kind anisotropy shows laboratory values"});
  if (!args.counts.empty() && std::string(kind.name) != "events")
    throw InputError(Problem{"command line", "--counts", args.counts, "none here",
                             "only --kind events shows counts of a laboratory"});
  report::FigureData data;
  if (held.variation)
    read_study(args.result, data);
  else if (held.calibration && over_angles)
    data.calibration = jobs::read_calibration(args.result);
  else
    data.run = held.calibration ? specimens_of(args.result) : io::read_run(args.result);
  if (!args.counts.empty()) data.counts = counts_for(data.run, args.counts);
  if (!args.rock.empty()) data.laboratory = targets_of(rock::read_rock(args.rock));
  return data;
}

constexpr const char* on_terminal = "terminal";

/// The format that is asked for, else that of the name of the file, else SVG.
// An ending that contradicts --format would make a PDF that a viewer opens as SVG.
std::string format_of(const FigureArguments& args) {
  std::string ending = std::filesystem::path(args.out).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  // A name that ends otherwise, or has no ending, says nothing of the format.
  if (!report::figure_formats().contains(ending)) return args.format.empty() ? "svg" : args.format;
  if (!args.format.empty() && args.format != ending)
    throw InputError(Problem{"command line", "--format", args.format, ending + ", as --out " + args.out,
                             "leave --format out, or give the file another ending"});
  return ending;
}

/// "140" or "140x90"; the height follows from the width where it is not given. Throws InputError.
report::Sheet sheet_of(const std::string& size) {
  report::Sheet sheet;
  if (size.empty()) return sheet;
  const auto read = [](std::string_view text, double& mm) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), mm);
    return error == std::errc() && end == text.data() + text.size() && mm >= least_size && mm <= most_size;
  };
  const std::size_t x = size.find('x');
  if (!read(std::string_view(size).substr(0, x), sheet.width) ||
      (x != size.npos && !read(std::string_view(size).substr(x + 1), sheet.height)))
    throw InputError(Problem{"command line", "--size", size,
                             fmt::format("{:g} to {:g} mm, as 140 or 140x90", least_size, most_size),
                             "journals have widths of 90, 140 and 190"});
  return sheet;
}

/// The exit code.
int draw(FigureArguments args, int columns) {
  const std::string format = format_of(args);
  io::check_ending(args.out, {".svg", ".pdf", ".png"});
  const Held held(args.result);
  // Before the data are read: a folder of many specimens takes seconds to read for a misspelt kind.
  const report::FigureKind& kind = report::figure_kind(args.kind.empty() ? held.usual_kind() : args.kind);
  io::check_ending(args.data, {".csv"});
  if (!args.data.empty()) io::check_outputs({args.data}, "data");
  report::Sheet sheet = sheet_of(args.size);
  if (!is_plain(args.out))
    throw InputError(Problem{"command line", "--out", args.out, "a name in UTF-8 without control characters",
                             "gnuplot has no way to write others"});
  const report::FigureData data = data_for(kind, held, args);
  const std::string table = args.data.empty() ? "" : report::figure_csv(kind, data);
  // Text goes to the terminal whatever --out says, and needs no gnuplot on the machine.
  if (format == on_terminal) {
    if (!args.size.empty())
      throw InputError(Problem{"command line", "--size", args.size, "nothing with --format terminal",
                               "a terminal has its own width"});
    // On a pipe there is no width to ask for; 80 columns fit into mails and logs.
    constexpr int usual_columns = 80;
    print_out("{}", report::figure_text(kind, data, columns > 0 ? columns : usual_columns));
    if (!args.data.empty()) io::write_output(args.data, table);
    return tell_provenance(data.run, 0);
  }
  // Where the user stands and not in the folder of results, which is left as it was.
  if (args.out.empty()) args.out = std::string(kind.name) + "." + format;
  // Made beside its place and moved there: where gnuplot fails, an older figure stays as it was.
  make_file_or_stop(args.out, [&](const std::string& temporary) {
    sheet.format = report::figure_formats().at(format), sheet.out = temporary;
    const std::string script = report::figure_script(kind, data, sheet);
    io::run_program("gnuplot", {"-"}, "gnuplot-nox", [&](const auto& write) { write(script); });
  });
  print_out("{}\n", args.out);
  if (!args.data.empty()) io::write_output(args.data, table), print_out("{}\n", args.data);
  return tell_provenance(data.run, 0);
}

// From the list of kinds, so that --help cannot miss one that was added.
std::string kinds_text() {
  std::string text = "what to draw; default: stress_strain, anisotropy of a calibration, modulus of a study:";
  for (const report::FigureKind& k : report::figure_kinds())
    text += fmt::format("\n{}{}: {}", k.name, *k.paper != 0 ? fmt::format(" or {}", k.paper) : "", k.meaning);
  return text;
}

}  // namespace

void add_figure_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<FigureArguments>();
  CLI::App* verb = app.add_subcommand(
      "figure", "write a figure for print (SVG, PDF, PNG) through gnuplot, or on the terminal");
  verb->add_option("result", args->result, "folder of a run, a study or a calibration")
      ->required()
      ->type_name("FOLDER");
  verb->add_option("--kind", args->kind, kinds_text())->type_name("KIND")->check(suggested([] {
    return names_of_kinds({}, true);
  }));
  verb->add_option("--format", args->format,
                   "svg, pdf, png, or terminal: printed here; default: the ending of --out, else svg")
      ->check(CLI::IsMember({"svg", "pdf", "png", on_terminal}));
  verb->add_option("--size", args->size,
                   "mm, as 140 or 140x90; journals have widths of 90, 140, 190; default: by the kind")
      ->type_name("WIDTH[xHEIGHT]");
  verb->add_option("--data", args->data, "CSV file that gets what is drawn, point by point")
      ->type_name("FILE");
  verb->add_option("--rock", args->rock, "rock file (TOML): its laboratory values beside the model")
      ->type_name("FILE");
  verb->add_option(
          "--counts", args->counts,
          "with --kind events: table (CSV) of a laboratory with axial_strain, axial_stress and counts")
      ->type_name("FILE");
  verb->add_option("--out", args->out, "file; default: KIND.FORMAT here")->type_name("FILE");
  verb->callback([args, &session] { session.exit_code = draw(*args, session.terminal_width); });
}

}  // namespace phy::cli
