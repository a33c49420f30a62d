#include "jobs/calibration_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "base/quote.hpp"
#include "rock/schema.hpp"

namespace phy::jobs {
namespace {

using R = CalibrationRequest;

std::vector<std::string> effort_names() {
  std::vector<std::string> names;
  for (const calibrate::Effort& e : calibrate::efforts) names.emplace_back(e.name);
  return names;
}

/// The options, and what a folder remembers beside them.
const io::Schema& request_schema() {
  static const Fields fields = [] {
    Fields all;
    // Read by the same schema as the options, so that an unknown key of a later version is a problem with a
    // line.
    for (const char* key : {"name", "rock", "table", "model"})
      all.push_back(make_field(FieldKind::text, "", key, ""));
    for (const CalibrationOption& o : calibration_options()) all.push_back(o.field());
    return all;
  }();
  static const io::Schema schema{"request of a calibration", "", fields, {}, ""};
  return schema;
}

/// What a document leaves out stays as by default.
CalibrationRequest request_in(const io::Document& document) {
  CalibrationRequest request;
  for (const CalibrationOption& o : calibration_options()) {
    // Asked before: the getter's own default is no default of the option.
    if (document.find(o.key) == nullptr) continue;
    const auto take = [&](auto place) {
      auto& value = request.*place;
      using Value = std::remove_reference_t<decltype(value)>;
      if constexpr (!std::is_same_v<Value, std::string>)
        value = static_cast<Value>(document.number(o.key, 0.0));
      else if (o.words.empty())
        value = document.text(o.key, "");
      else  // a choice travels as its place in the list
        value = o.words.at(static_cast<std::size_t>(document.number(o.key, 0.0)));
    };
    std::visit(take, o.place);
  }
  return request;
}

std::string toml_value(const OptionValue& value) {
  const auto* word = std::get_if<std::string>(&value);
  if (word != nullptr) return toml_string(*word);
  const auto* number = std::get_if<std::int64_t>(&value);
  if (number != nullptr) return fmt::format("{}", *number);
  return std::get<bool>(value) ? "true" : "false";
}

}  // namespace

// Help and page show them in this order: what is asked for most comes first, what says how to work last.
const std::vector<CalibrationOption>& calibration_options() {
  static const std::vector<CalibrationOption> options = {
      {"out", "", "folder for the results", &R::out, {}, 0, false},
      {"effort", "Effort of the search",
       "how many tests the search of strengths takes: quick half of normal, thorough twice as many; auto: "
       "normal, but quick where the forecast "
       "sees the table out of reach",
       &R::effort, effort_names()},
      {"max_tests",
       "Largest number of tests",
       "budget: tests in compression, verification included",
       &R::max_tests,
       {},
       1000000},
      {"matrix", "Matrix of the model",
       "what holds the grains together, whatever the rock file says; choose: what predicts best", &R::matrix,
       find_field(rock::rock_schema().fields, "matrix")->choices},  // the option overrides that key
      {"elastic", "Moduli alone", "elastic stage only: moduli, and no strengths", &R::elastic},
      {"method",
       "Method",
       "posterior: parameters with intervals; sequence: the paper's way, one parameter after the other",
       &R::method,
       {"posterior", "sequence"}},
      {"with_untrusted", "Count untrusted tests",
       "count tests that have a strength but are not to be trusted (docs/reliability.md)",
       &R::with_untrusted},
      {"resume",
       "Go on",
       "go on with an interrupted calibration in the same folder",
       &R::resume,
       {},
       0,
       false}};
  return options;
}

std::string CalibrationOption::word() const {
  std::string word = key;
  // Keys are names of Python's arguments, which hold no hyphen; a command line has hyphens by custom.
  std::replace(word.begin(), word.end(), '_', '-');
  return word;
}

Field CalibrationOption::field() const {
  const auto as = [&](FieldKind kind) { return make_field(kind, "", key, meaning); };
  if (std::holds_alternative<bool R::*>(place)) return as(FieldKind::boolean);
  if (std::holds_alternative<std::int64_t R::*>(place))
    return as(FieldKind::integer).within(1.0, static_cast<double>(most));
  return words.empty() ? as(FieldKind::text) : as(FieldKind::choice).one_of(words);
}

OptionValue CalibrationOption::value(const CalibrationRequest& request) const {
  return std::visit([&](auto member) { return OptionValue(request.*member); }, place);
}

CalibrationRequest request_of(io::TomlValue keys, const std::string& where) {
  // Python and the page send values instead of a file; ranges and words are checked by the same code.
  const io::Document document(std::move(keys), where, request_schema(), {});
  document.check();
  return request_in(document);
}

std::vector<SetOption> asked(const CalibrationRequest& request) {
  std::vector<SetOption> options;
  for (const CalibrationOption& o : calibration_options())
    // The empty text is "not asked for": a request must not say matrix = "" as if it were a model.
    if (o.changes_result && o.value(request) != OptionValue(std::string()))
      options.push_back({o.key, o.value(request)});
  return options;
}

std::vector<std::string> command_line_of(const CalibrationRequest& request) {
  std::vector<std::string> words = {"calibrate", request.rock};
  for (const CalibrationOption& o : calibration_options()) {
    const OptionValue value = o.value(request);
    // A command that says its defaults could not be told from one that insists on them.
    if (value == o.value(CalibrationRequest())) continue;
    words.push_back("--" + o.word());
    if (!std::holds_alternative<bool>(value)) words.push_back(option_text(value));
  }
  return words;
}

std::string kept_text(const KeptRequest& kept) {
  std::string text = fmt::format(
      "# What the calibration in this folder was asked for: `phyllite calibrate --resume` goes on with the "
      "same alone.\nname = {}\nrock = {}\n",
      toml_string(kept.name), toml_string(kept.request.rock));
  // Defaults too: those of a later version may be others.
  for (const SetOption& o : asked(kept.request)) text += fmt::format("{} = {}\n", o.key, toml_value(o.value));
  return text + fmt::format(
                    "# Hashes: of the means of the table; of the recipe, and of how the table is read.\n"
                    "table = {}\nmodel = {}\n",
                    toml_string(kept.table), toml_string(kept.model));
}

KeptRequest read_kept(const std::string& text, const std::string& file) {
  const io::Document document(text, file, request_schema());
  document.check();
  KeptRequest kept{request_in(document), document.text("name", ""), document.text("table", ""),
                   document.text("model", "")};
  // No option but the argument of the verb, so that the list above does not hold it.
  kept.request.rock = document.text("rock", "");
  return kept;
}

std::vector<Problem> differences(const CalibrationRequest& request, const CalibrationRequest& begun) {
  std::vector<Problem> problems;  // all at once, so that one more try is enough
  for (const CalibrationOption& o : calibration_options())
    // --out and --resume say where and how: another folder name is the same calibration.
    if (o.changes_result && o.value(request) != o.value(begun))
      problems.push_back(
          option_problem(o.word(), option_text(o.value(request)),
                         fmt::format("{}, which {} was begun with", option_text(o.value(begun)), request.out),
                         "or another " + option("out") + ", which begins afresh"));
  return problems;
}

}  // namespace phy::jobs
