#include "gui/api.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

#include "base/check.hpp"
#include "base/embedded.hpp"
#include "base/parallel.hpp"
#include "base/quote.hpp"
#include "base/version.hpp"
#include "gui/grab.hpp"
#include "gui/imports.hpp"
#include "gui/options.hpp"
#include "gui/project.hpp"
#include "gui/recipes.hpp"
#include "gui/results.hpp"
#include "io/file.hpp"
#include "io/json.hpp"
#include "io/load.hpp"
#include "io/reads.hpp"
#include "io/toml_in.hpp"
#include "jobs/calibration_folder.hpp"
#include "jobs/calibration_watch.hpp"
#include "jobs/folder_lock.hpp"
#include "jobs/machine.hpp"
#include "jobs/press_watch.hpp"
#include "jobs/report.hpp"
#include "jobs/rock_base.hpp"
#include "records/test_description.hpp"
#include "rock/schema.hpp"
#include "system/files.hpp"

namespace phy::gui {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t longest_log = 20000;          // of what is shown
constexpr std::size_t longest_command = 4096;       // at the beginning of a log
constexpr std::size_t largest_answer = 16U << 20U;  // calibration.json and the like
constexpr std::chrono::milliseconds at_once{1500};  // in which a refused command has ended

// Logs and files of users need not be UTF-8; a page without an answer would be worse than a replaced letter.
Response json(const Json& j, int status = 200) {
  return {status, "application/json", j.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

Response error(int status, const std::string& text) { return json({{"error", text}}, status); }

std::optional<std::string> text_or_null(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<std::string>());
}

/// The value of a key of what was asked; `otherwise` where it is absent or null.
template <class T>
T get(const Json& asked, const char* key, T otherwise) {
  return asked.contains(key) && !asked[key].is_null() ? asked[key].get<T>() : otherwise;
}

std::string path_in(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

// Beside the folder: the log begins before the command has made it.
std::string log_of(const std::string& folder) { return folder + ".log"; }

/// The command that a child was (gui/child.hpp), and what it has printed last.
struct Log {
  std::string command, tail;
};

/// Of any length; empty where there is none.
Log log_in(const std::string& file) {
  try {
    const io::InputFile log(file);
    // Head and tail alone: a calibration of a night prints more than a page should hold.
    const std::string head = log.read(0, longest_command);
    const std::size_t from = log.size() - std::min(log.size(), longest_log);
    const std::string tail = log.read(from, longest_log);
    return {head.starts_with("$ ") ? head.substr(2, head.find('\n') - 2) : "",
            // Cut at a line, which also cuts no letter of UTF-8 in two.
            from == 0 ? tail : tail.substr(tail.find('\n') + 1)};
  } catch (const IoError&) {
    return {};
  }
}

/// Null where there is no such file, or no JSON in it.
// A file may be half written or missing at any moment: that is no error of the request.
Json json_in(const std::string& file) {
  try {
    const auto text = io::read_if_file(file, largest_answer);
    return text ? io::parse_json<Json>(*text) : Json(nullptr);
  } catch (const std::exception&) {
    return nullptr;
  }
}

/// Those of a folder that a user would open.
Json files_in(const std::string& folder, const std::vector<const char*>& names) {
  Json files = Json::array();
  for (const char* name : names)
    if (exists(path_in(folder, name))) files.push_back(path_in(folder, name));
  return files;
}

/// What a recipe asks for; nullptr: it cannot be read.
const TestDescription* test_in(const std::string& recipe) {
  try {
    return &*io::read_recipe(recipe).test.kind;
  } catch (const std::exception&) {
    return nullptr;
  }
}

/// The value behind keys, one in the other; null where one of them is missing.
Json value_in(const Json& j, const std::vector<std::string>& keys) {
  const Json* value = &j;
  for (const std::string& key : keys) {
    if (!value->is_object() || !value->contains(key)) return nullptr;
    value = &value->at(key);
  }
  return *value;
}

/// The number that a test was made for.
Json specimen_json(const Json& result, const TestDescription* test) {
  Json j = {{"specimen", value_in(result, {"specimen"})},
            {"theta", value_in(result, {"theta [deg]"})},
            {"status", value_in(result, {"outcome", "status"})},
            {"grade", value_in(result, {"quality", "grade"})},
            {"notes", Json::array()}};
  const Json marks = value_in(result, {"quality", "marks"});
  for (const Json& mark : marks)
    // Results of an earlier version have other keys; what lacks is left out.
    if (const Json says = value_in(mark, {"says"}); says.is_string()) j["notes"].push_back(says);
  if (test == nullptr) return j;
  const TestQuantity made_for = test->curve.quantity();
  j["strength"] = made_for.label;
  j["value"] = value_in(result, {"numbers", made_for.number, "value"});
  j["unit"] = value_in(result, {"numbers", made_for.number, "unit"});
  return j;
}

/// What a page has sent.
Json asked_in(const std::string& body) {
  try {
    return io::parse_json<Json>(body);
  } catch (const std::out_of_range&) {
    throw InputError(Problem{"the request is nested too deep", "", "", "", ""});
  }
}

/// The folder may be removed while the program works in it: no file is found by its name then.
void check_home() {
  std::error_code gone;
  static_cast<void>(fs::current_path(gone));
  if (gone)
    throw IoError(
        "The folder of `phyllite gui` is no longer there. End the program with Ctrl-C, and start it in a "
        "folder that is.");
}

/// "": nothing is said.
std::string said_in(const std::map<std::string, std::string>& query, const char* key) {
  const auto found = query.find(key);
  return found == query.end() ? "" : found->second;
}

/// Where something is tested: a calibration, or a test.
std::string folder_of(const std::map<std::string, std::string>& query) {
  const std::string name = said_in(query, "name"), test = said_in(query, "test");
  // A name becomes part of a path: "../" in it would lead out of the folder.
  check_name(name);
  if (test.empty()) return calibration_of(name, said_in(query, "calibration"));
  check_name(test);
  return path_in(tests_of(name), test);
}

/// The recipe that a calibration has left.
std::string model_of(const Json& asked) {
  const std::string name = asked.at("name");
  check_name(name);
  const std::string folder = calibration_of(name, get<std::string>(asked, "calibration", ""));
  std::string recipe = path_in(folder, "calibrated.toml");
  if (!exists(recipe))
    throw InputError(Problem{"", "rock", name, "a rock that has been calibrated", "calibrate it first"});
  return recipe;
}

Json choices_of(const char* key) { return find_field(rock::rock_schema().fields, key)->choices; }

}  // namespace

Response Api::answer(const Request& request) {
  try {
    Response response = route(request);
    // What was read cannot be written over by the same job; each request is a job of its own.
    io::forget_reads();
    return response;
  } catch (const Changed& e) {
    return error(409, e.what());
  } catch (const InputError& e) {
    return error(400, e.what());
  } catch (const Json::exception&) {
    // After an update an open tab still runs the old page.
    return error(400, "not what the page of this version asks: load the page anew");
  } catch (const std::exception& e) {
    return error(500, e.what());
  }
}

Response Api::route(const Request& request) {
  const bool reads = request.method == "GET";
  // Before check_home: even without its folder the page should load and say what is wrong.
  if (reads && request.path == "/")
    return {200, "text/html; charset=utf-8", std::string(embedded("web/gui.html"))};
  check_home();
  if (reads && request.path.starts_with("/files/")) {
    const auto file = served_file(request.path.substr(7));
    if (!file) return error(404, "no such file in the folder of `phyllite gui`");
    // Opened here, sent later: what is sent is the file that was checked.
    return {200, content_type(*file), "", std::make_shared<io::InputFile>(*file)};
  }
  if (reads) return read(request);
  if (request.path == "/api/table") return json(table_from(request.body, said_in(request.query, "name")));
  return changed(request);
}

/// What has no body.
Response Api::read(const Request& request) {
  if (request.path == "/api/project") return json(project());
  if (request.path == "/api/press") {
    const auto text = io::read_if_file(path_in(folder_of(request.query), jobs::press_file), largest_answer);
    // Passed on as it is: megabytes four times a second would be parsed for nothing.
    return {200, "application/json", text ? *text : "null"};
  }
  const std::string name = said_in(request.query, "name");
  if (request.path == "/api/base") return json(rock_like(name));
  constexpr std::string_view of_rocks[] = {"/api/rock", "/api/results", "/api/broken"};
  if (std::ranges::find(of_rocks, request.path) == std::end(of_rocks)) return error(404, "no such address");
  check_name(name);
  const std::string calibration = said_in(request.query, "calibration");
  if (request.path == "/api/rock") return json(rock(name, calibration));
  if (request.path == "/api/results") return json(results_answer(name, calibration_of(name, calibration)));
  const std::string test = said_in(request.query, "test");
  check_name(test);
  return json(broken_answer(name, test));
}

/// What has a body of JSON.
Response Api::changed(const Request& request) {
  const Json asked = asked_in(request.body);
  if (request.path == "/api/check") {
    check_name(asked.at("name").get<std::string>());
    return json(check_answer(asked.at("name"), asked.at("toml"), text_or_null(asked.at("table"))));
  }
  if (request.path == "/api/discs") {
    check_name(asked.at("name").get<std::string>());
    return json(discs_answer(asked.at("name"), asked.at("toml"), text_or_null(asked.at("table"))));
  }
  if (request.path == "/api/recipe")
    return json(
        recipe_answer(model_of(asked), asked.at("changes").get<std::map<std::string, std::string>>()));
  if (request.path == "/api/moduli") return json(moduli_answer(model_of(asked), asked.at("theta")));
  // Before the lock: stopping must not wait for a save or a start.
  if (request.path == "/api/stop") return json(stop(asked));
  // Two tabs may save or start at once; the second must see what the first has done.
  const std::lock_guard lock(changes_);
  if (request.path == "/api/save") return saved(asked);
  if (request.path == "/api/report") return json(report(asked));
  if (request.path == "/api/calibrate") return json(calibrate(asked));
  if (request.path == "/api/test") return json(run_test(asked));
  return error(404, "no such address");
}

/// 409, and what the files hold now, where somebody else has changed them.
Response Api::saved(const Json& asked) {
  try {
    return json(save(asked));
  } catch (const Changed& e) {
    // Both versions at once, so that the page can show them side by side.
    const RockFiles now = read_rock_files(asked.at("name"));
    Json j = {{"error", e.what()}, {"toml", now.toml}, {"table", nullptr}, {"stamp", now.stamp}};
    if (now.table) j["table"] = *now.table;
    return json(j, 409);
  }
}

Json Api::project() {
  Json rocks = Json::array();
  for (const std::string& name : rock_names()) {
    const Json c = brief(calibration_of(name));
    rocks.push_back({{"name", name}, {"state", c["state"]}, {"verdict", value_in(c, {"verdict", "status"})}});
  }
  return {
      {"version", phy::version},
      {"folder", fs::current_path().string()},
      {"threads", jobs::n_threads(threads_)},
      {"file_token", file_token_},
      {"choices",
       {{"E_is", choices_of("E_is")}, {"layers", choices_of("layers")}, {"matrix", choices_of("matrix")}}},
      {"columns", choices_of("columns.\"header\"")},
      {"options", options_json()},
      {"measured", jobs::base_rocks()},
      {"rocks", std::move(rocks)},
      {"kinds", kinds_json()},
      {"keys", keys_json()}};
}

Json Api::rock(const std::string& name, const std::string& chosen) {
  const RockFiles files = read_rock_files(name);
  Json all = Json::array();
  for (const std::string& folder : calibrations_of(name)) all.push_back(brief(folder));
  Json tests = Json::array();
  for (const std::string& t : test_names(name)) tests.push_back(test(name, t));
  return {{"name", name},
          {"table", files.table ? Json(*files.table) : Json(nullptr)},
          {"toml", files.toml},
          {"table_file", files.table_file},
          {"stamp", files.stamp},
          {"exists", exists(name + ".toml")},
          {"calibration", calibration(name, calibration_of(name, chosen))},
          {"calibrations", std::move(all)},
          {"tests", std::move(tests)}};
}

Api::Work Api::work_in(const std::string& folder) {
  // Before the lock, since it looks at a file.
  const int other = jobs::working_in(folder);
  const std::lock_guard lock(mutex_);
  const auto child = children_.find(folder);
  if (child != children_.end() && child->second->running()) {
    const int process = child->second->process();
    // The page asks once a second: that is the clock by which patience with an ending process runs out.
    if (child->second->ending.asked(process)) child->second->ending.ask(process);
    return {process, true, -1};
  }
  // A process number is given out again: what was asked of the last owner must not hit the next.
  if (other <= 0) others_.erase(folder);
  if (const auto ending = others_.find(folder); ending != others_.end() && ending->second.asked(other))
    ending->second.ask(other);
  return {other, false, child == children_.end() ? -1 : child->second->exit_code()};
}

std::string Api::state_of_calibration(const std::string& folder) {
  // Asked first: a process that is gone by now has written its report.
  const Work work = work_in(folder);
  if (work.process != 0) return "running";
  const bool finished = exists(path_in(folder, "calibration.json"));
  const Json reported = value_in(json_in(path_in(folder, jobs::watch_file)), {"state"});
  // without a process "running" was killed; the report may be missing though all else is there
  if (finished && (reported.is_null() || reported == "finished")) return "finished";
  if (reported == "stopped" || reported == "running") return "stopped";
  if (work.exit_code >= 2 || reported == "failed") return "failed";
  return jobs::request_in(folder) ? "stopped" : "new";
}

/// Of a long file, which every page asks for once a second: read again only where it has changed.
Json Api::result_in_brief(const std::string& folder) {
  const std::string file = path_in(folder, "calibration.json");
  const auto about = system::about(file);
  if (!about) return {{"verdict", nullptr}, {"errors", Json::array()}, {"effort", nullptr}};
  {
    const std::lock_guard lock(mutex_);
    const auto known = briefs_.find(folder);
    if (known != briefs_.end() && known->second.identity == about->identity) return *known->second.json;
  }
  const Json result = json_in(file);
  const Json errors = value_in(result, {"errors"});
  Json j = {{"verdict", value_in(result, {"verdict"})},
            {"errors", errors.is_array() ? errors : Json::array()},
            {"effort", value_in(result, {"effort"})}};
  const std::lock_guard lock(mutex_);
  briefs_[folder] = {about->identity, std::make_shared<Json>(j)};
  return j;
}

/// A calibration among others.
Json Api::brief(const std::string& folder) {
  Json j = result_in_brief(folder);
  j["verdict"] = Json{{"status", value_in(j, {"verdict", "status"})}};
  j["folder"] = folder;
  j["state"] = state_of_calibration(folder);
  j["tested"] = exists(path_in(folder, "calibrated.toml"));
  j["began"] = jobs::seconds_since_lock(folder);
  return j;
}

Json Api::calibration(const std::string& name, const std::string& folder) {
  const Log log = log_in(log_of(folder));
  const auto earlier = jobs::request_in(folder);
  const auto [process, here, code] = work_in(folder);
  const std::string state = state_of_calibration(folder);
  jobs::CalibrationRequest next = earlier.value_or(jobs::CalibrationRequest{});
  next.rock = name + ".toml", next.out = folder;
  // A calibration that is finished begins anew; only what was cut short goes on.
  next.resume = earlier && (state == "stopped" || state == "failed");
  return {{"state", state},
          // What runs shows the command that started it, all else the one that a click would start.
          {"command", here ? log.command : command_of(jobs::command_line_of(next))},
          {"resumes", next.resume},
          {"folder", folder},
          {"next", next_calibration_of(name)},
          {"seconds", process != 0 ? Json(jobs::seconds_since_lock(folder)) : Json(nullptr)},
          {"here", here},
          {"progress", json_in(path_in(folder, jobs::watch_file))},
          {"log", log.tail},
          {"verdict", result_in_brief(folder)["verdict"]},
          {"exit_code", code >= 0 ? Json(code) : Json(nullptr)},
          {"files", files_in(folder, {"report.html", "calibrated.toml", "tables.txt", "calibration.json",
                                      "calibrated.p2dat", "calibrated-yade.py"})}};
}

Json Api::test(const std::string& rock, const std::string& name) {
  const std::string recipe = path_in(tests_of(rock), name + ".toml"), folder = path_in(tests_of(rock), name);
  const TestDescription* kind = test_in(recipe);
  Json specimens = Json::array();
  if (exists(folder))
    for (const std::string& of : io::result_folders(folder))
      if (const Json result = json_in(path_in(of, "result.json")); result.is_object())
        specimens.push_back(specimen_json(result, kind));
  const auto [process, here, code] = work_in(folder);
  // Exit codes 0 and 1 are results, the second of a test without a peak.
  const std::string state = process != 0                             ? "running"
                            : code >= 2                              ? "failed"
                            : exists(path_in(folder, "report.html")) ? "finished"
                            : specimens.empty() && code < 0          ? "new"
                                                                     : "stopped";
  Json files = files_in(folder, {"report.html"});
  // The recipe lies beside the folder, as it is there before the test is.
  files.push_back(recipe);
  return {{"name", name},
          {"state", state},
          {"command", command_of({"run", recipe, "--out", folder})},
          {"log", log_in(log_of(folder)).tail},
          {"exit_code", code >= 0 ? Json(code) : Json(nullptr)},
          {"seconds", state == "running" ? Json(jobs::seconds_since_lock(folder)) : Json(nullptr)},
          {"files", std::move(files)},
          {"specimens", std::move(specimens)}};
}

Json Api::save(const Json& asked) {
  const std::string name = asked.at("name"), toml = asked.at("toml");
  const std::optional<std::string> table = text_or_null(asked.at("table"));
  const std::string stamp = save_rock(name, toml, table, asked.at("stamp"));
  Json files = {name + ".toml"};
  if (table) files.push_back(table_named_in(toml, ""));
  return {{"stamp", stamp}, {"files", std::move(files)}};
}

Json Api::start(const std::vector<std::string>& words, const std::string& folder) {
  if (work_in(folder).process != 0)
    throw InputError(Problem{"", folder, "", "nothing that works there", "it is running already"});
  std::vector<std::string> all = words;
  if (threads_ > 0) all.insert(all.end(), {"--threads", fmt::format("{}", threads_)});
  // Under another name: a command that is refused must not cost the log of the run before it.
  const std::string log = log_of(folder) + ".begun";
  auto child = std::make_unique<Child>(all, log);
  {
    const std::lock_guard lock(mutex_);
    children_[folder] = std::move(child);
  }
  check_started(folder, log);
  return {{"command", command_of(all)}};
}

/// What cannot be done is refused at once, where it was asked for, and nothing has begun. What goes
/// on takes the place of an earlier log. Without threads nothing is heard of it while this one waits.
void Api::check_started(const std::string& folder, const std::string& log) {
  const auto start = std::chrono::steady_clock::now();
  while (has_threads() && work_in(folder).here && std::chrono::steady_clock::now() - start < at_once &&
         // A lock on the folder means that all checks are passed.
         jobs::working_in(folder) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::error_code none;
  if (work_in(folder).exit_code < 2) return fs::rename(log, log_of(folder), none);
  const std::string said = log_in(log).tail;
  fs::remove(log, none);
  const std::lock_guard lock(mutex_);
  children_.erase(folder);
  // The command's own words, without the line that names it.
  throw InputError(Problem{said.substr(said.find('\n') + 1), "", "", "", ""});
}

Json Api::calibrate(const Json& asked) {
  const std::string name = asked.at("name");
  check_name(name);
  if (!exists(name + ".toml"))
    throw InputError(Problem{"", "rock", name, "a rock that has been saved", "save it first"});
  const std::string now = calibration_of(name, get<std::string>(asked, "calibration", ""));
  for (const std::string& other : calibrations_of(name))
    // Two would share the cores, and both take twice as long.
    if (work_in(other).process != 0)
      throw InputError(Problem{"", other, "", "one calibration of a rock at a time", "stop the other first"});
  const auto earlier = jobs::request_in(now);
  // Options of the first start: others would be refused, as they change the result.
  const bool resume = earlier && get(asked, "resume", false);
  jobs::CalibrationRequest request = resume ? *earlier : request_from(get(asked, "options", Json::object()));
  request.resume = resume;
  request.rock = name + ".toml";
  request.out = get(asked, "anew", false) ? next_calibration_of(name) : now;
  // A link of this name may lead anywhere.
  check_inside(request.out);
  return start(jobs::command_line_of(request), request.out);
}

/// Of a calibration, anew: what its rock file says of the first page may have changed.
Json Api::report(const Json& asked) {
  const std::string name = asked.at("name");
  check_name(name);
  const std::string folder = calibration_of(name, get<std::string>(asked, "calibration", ""));
  if (!exists(path_in(folder, "calibration.json")) || work_in(folder).process != 0)
    throw InputError(Problem{"", folder, "", "a calibration that has ended", ""});
  jobs::write_report(folder);
  return Json::object();
}

Json Api::stop(const Json& asked) {
  const std::string name = asked.at("name"), test = get<std::string>(asked, "test", "");
  check_name(name);
  if (!test.empty()) check_name(test);
  const std::string calibration = get<std::string>(asked, "calibration", "");
  const std::string folder = test.empty() ? calibration_of(name, calibration) : path_in(tests_of(name), test);
  const int process = work_in(folder).process;
  const std::lock_guard lock(mutex_);
  const auto child = children_.find(folder);
  const bool here = child != children_.end() && child->second->process() == process;
  if (process <= 0 || !(here ? child->second->ending : others_[folder]).ask(process))
    throw InputError(
        Problem{"", folder, "", "something that runs on this machine, and that you may stop", ""});
  return Json::object();
}

Json Api::run_test(const Json& asked) {
  const std::string rock = asked.at("name"), name = asked.at("test");
  check_name(rock), check_name(name);
  const std::string recipe = path_in(tests_of(rock), name + ".toml"), folder = path_in(tests_of(rock), name);
  const auto typed = text_or_null(asked.at("toml"));
  // Without a text an existing test goes on: its recipe lies there.
  const std::string toml = typed ? *typed : io::read_file(recipe, largest_document);
  // The same recipe again is no conflict, but another one would leave results without their recipe.
  if (work_in(folder).process != 0 || (exists(recipe) && io::read_if_file(recipe) != toml))
    throw InputError(Problem{"", "name", name, "a name that is free", "a test of this name is there"});
  // throws: a recipe that cannot run, or lacks what its test keeps, takes no name
  if (const auto missing = missing_stress(io::parse_recipe(toml, recipe))) throw InputError(*missing);
  check_inside(folder);
  if (!exists(recipe)) io::write_file(recipe, toml);
  return start({"run", recipe, "--out", folder}, folder);
}

void Api::end() {
  std::map<std::string, std::unique_ptr<Child>> all;
  {
    const std::lock_guard lock(mutex_);
    // Taken out under the lock and ended without it, as waiting may take seconds.
    all.swap(children_);
  }
  for (const auto& [folder, child] : all)
    // All are asked before any is waited for: they end side by side.
    if (child->running()) child->ending.ask(child->process());
}

std::vector<std::string> Api::running() {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> folders;
  for (const auto& [folder, child] : children_)
    if (child->running()) folders.push_back(folder);
  return folders;
}

}  // namespace phy::gui
