#include "io/load.hpp"

#include <algorithm>
#include <filesystem>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "base/quote.hpp"
#include "io/csv.hpp"
#include "io/file.hpp"
#include "io/json.hpp"
#include "io/output.hpp"
#include "io/scene.hpp"
#include "io/store.hpp"
#include "io/toml_in.hpp"

namespace phy::io {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// JSON has no NaN: it was written as null.
double number(const Json& j) { return j.is_number() ? j.get<double>() : nan; }

Outcome read_outcome(const Json& j, const std::string& where) {
  const std::string name = j.at("status");
  const std::optional<Status> status = status_of(name);
  if (status) return {*status, j.at("reason"), j.at("advice")};
  std::string known;
  for (const Status s : all_statuses) known += std::string(known.empty() ? "" : ", ") + to_string(s);
  throw InputError(Problem{where, "outcome.status", name, "one of " + known,
                           "another version may have written it: run the recipe again"});
}

void read_numbers(const Json& j, SpecimenRecord& record) {
  for (const auto& [name, n] : j.at("numbers").items())
    record.result.numbers.push_back({name, number(n.at("value")), n.at("unit"), n.at("definition"),
                                     n.value("note", ""), n.value("upper_bound", false)});
}

void read_packing(const Json& j, SpecimenRecord& record) {
  const Json& p = j.at("packing");
  record.packing_hash = p.at("hash");
  record.n_grains = whole_number<std::int64_t>(p.at("n_grains"));
  record.stress_free = p.at("stress_free");
  PackingReport& r = record.packing;
  r.porosity = number(p.at("porosity"));
  r.coordination = number(p.at("coordination"));
  r.fabric = number(p.at("fabric"));
  r.stress_left = number(p.at("stress_left [Pa]"));
  r.n_rattlers = whole_number<decltype(r.n_rattlers)>(p.at("n_rattlers"));
  r.mean_overlap = number(p.at("mean_overlap"));
  r.unbalanced = number(p.at("unbalanced"));
  for (const Json& b : j.at("bedding")) {
    BeddingRecord& set = record.bedding.emplace_back();
    set.theta = number(b.at("theta [deg]"));
    set.report.dispersed = b.contains("joint_fraction");
    if (set.report.dispersed)
      set.report.joint_fraction = number(b.at("joint_fraction"));
    else
      set.report = {number(b.at("overlap_ratio")), number(b.at("bridge_fraction")),
                    number(b.at("non_crossing_fraction"))};
  }
}

Json parse_format(const std::string& text) {
  Json j = parse_json<Json>(text);
  // A result of another format may have the same keys with another meaning.
  if (j.at("format") != result_format) throw std::out_of_range("another version of the format");
  return j;
}

Recipe recipe_in(const Json& j, const std::string& where) {
  return parse_recipe(j.at("recipe").get<std::string>(), where + ": recipe");
}

/// Throws InputError where texts hold control characters: no result of this program has them, and a terminal
/// would obey them. The recipe, a text of many lines, is looked at where it is read.
void refuse_control_characters(const Json& j, const std::string& where) {
  std::vector<Problem> problems;
  // Flattened: every text of any depth with its path, names of keys included.
  const Json flat = j.flatten();
  for (const auto& [path, value] : flat.items()) {
    const std::string text = value.is_string() ? value.get<std::string>() : "";
    if (path == "/recipe" || (is_plain(path) && is_plain(text))) continue;
    problems.push_back(
        {where, path.substr(1), text, "text without control characters", "run the recipe again"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

SpecimenRecord parse_result(const std::string& text, const std::string& where) {
  const Json j = parse_format(text);
  refuse_control_characters(j, where);
  SpecimenRecord record;
  record.program = j.at("program");
  record.recipe = recipe_in(j, where);
  TestResult& r = record.result;
  r.name = j.at("specimen");
  r.kind = record.recipe.test.kind;
  // Intact rock has no angle in the file.
  r.intact = !j.contains("theta [deg]");
  if (!r.intact) r.theta = number(j.at("theta [deg]"));
  r.outcome = read_outcome(j.at("outcome"), where);
  read_numbers(j, record);
  read_packing(j, record);
  const Json& run = j.at("run");
  r.dt = number(run.at("dt [s]"));
  r.n_steps = whole_number<std::int64_t>(run.at("n_steps"));
  r.n_contacts = whole_number<std::int64_t>(run.at("n_contacts"));
  r.seconds = number(run.at("cpu_seconds"));
  r.hash = j.at("result_hash");
  return record;
}

/// Without throwing: a folder that cannot be entered holds no result.
bool is_result(const fs::path& folder) {
  std::error_code none;
  return fs::exists(folder / "result.json", none);
}

/// What reads a folder that is no run.
std::string verb_for(const fs::path& folder) {
  const std::pair<const char*, const char*> verbs[] = {
      {"study.toml", "this is a study: `phyllite study status FOLDER`, `phyllite study effects FOLDER`"},
      {"calibration.json",
       "this is a calibration: `phyllite figure FOLDER` draws it, its tables are in tables.txt"},
      {"request.toml",
       "this is a calibration without an end: `phyllite calibrate ROCK --out FOLDER --resume` goes on with "
       "it"},
      {"envelope.csv", "this is an envelope: name one of its folders sigma_3_..."}};
  std::error_code none;
  for (const auto& [file, verb] : verbs)
    if (fs::exists(folder / file, none)) return verb;
  return "name what `phyllite run` wrote (its --out), or a folder of `phyllite envelope` in it";
}

/// What is read from a result.json; whatever is wrong with it becomes an InputError that names the file.
template <class Parse>
auto parsed(const std::string& file, const Parse& parse) {
  // Missing keys and wrong types come as exceptions of the JSON library.
  try {
    return parse(read_written(file));
  } catch (const nlohmann::json::exception& e) {
    throw InputError(Problem{file, "", "", "a result of format 1", in_words(e)});
  } catch (const std::out_of_range& e) {
    throw InputError(Problem{file, "", "", "a result of format 1", in_words(e)});
  }
}

std::string json_of(const std::string& folder) { return (fs::path(folder) / "result.json").string(); }

/// Specimens that the recipe of the run names and that have no folder among the results.
void report_missing(RunRecord& run, const std::string& path) {
  // Given the folder of a single specimen, the others are not expected. A folder that is there but cannot be
  // read has been listed by its path already.
  if (run.tests.empty() || is_result(path)) return;
  for (const std::string& name : specimen_names(run.tests.front().recipe)) {
    const bool found = std::any_of(run.tests.begin(), run.tests.end(),
                                   [&](const SpecimenRecord& t) { return t.result.name == name; }) ||
                       std::any_of(run.missing.begin(), run.missing.end(), [&](const MissingTest& m) {
                         return fs::path(m.name).filename() == folder_name(name);
                       });
    if (!found) run.missing.push_back({name, "no result in the folder: run the recipe again"});
  }
}

}  // namespace

std::vector<std::string> result_folders(const std::string& path) {
  // One specimen, or a run: a folder of specimens.
  if (is_result(path)) return {path};
  std::vector<std::string> folders;
  for (const std::string& entry : list_folder(path))
    if (is_result(entry) && !is_temporary(entry)) folders.push_back(entry);
  return folders;
}

Recipe read_result_recipe(const std::string& folder) {
  const std::string file = json_of(folder);
  return parsed(file, [&](const std::string& text) { return recipe_in(parse_format(text), file); });
}

SpecimenRecord read_result(const std::string& folder) {
  const std::string file = json_of(folder);
  SpecimenRecord record = parsed(file, [&](const std::string& text) { return parse_result(text, file); });
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  History& history = record.result.history;
  history = parse_history(read_written(path("history.csv")), path("history.csv"));
  // The columns of a history do not hold the size of the specimen.
  history.width = record.recipe.specimen.width, history.height = record.recipe.specimen.height;
  record.result.cracks = parse_cracks(read_written(path("cracks.csv")), path("cracks.csv"));
  if (fs::exists(path("events.csv")))
    record.result.events = parse_events(read_written(path("events.csv")), path("events.csv"));
  if (fs::exists(path("opening.csv")))
    record.result.wall = parse_wall(read_written(path("opening.csv")), path("opening.csv"));
  // Not read, as result.json has the recipe, but people do: it must say what was run.
  if (fs::exists(path("recipe.toml"))) read_written(path("recipe.toml"));
  // It is only a picture: whoever removes it to save room keeps the numbers.
  if (fs::exists(path("scene.bin")))
    record.scene = unpack_scene(read_written(path("scene.bin")), path("scene.bin"));
  return record;
}

RunRecord read_run(const std::string& path) {
  RunRecord run;
  std::string last;
  const std::vector<std::string> folders = result_folders(path);
  if (folders.empty())
    throw InputError(
        Problem{path, "", "", "a folder with result.json, or a folder of such folders", verb_for(path)});
  for (const std::string& folder : folders) {
    // One unreadable specimen does not hide the others.
    try {
      run.tests.push_back(read_result(folder));
    } catch (const InputError& e) {
      run.missing.push_back({folder, last = e.what(), true});
    } catch (const IoError& e) {
      run.missing.push_back({folder, last = e.what(), true});
    }
  }
  if (run.tests.empty()) throw InputError(Problem{path, "", "", "a result that can be read", last});
  // In the order of angles, intact rock last, whatever the names of folders.
  std::stable_sort(run.tests.begin(), run.tests.end(), [](const SpecimenRecord& a, const SpecimenRecord& b) {
    return a.result.intact != b.result.intact ? b.result.intact : a.result.theta < b.result.theta;
  });
  report_missing(run, path);
  return run;
}

}  // namespace phy::io
