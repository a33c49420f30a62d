// Of a browser, or of node: one instance of the program. Its number and how many threads it may have are
// given by its page.
#include <emscripten.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>

#include "system/browser.hpp"
#include "system/process.hpp"

// clang-format off
EM_JS(int, phyllite_number, (), { return Module["number"] || 1; });
EM_JS(int, phyllite_threads, (), { return Module["threads"] || 1; });
EM_JS(bool, phyllite_begins, (), { return Module["begins"] || false; });
// A page knows only how long it has been there; node also what the process has used, but not by which thread.
EM_JS(double, phyllite_seconds, (), {
  const several = typeof ENVIRONMENT_IS_PTHREAD !== "undefined";
  if (several || typeof process === "undefined" || !process.cpuUsage) return performance.now() / 1000;
  const used = process.cpuUsage();
  return (used.user + used.system) / 1e6;
});
// clang-format on

namespace phy::system {
namespace {

// Asked for when the program starts: its other threads know nothing of what the page has said.
const int number = phyllite_number(), n_threads = phyllite_threads();
const bool begins_threads = phyllite_begins();
// A thread is that of the process and so many times this, which is more than Linux has processes.
constexpr int next_thread = 1 << 22, most_threads = 500;

}  // namespace

bool has_desktop() { return false; }

bool open_in_browser(const std::string&) { return false; }

int process_number() { return number; }

int thread_number() {
  static std::atomic<int> begun{0};
  thread_local const int mine = begun++ % most_threads;  // those of long ago have ended
  return number + mine * next_thread;
}

bool thread_lives(const std::string& thread) { return std::atoll(thread.c_str()) % next_thread == number; }

World this_world() { return {"browser", "", ""}; }

std::string start_of(const std::string& process) { return process == std::to_string(number) ? "0" : ""; }

std::string host_name() { return "browser"; }

std::vector<std::string> arguments(int argc, char** argv) { return {argv + 1, argv + argc}; }

int n_processors() { return n_threads; }

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

// For base/parallel.hpp.
extern "C" bool phyllite_begins_threads() { return phy::system::begins_threads; }
