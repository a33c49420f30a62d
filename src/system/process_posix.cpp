#include <sched.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "system/process.hpp"

namespace phy::system {
namespace {

std::string first_line(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

}  // namespace

int process_number() { return ::getpid(); }

int thread_number() { return ::gettid(); }

bool thread_lives(const std::string& number) {
  std::error_code none;
  return std::filesystem::exists("/proc/" + number, none);
}

World this_world() {
  std::error_code error;
  return {first_line("/etc/machine-id") + " " + host_name(), first_line("/proc/sys/kernel/random/boot_id"),
          std::filesystem::read_symlink("/proc/self/ns/pid", error).string()};
}

std::string start_of(const std::string& process) {
  const std::string stat = first_line("/proc/" + process + "/stat");
  // The name of the program may hold blanks and brackets: fields are counted from the last bracket.
  const std::size_t name_end = stat.rfind(')');
  if (name_end == stat.npos) return "";
  std::istringstream fields(stat.substr(name_end + 1));
  std::string field;
  for (int i = 3; i <= 22; ++i) fields >> field;  // proc(5): field 22 is starttime
  return field;
}

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

std::vector<std::string> arguments(int argc, char** argv) { return {argv + 1, argv + std::max(argc, 1)}; }

int n_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return std::max(1, CPU_COUNT(&set));
}

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::tm utc(std::time_t time) {
  std::tm parts{};
  gmtime_r(&time, &parts);
  return parts;
}

bool ports_linger() { return true; }

bool random_bytes(unsigned char* to, std::size_t n) { return getrandom(to, n, 0) == static_cast<ssize_t>(n); }

std::filesystem::path cache_folder() {
  // The XDG base directory specification: a relative path is invalid and to be ignored.
  const std::filesystem::path cache = environment("XDG_CACHE_HOME");
  if (cache.is_absolute()) return cache;
  const std::filesystem::path home = environment("HOME");
  return home.empty() ? home : home / ".cache";
}

}  // namespace phy::system
