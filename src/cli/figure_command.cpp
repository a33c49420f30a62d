// `phyllite figure RESULT --kind KIND`: a figure for print through gnuplot.
#include <fmt/format.h>

#include <map>

#include "cli/machine.hpp"
#include "io/load.hpp"
#include "io/load_variation.hpp"
#include "io/program.hpp"
#include "io/rock_in.hpp"
#include "report/figures.hpp"

namespace phy {
namespace {

struct FigureArguments {
  std::string result, rock, kind, format = "svg", out;
  double width = 0.0;
};

FigureData data_for(const FigureKind& kind, const FigureArguments& args) {
  FigureData data;
  if (kind.varied != holds_variations(args.result))
    throw InputError(Problem{args.result, "--kind", args.kind,
                             kind.varied ? "the folder of a study or of `phyllite elastic` with a [sweep]"
                                         : "the folder of `phyllite run`",
                             "`phyllite figure --help` tells which kind is of which results"});
  if (kind.varied) {
    data.variations = read_variations(args.result);
    if (data.variations.front().parameters.empty())
      throw InputError(Problem{args.result, "", "",
                               "parameters that vary one at a time around the first point",
                               "use the designs one_at_a_time or full_factorial"});
  } else {
    data.run = read_run(args.result);
  }
  if (!args.rock.empty()) data.laboratory = targets_of(read_rock(args.rock));
  return data;
}

void draw(FigureArguments args) {
  const std::map<std::string, FigureFormat> formats = {
      {"svg", FigureFormat::svg}, {"pdf", FigureFormat::pdf}, {"png", FigureFormat::png}};
  const FigureKind& kind = figure_kind(args.kind);
  const FigureData data = data_for(kind, args);
  if (args.out.empty()) args.out = std::string(kind.name) + "." + args.format;
  make_file_or_stop(args.out, [&](const std::string& temporary) {
    const std::string script = figure_script(kind, data, formats.at(args.format), args.width, temporary);
    run_program("gnuplot", {"-"}, "gnuplot-nox", [&](const auto& write) { write(script); });
  });
  fmt::print("{}\n", args.out);
}

std::string kinds_text() {
  std::string text = "what to draw:";
  for (const FigureKind& k : figure_kinds())
    text += fmt::format("\n{}{}: {}", k.name, *k.paper != 0 ? fmt::format(" or {}", k.paper) : "", k.meaning);
  return text;
}

}  // namespace

void add_figure_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<FigureArguments>();
  CLI::App* verb = app.add_subcommand("figure", "write a figure for print (SVG, PDF, PNG) through gnuplot");
  verb->add_option("result", args->result, "folder of a run, a study, or a sweep of the elastic solution")
      ->required();
  verb->add_option("--kind", args->kind, kinds_text())->required();
  verb->add_option("--format", args->format, "svg, pdf or png")
      ->check(CLI::IsMember({"svg", "pdf", "png"}))
      ->capture_default_str();
  verb->add_option("--width", args->width, "mm; journals have 90, 140, 190; 0: the usual one of the kind")
      ->check(CLI::Range(0.0, 1000.0));
  verb->add_option("--rock", args->rock, "rock file (TOML): its laboratory values beside the model");
  verb->add_option("--out", args->out, "file; default: KIND.FORMAT here");
  verb->callback([args, &session] {
    session.exit_code = 0;
    draw(*args);
  });
}

}  // namespace phy
