#include "desk/desk.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>
#include <utility>

#include "base/check.hpp"
#include "base/embedded.hpp"
#include "desk/project.hpp"
#include "desk/recipes.hpp"
#include "io/file.hpp"
#include "io/json.hpp"
#include "io/load.hpp"
#include "io/reads.hpp"
#include "io/rock_in.hpp"
#include "io/toml_in.hpp"
#include "jobs/calibration_folder.hpp"
#include "jobs/calibration_watch.hpp"
#include "jobs/folder_lock.hpp"
#include "jobs/machine.hpp"
#include "records/test_description.hpp"

namespace phy::desk {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t longest_log = 20000;          // of what is shown
constexpr std::chrono::milliseconds at_once{1500};  // in which a refused command has ended

Response json(const Json& j, int status = 200) {
  return {status, "application/json", j.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

Response error(int status, const std::string& text) { return json({{"error", text}}, status); }

/// The value of a key of what was asked; `otherwise` where it is absent or null.
template <class T>
T get(const Json& asked, const char* key, T otherwise) {
  return asked.contains(key) && !asked[key].is_null() ? asked[key].get<T>() : otherwise;
}

std::string path_in(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

std::string log_of(const std::string& folder) { return folder + ".log"; }

/// The text of a file, or nothing.
std::string content(const std::string& file) {
  try {
    return exists(file) ? io::read_file(file) : "";
  } catch (const IoError&) {
    return "";
  }
}

std::string tail(const std::string& text) {
  return text.size() <= longest_log ? text : text.substr(text.find('\n', text.size() - longest_log) + 1);
}

/// The first line of what a child has printed (desk/child.hpp).
std::string command_in(const std::string& log) {
  return log.starts_with("$ ") ? log.substr(2, log.find('\n') - 2) : "";
}

/// Null where there is no such file, or no JSON in it.
Json json_in(const std::string& file) {
  try {
    const std::string text = content(file);
    return text.empty() ? Json(nullptr) : io::parse_json<Json>(text);
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
    if (const Json says = value_in(mark, {"says"}); says.is_string()) j["notes"].push_back(says);
  if (test == nullptr) return j;
  const TestQuantity made_for = test->curve.quantity();
  j["strength"] = made_for.label;
  j["value"] = value_in(result, {"numbers", made_for.number, "value"});
  j["unit"] = value_in(result, {"numbers", made_for.number, "unit"});
  return j;
}

Json choices_of(const char* key) { return find_field(io::rock_schema().fields, key)->choices; }

}  // namespace

Response Desk::answer(const Request& request) {
  try {
    Response response = route(request);
    io::forget_reads();
    return response;
  } catch (const Changed& e) {
    return error(409, e.what());
  } catch (const InputError& e) {
    return error(400, e.what());
  } catch (const Json::exception&) {
    return error(400, "not what the page of this version asks: load the page anew");
  } catch (const std::exception& e) {
    return error(500, e.what());
  }
}

Response Desk::route(const Request& request) {
  const bool get = request.method == "GET";
  if (get && request.path == "/")
    return {200, "text/html; charset=utf-8", std::string(embedded("web/lab.html"))};
  if (get && request.path.starts_with("/files/")) {
    const auto file = served_file(request.path.substr(7));
    if (!file) return error(404, "no such file in the folder of `phyllite lab`");
    return {200, content_type(*file), io::read_file(*file), true};
  }
  if (get && request.path == "/api/project") return json(project());
  if (get && request.path == "/api/rock") {
    const auto name = request.query.find("name");
    return json(rock(name == request.query.end() ? "" : name->second));
  }
  if (get) return error(404, "no such address");
  const Json asked = io::parse_json<Json>(request.body);
  if (request.path == "/api/check") {
    check_name(asked.at("name").get<std::string>());
    const auto table = desk::get<std::string>(asked, "table", "");
    return json(check_answer(asked.at("name"), asked.at("toml"),
                             asked.at("table").is_null() ? std::nullopt : std::optional(table)));
  }
  if (request.path == "/api/recipe") {
    const std::string name = asked.at("name");
    check_name(name);
    const std::string base = path_in(calibration_of(name), "calibrated.toml");
    if (!exists(base))
      throw InputError(Problem{"", "rock", name, "a rock that has been calibrated", "calibrate it first"});
    return json(recipe_answer(base, asked.at("changes").get<std::map<std::string, std::string>>()));
  }
  const std::lock_guard lock(mutex_);
  if (request.path == "/api/save") return saved(asked);
  if (request.path == "/api/calibrate") return json(calibrate(asked));
  if (request.path == "/api/stop") return json(stop(asked));
  if (request.path == "/api/test") return json(run_test(asked));
  return error(404, "no such address");
}

/// 409, and what the files hold now, where somebody else has changed them.
Response Desk::saved(const Json& asked) {
  try {
    return json(save(asked));
  } catch (const Changed& e) {
    const RockFiles now = read_rock_files(asked.at("name"));
    Json j = {{"error", e.what()}, {"toml", now.toml}, {"table", nullptr}, {"stamp", now.stamp}};
    if (now.table) j["table"] = *now.table;
    return json(j, 409);
  }
}

Json Desk::project() {
  const std::lock_guard lock(mutex_);
  Json rocks = Json::array();
  for (const std::string& name : rock_names()) {
    const Json c = calibration(name);
    rocks.push_back({{"name", name}, {"state", c["state"]}, {"verdict", value_in(c, {"verdict", "status"})}});
  }
  return {
      {"version", PHY_VERSION},
      {"folder", fs::current_path().string()},
      {"threads", jobs::n_threads(threads_)},
      {"file_token", file_token_},
      {"choices",
       {{"E_is", choices_of("E_is")}, {"layers", choices_of("layers")}, {"matrix", choices_of("matrix")}}},
      {"columns", choices_of("columns.\"header\"")},
      {"rocks", std::move(rocks)},
      {"kinds", kinds_json()},
      {"keys", keys_json()}};
}

Json Desk::rock(const std::string& name) {
  const RockFiles files = read_rock_files(name);
  const std::lock_guard lock(mutex_);
  Json tests = Json::array();
  for (const std::string& t : test_names(name)) tests.push_back(test(name, t));
  return {{"name", name},
          {"table", files.table ? Json(*files.table) : Json(nullptr)},
          {"toml", files.toml},
          {"table_file", files.table_file},
          {"stamp", files.stamp},
          {"exists", exists(name + ".toml")},
          {"calibration", calibration(name)},
          {"tests", std::move(tests)}};
}

pid_t Desk::process_in(const std::string& folder) {
  const auto child = children_.find(folder);
  return child != children_.end() && child->second->running() ? child->second->process()
                                                              : jobs::working_in(folder);
}

int Desk::exit_code(const std::string& folder) {
  const auto child = children_.find(folder);
  return child == children_.end() || child->second->running() ? -1 : child->second->exit_code();
}

Json Desk::calibration(const std::string& name) {
  const std::string folder = calibration_of(name), log = content(log_of(folder));
  const auto earlier = jobs::request_in(folder);
  const bool finished = exists(path_in(folder, "calibration.json"));
  Json progress = json_in(path_in(folder, jobs::watch_file));
  const Json told = value_in(progress, {"state"});
  const pid_t process = process_in(folder);
  const int code = exit_code(folder);
  const bool here = process != 0 && children_.contains(folder) && children_[folder]->running();
  // without a process "running" was killed; the report may be missing though all else is there
  const bool whole = told.is_null() || told == "finished";
  const std::string state = process != 0                             ? "running"
                            : finished && whole                      ? "finished"
                            : told == "stopped" || told == "running" ? "stopped"
                            : code >= 2 || told == "failed"          ? "failed"
                            : earlier                                ? "stopped"
                                                                     : "new";
  jobs::CalibrationRequest next = earlier.value_or(jobs::CalibrationRequest{});
  next.rock = name + ".toml", next.out = folder;
  next.resume = earlier && (state == "stopped" || state == "failed");
  const Json result = finished ? json_in(path_in(folder, "calibration.json")) : Json(nullptr);
  return {{"state", state},
          {"command", here ? command_in(log) : command_of(jobs::words_of(next))},
          {"folder", folder},
          {"next", next_calibration_of(name)},
          {"seconds", process != 0 ? Json(jobs::seconds_since_lock(folder)) : Json(nullptr)},
          {"here", here},
          {"progress", std::move(progress)},
          {"log", tail(log)},
          {"verdict", value_in(result, {"verdict"})},
          {"exit_code", code >= 0 ? Json(code) : Json(nullptr)},
          {"files", files_in(folder, {"report.html", "calibrated.toml", "tables.txt", "calibration.json",
                                      "calibrated.p2dat", "calibrated-yade.py"})}};
}

Json Desk::test(const std::string& rock, const std::string& name) {
  const std::string recipe = path_in(tests_of(rock), name + ".toml"), folder = path_in(tests_of(rock), name);
  const TestDescription* kind = test_in(recipe);
  Json specimens = Json::array();
  if (exists(folder))
    for (const std::string& of : io::result_folders(folder))
      if (const Json result = json_in(path_in(of, "result.json")); result.is_object())
        specimens.push_back(specimen_json(result, kind));
  const int code = exit_code(folder);
  const std::string state = process_in(folder) != 0                  ? "running"
                            : code >= 2                              ? "failed"
                            : exists(path_in(folder, "report.html")) ? "finished"
                            : specimens.empty() && code < 0          ? "new"
                                                                     : "stopped";
  Json files = files_in(folder, {"report.html"});
  files.push_back(recipe);
  return {{"name", name},
          {"state", state},
          {"command", command_of({"run", recipe, "--out", folder})},
          {"log", tail(content(log_of(folder)))},
          {"exit_code", code >= 0 ? Json(code) : Json(nullptr)},
          {"seconds", state == "running" ? Json(jobs::seconds_since_lock(folder)) : Json(nullptr)},
          {"files", std::move(files)},
          {"specimens", std::move(specimens)}};
}

Json Desk::save(const Json& asked) {
  const std::string name = asked.at("name"), toml = asked.at("toml");
  const Json& table = asked.at("table");
  const std::string stamp =
      save_rock(name, toml, table.is_null() ? std::nullopt : std::optional(table.get<std::string>()),
                asked.at("stamp"));
  Json files = {name + ".toml"};
  if (!table.is_null()) files.push_back(table_named_in(toml, ""));
  return {{"stamp", stamp}, {"files", std::move(files)}};
}

Json Desk::start(const std::vector<std::string>& words, const std::string& folder) {
  if (process_in(folder) != 0)
    throw InputError(Problem{"", folder, "", "nothing that works there", "it is running already"});
  std::vector<std::string> all = words;
  if (threads_ > 0) all.insert(all.end(), {"--threads", fmt::format("{}", threads_)});
  children_.erase(folder);
  auto child = std::make_unique<Child>(all, log_of(folder));
  // what cannot be done is refused at once: told where it was asked for, and nothing has been begun
  const auto start = std::chrono::steady_clock::now();
  while (child->running() && std::chrono::steady_clock::now() - start < at_once &&
         jobs::working_in(folder) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  if (!child->running() && child->exit_code() >= 2) {
    const std::string log = content(log_of(folder));
    throw InputError(Problem{log.substr(log.find('\n') + 1), "", "", "", ""});
  }
  children_[folder] = std::move(child);
  return {{"command", command_of(all)}};
}

/// A whole number as the command takes it; `otherwise` where it is absent.
std::int64_t max_tests_of(const Json& asked, std::int64_t otherwise) {
  if (!asked.contains("max_tests") || asked["max_tests"].is_null()) return otherwise;
  if (!asked["max_tests"].is_number_integer() || asked["max_tests"] < 1)
    throw InputError(Problem{"", "--max-tests", asked["max_tests"].dump(), "a whole number from 1 on", ""});
  return asked["max_tests"].get<std::int64_t>();
}

Json Desk::calibrate(const Json& asked) {
  const std::string name = asked.at("name");
  check_name(name);
  if (!exists(name + ".toml"))
    throw InputError(Problem{"", "rock", name, "a rock that has been saved", "save it first"});
  const std::string now = calibration_of(name);
  if (process_in(now) != 0)
    throw InputError(Problem{"", now, "", "one calibration of a rock at a time", "stop the other first"});
  jobs::CalibrationRequest request;
  const auto earlier = jobs::request_in(now);
  if (earlier && desk::get(asked, "resume", false)) {
    request = *earlier, request.resume = true;
  } else {
    request.max_tests = max_tests_of(asked, request.max_tests);
    request.elastic = desk::get(asked, "elastic", false);
  }
  request.rock = name + ".toml";
  request.out = desk::get(asked, "anew", false) ? next_calibration_of(name) : now;
  check_inside(request.out);
  return start(jobs::words_of(request), request.out);
}

Json Desk::stop(const Json& asked) {
  const std::string name = asked.at("name"), test = desk::get<std::string>(asked, "test", "");
  check_name(name);
  if (!test.empty()) check_name(test);
  const std::string folder = test.empty() ? calibration_of(name) : path_in(tests_of(name), test);
  const auto child = children_.find(folder);
  if (child != children_.end() && child->second->running())
    child->second->interrupt();
  else if (const pid_t process = jobs::working_in(folder); process <= 0 || kill(process, SIGTERM) != 0)
    throw InputError(
        Problem{"", folder, "", "something that runs on this machine, and that you may stop", ""});
  return Json::object();
}

Json Desk::run_test(const Json& asked) {
  const std::string rock = asked.at("name"), name = asked.at("test");
  check_name(rock), check_name(name);
  const std::string recipe = path_in(tests_of(rock), name + ".toml"), folder = path_in(tests_of(rock), name);
  const std::string toml =
      asked.at("toml").is_null() ? io::read_file(recipe) : asked.at("toml").get<std::string>();
  if (process_in(folder) != 0 || (exists(recipe) && content(recipe) != toml))
    throw InputError(Problem{"", "name", name, "a name that is free", "a test of this name is there"});
  // throws: a recipe that cannot run, or lacks what its test keeps, takes no name
  if (const auto missing = missing_stress(io::parse_recipe(toml, recipe))) throw InputError(*missing);
  check_inside(folder);
  if (!exists(recipe)) io::write_file(recipe, toml);
  return start({"run", recipe, "--out", folder}, folder);
}

std::vector<std::string> Desk::running() {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> folders;
  for (const auto& [folder, child] : children_)
    if (child->running()) folders.push_back(folder);
  return folders;
}

}  // namespace phy::desk
