#include "jobs/calibration_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "calibrate/effort.hpp"
#include "calibrate/plan.hpp"
#include "calibrate/posterior_ensemble.hpp"
#include "jobs/calibration_options.hpp"
#include "jobs/key_table.hpp"
#include "records/parameters.hpp"
#include "records/rock_model.hpp"
#include "report/calibration_files.hpp"

namespace phy::jobs {
namespace {

constexpr const char* head = R"(# Tables of a calibration

Written by `phyllite calibrate --reference` from the lists that the program works by. How to decide: the
[guide](calibration.md). Why: [theory](theory/calibration.md).

## Parameters

A parameter is sought by its logarithm, in its box. Where only the table speaks, it is flat there. Else
a [prior](theory/inference.md#strengths-one-scale-a-few-ratios) holds it near its usual value; `sd` is its
standard deviation in the logarithm. "Models" names what must be in the model.

| sought | key of the recipe | from | to | usual | sd | in multiples of | models |
|---|---|---|---|---|---|---|---|
)";

constexpr const char* models_head = R"(
## Models of rock

What `layers` and `matrix` of a rock file choose from. A model that contains another must predict better.

| `layers` | `matrix` | model | contains |
|---|---|---|---|
)";

constexpr const char* efforts_head = R"(
## Effort

| `--effort` | points of the search, of those of normal | further rounds, at most |
|---|---|---|
)";

constexpr const char* packings_head = R"(
## Packings

Seeds count from `packing.seed`. What verifies has never been searched on.

| packings | for |
|---|---|
)";

constexpr const char* options_head = R"(
## Options

Of `phyllite calibrate`, of `phyllite.calibrate` in Python (with `_`), and of the page.

| option | values | unless given | meaning |
|---|---|---|---|
)";

constexpr const char* keys_head = R"(
## Keys of a calibration

Of `calibration.json`: SI units, `null` where there is no number. A key without content is left out. `file` is
the whole; other objects stand where a key names them, alone or in a list.

)";

/// What the ends of a box count.
std::string scale_of(const Range& range) {
  return range.of == &Scales::modulus     ? "the largest E"
         : range.of == &Scales::stiffness ? "the largest E over the spacing"
         : range.of == &Scales::strength  ? "the largest strength without confinement"
                                          : "";
}

/// A recipe as the model has it: joints, bridges and directions where it has some.
Recipe recipe_of(const RockModel& model) {
  Recipe recipe;
  recipe.matrix.model = model.matrix;
  recipe.bedding.resize(model.joints ? 1 : 0);
  // Any value that is no default will do: a parameter belongs to the model once its feature is switched on.
  if (model.bridges) recipe.bedding.front().persistence = 0.5;
  if (model.directions) recipe.matrix.cohesion_ratio = 2.0;
  return recipe;
}

/// What all models have in common that a parameter belongs to.
std::string models_of(const Parameter& p) {
  bool all = true, joints = true, directions = true, planes = false;
  std::string matrix;
  for (const RockModel& m : rock_models()) {
    const bool belongs = p.belongs == nullptr || p.belongs(recipe_of(m));
    all = all && belongs;
    if (!belongs) continue;
    joints = joints && m.joints, directions = directions && m.directions, planes = planes || m.joints;
    const std::string word = m.matrix == MatrixModel::flat_joint ? "flat joints" : "parallel bonds";
    if (matrix.find(word) == matrix.npos) matrix += (matrix.empty() ? "" : ", ") + word;
  }
  // From the widest to the narrowest: the first description that fits covers all models found.
  if (all) return "all";
  if (joints) return "joints";
  if (directions) return planes ? "directions" : "directions alone";
  return matrix.find(',') == matrix.npos ? matrix : "directions, flat joints";
}

std::string parameter_row(const Parameter& p) {
  const Range& r = p.range;
  // Ratios and multiples of a scale have no unit; angles are the only ones that have.
  const std::string unit = r.of == nullptr && std::string_view(p.unit) == "deg" ? " deg" : "";
  return fmt::format("| {} | `{}` | {:.3g}{} | {:g}{} | {:g}{} | {} | {} | {} |\n", sought(p).symbol, p.key,
                     r.low, unit, r.high, unit, r.usual, unit,
                     std::isfinite(r.sd) ? fmt::format("{:g}", r.sd) : "", scale_of(r), models_of(p));
}

std::string parameter_rows() {
  std::vector<const Parameter*> seen;
  std::string text;
  using List = std::vector<const Parameter*> (*)(const Recipe&);
  for (const List list : {List{elastic_parameters}, List{strength_parameters}})
    for (const RockModel& m : rock_models())
      for (const Parameter* p : list(recipe_of(m))) {
        // A parameter occurs in many models and has one row, where it comes first.
        if (std::find(seen.begin(), seen.end(), p) != seen.end()) continue;
        seen.push_back(p);
        text += parameter_row(*p);
      }
  return text;
}

std::string model_rows() {
  std::string text;
  for (const RockModel& m : rock_models())
    text += fmt::format("| {} | {} | {} | {} |\n",
                        m.layered ? fmt::format("`\"{}\"`", to_string(m.layers)) : "no layers",
                        m.matrix == MatrixModel::flat_joint ? "`\"flat_joint\"`" : "`\"parallel_bond\"`",
                        text_of(m, std::nullopt), m.contains == nullptr ? "" : m.contains->words);
  return text;
}

/// "+5 ... +9"
std::string span(std::int64_t first, std::int64_t end) { return fmt::format("+{} ... +{}", first, end - 1); }

std::string packing_rows() {
  const calibrate::Packings p = calibrate::packings_from(0);
  const auto row = [](std::int64_t first, std::int64_t end, const char* use) {
    return fmt::format("| {} | {} |\n", span(first, end), use);
  };
  // The search takes seeds on both sides of the ensemble's; each range is a row of its own.
  const std::int64_t behind_ensemble =
      p.first_of_ensemble + static_cast<std::int64_t>(calibrate::ensemble_size);
  return row(p.fit.front(), p.fit.back() + 1, "elastic fit, and the search") +
         row(p.unseen.front(), p.unseen.back() + 1, "verification") +
         row(p.spare.front(), p.spare.back() + 1, "elastic fit where packings differ much, and the search") +
         row(p.next_unseen, p.first_of_ensemble, "more of the verification, five at a time") +
         row(p.first_of_ensemble, behind_ensemble, "ensemble") +
         row(behind_ensemble, p.search.back() + 1, "the search");
}

std::string option_rows() {
  std::string text;
  for (const CalibrationOption& o : calibration_options()) {
    const OptionValue value = o.value(CalibrationRequest());
    // "false" and an empty text are defaults that nobody would type.
    const bool given = !std::holds_alternative<bool>(value) && value != OptionValue(std::string());
    const std::string shown = given ? option_text(value) : "";
    text += fmt::format("| `--{}` | {} | {} | {} |\n", o.word(),
                        !o.words.empty() ? fmt::format("{}", fmt::join(o.words, ", "))
                        : o.most > 0     ? fmt::format("1 to {}", o.most)
                        : !given         ? "yes or no"
                                         : "folder",
                        shown.empty() ? "" : "`" + shown + "`", o.meaning);
  }
  return text;
}

}  // namespace

std::string calibration_reference() {
  std::string text = head + parameter_rows() + models_head + model_rows() + efforts_head;
  for (const calibrate::Effort& e : calibrate::efforts)
    text += fmt::format("| `{}` | {:g} | {} |\n", e.name, e.points, e.further);
  text += packings_head + packing_rows() + options_head + option_rows() + keys_head;
  return text + key_table(report::calibration_keys());
}

}  // namespace phy::jobs
