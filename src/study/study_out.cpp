// The files that say what a study was, as they are kept in its folder; read_study reads them again.
#include "base/quote.hpp"
#include "io/regressions.hpp"
#include "io/toml_in.hpp"
#include "study/study_in.hpp"
#include "study/table.hpp"

namespace phy::study {
namespace {

/// The points of a list design as the table that read_study() reads.
std::string points_csv(const Study& study) {
  std::string text;
  for (const Factor& f : study.vary) text += (text.empty() ? "" : ",") + csv_head(f.key);
  text += "\n";
  for (const auto& row : study.rows) {
    for (std::size_t k = 0; k < row.size(); ++k)
      // Choices and switches as words; quantities as numbers in the unit of the column's head.
      text += (k == 0 ? "" : ",") + (study.vary[k].key.field->dimension == Dimension::none
                                         ? study.vary[k].key.print(row[k])
                                         : print_number(row[k]));
    text += "\n";
  }
  return text;
}

std::string value_text(const RecipeKey& key, double value) {
  // TOML strings for words and for quantities with units.
  const bool quoted = key.field->dimension != Dimension::none || key.field->kind == FieldKind::choice;
  return quoted ? toml_string(key.print(value)) : key.print(value);
}

template <class T, class Print>
std::string list_text(const std::vector<T>& values, const Print& print) {
  std::vector<std::string> texts;
  for (const T& v : values) texts.push_back(print(v));
  return toml_list(texts);
}

}  // namespace

std::vector<std::string> by_angle_lines(const Study& study) {
  std::vector<std::string> lines;
  for (const ByAngle& entry : study.by_angle)
    lines.push_back(toml_string(entry.key.path()) + " = " +
                    list_text(entry.values, [&](double v) { return value_text(entry.key, v); }));
  return lines;
}

std::vector<std::pair<std::string, std::string>> study_files(const Study& study) {
  const auto whole = [](std::int64_t n) { return std::to_string(n); };
  std::string text = "name = " + toml_string(study.name) + "\n";
  if (study.solver == Solver::direct) text += "solver = \"direct\"\n";
  text += "recipe = \"recipe.toml\"\ndesign = \"" + std::string(to_string(study.design)) + "\"\n";
  text += "samples = " + whole(study.samples) + "\nseed = " + whole(study.seed) + "\n";
  // An imported packing has no seeds, and a study file that gives them is refused.
  if (study.base.packing.file.empty()) text += "packings = " + list_text(study.packings, whole) + "\n";
  text += "bond_seeds = " + list_text(study.bond_seeds, whole) + "\n";
  // The base is written completed, with [set] already applied.
  std::vector<std::pair<std::string, std::string>> files = {{"recipe.toml", io::write_recipe(study.base)}};
  if (!study.regressions.empty()) {
    files.emplace_back(io::regressions_file, io::write_regressions(study.regressions));
    text += std::string("regressions = \"") + io::regressions_file + "\"\n";
  }
  if (study.design == Design::list) {
    files.emplace_back("points.csv", points_csv(study));
    text += "file = \"points.csv\"\n";
  } else {
    for (const Factor& f : study.vary) {
      text += "\n[[vary]]\nkey = " + toml_string(f.key.path()) + "\n";
      const auto print = [&](double v) { return value_text(f.key, v); };
      if (!f.levels.empty())
        text += "values = " + list_text(f.levels, print) + "\n";
      else
        text += "from = " + print(f.from) + "\nto = " + print(f.to) + "\nscale = \"" +
                (f.logarithmic ? "log" : "linear") + "\"\n";
    }
  }
  if (!study.by_angle.empty()) text += "\n[by_angle]\n";
  for (const std::string& line : by_angle_lines(study)) text += line + "\n";
  files.emplace_back("study.toml", text);
  return files;
}

}  // namespace phy::study
