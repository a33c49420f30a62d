// Of a browser, or of node: one instance of the program, on one thread, with a number that its page gives it.
#include <emscripten.h>
#include <unistd.h>

#include <cstdlib>

#include "system/browser.hpp"
#include "system/process.hpp"

// clang-format off
EM_JS(int, phyllite_number, (), { return Module["number"] || 1; });
// A page knows only how long it has been there; node also knows what the process has used.
EM_JS(double, phyllite_seconds, (), {
  if (typeof process === "undefined" || !process.cpuUsage) return performance.now() / 1000;
  const used = process.cpuUsage();
  return (used.user + used.system) / 1e6;
});
// clang-format on

namespace phy::system {

bool has_desktop() { return false; }

bool open_in_browser(const std::string&) { return false; }

int process_number() { return phyllite_number(); }

int thread_number() { return process_number(); }

bool thread_lives(const std::string& number) { return number == std::to_string(thread_number()); }

World this_world() { return {"browser", "", ""}; }

std::string start_of(const std::string& process) { return thread_lives(process) ? "0" : ""; }

std::string host_name() { return "browser"; }

std::vector<std::string> arguments(int argc, char** argv) { return {argv + 1, argv + argc}; }

int n_processors() { return 1; }

double thread_seconds() { return phyllite_seconds(); }

std::tm utc(std::time_t time) {
  std::tm parts{};
  gmtime_r(&time, &parts);
  return parts;
}

bool ports_linger() { return false; }

bool random_bytes(unsigned char* to, std::size_t n) { return ::getentropy(to, n) == 0; }

std::filesystem::path cache_folder() { return {}; }

}  // namespace phy::system
