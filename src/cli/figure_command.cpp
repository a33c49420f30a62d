// `phyllite figure RESULT --kind KIND`: a figure for print through gnuplot.
#include <fmt/format.h>

#include <filesystem>

#include "base/quote.hpp"
#include "cli/machine.hpp"
#include "cli/provenance.hpp"
#include "cli/suggested.hpp"
#include "cli/terminal.hpp"
#include "io/load.hpp"
#include "io/load_variation.hpp"
#include "io/program.hpp"
#include "io/rock_in.hpp"
#include "report/figures.hpp"

namespace phy::cli {
namespace {

constexpr double least_width = 30.0, most_width = 1000.0;  // [mm]

struct FigureArguments {
  std::string result, rock, kind, format, out;
  double width = 0.0;
};

report::FigureData data_for(const report::FigureKind& kind, const FigureArguments& args) {
  report::FigureData data;
  if (kind.varied != io::holds_variation(args.result))
    throw InputError(Problem{args.result, "--kind", args.kind,
                             kind.varied ? "the folder of a study" : "the folder of `phyllite run`",
                             "`phyllite figure --help` tells which kind is of which results"});
  if (kind.varied) {
    data.variation = io::read_variation(args.result);
    if (data.variation.parameters.empty())
      throw InputError(Problem{args.result, "", "",
                               "parameters that vary one at a time around the first point",
                               "use the designs one_at_a_time or full_factorial"});
  } else {
    data.run = io::read_run(args.result);
  }
  if (!args.rock.empty()) data.laboratory = targets_of(io::read_rock(args.rock));
  return data;
}

/// The format that is asked for, else that of the name of the file, else SVG.
std::string format_of(const FigureArguments& args) {
  std::string ending = std::filesystem::path(args.out).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  if (!report::figure_formats().contains(ending)) return args.format.empty() ? "svg" : args.format;
  if (!args.format.empty() && args.format != ending)
    throw InputError(Problem{"command line", "--format", args.format, ending + ", as --out " + args.out,
                             "leave --format out, or give the file another ending"});
  return ending;
}

/// The exit code.
int draw(FigureArguments args) {
  const std::string format = format_of(args);
  const report::FigureKind& kind = report::figure_kind(args.kind);
  if (args.width != 0.0 && !(args.width >= least_width && args.width <= most_width))
    throw InputError(Problem{"command line", "--width", fmt::format("{:g}", args.width),
                             fmt::format("{:g} to {:g} mm", least_width, most_width),
                             "journals have 90, 140, 190; 0: the usual one of the kind"});
  if (!is_plain(args.out))
    throw InputError(Problem{"command line", "--out", args.out, "a name in UTF-8 without control characters",
                             "gnuplot has no way to write others"});
  const report::FigureData data = data_for(kind, args);
  if (args.out.empty()) args.out = std::string(kind.name) + "." + format;
  make_file_or_stop(args.out, [&](const std::string& temporary) {
    const std::string script =
        report::figure_script(kind, data, report::figure_formats().at(format), args.width, temporary);
    io::run_program("gnuplot", {"-"}, "gnuplot-nox", [&](const auto& write) { write(script); });
  });
  print_out("{}\n", args.out);
  return tell_provenance(data.run, 0);
}

std::vector<std::string> names_of_kinds() {
  std::vector<std::string> names;
  for (const report::FigureKind& k : report::figure_kinds()) {
    names.emplace_back(k.name);
    if (*k.paper != 0) names.emplace_back(k.paper);
  }
  return names;
}

std::string kinds_text() {
  std::string text = "what to draw:";
  for (const report::FigureKind& k : report::figure_kinds())
    text += fmt::format("\n{}{}: {}", k.name, *k.paper != 0 ? fmt::format(" or {}", k.paper) : "", k.meaning);
  return text;
}

}  // namespace

void add_figure_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<FigureArguments>();
  CLI::App* verb = app.add_subcommand("figure", "write a figure for print (SVG, PDF, PNG) through gnuplot");
  verb->add_option("result", args->result, "folder of a run or a study")->required()->type_name("FOLDER");
  verb->add_option("--kind", args->kind, kinds_text())
      ->required()
      ->type_name("KIND")
      ->check(suggested(names_of_kinds));
  verb->add_option("--format", args->format, "svg, pdf or png; default: that of --out, else svg")
      ->check(CLI::IsMember({"svg", "pdf", "png"}));
  verb->add_option("--width", args->width, "mm; journals have 90, 140, 190; 0: the usual one of the kind")
      ->capture_default_str();
  verb->add_option("--rock", args->rock, "rock file (TOML): its laboratory values beside the model")
      ->type_name("FILE");
  verb->add_option("--out", args->out, "file; default: KIND.FORMAT here")->type_name("FILE");
  verb->callback([args, &session] { session.exit_code = draw(*args); });
}

}  // namespace phy::cli
