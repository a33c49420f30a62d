#include "system/process.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>

#include "system/names_windows.hpp"
// These need its types.
#include <bcrypt.h>
#include <shellapi.h>

namespace phy::system {
namespace {

std::uint64_t ticks(const FILETIME& time) {  // of 100 ns
  return std::uint64_t{time.dwHighDateTime} << 32U | time.dwLowDateTime;
}

}  // namespace

int process_number() { return static_cast<int>(GetCurrentProcessId()); }

int thread_number() { return static_cast<int>(GetCurrentThreadId()); }

bool thread_lives(const std::string& number) {
  const auto id = static_cast<DWORD>(std::strtoul(number.c_str(), nullptr, 10));
  const Handle thread(OpenThread(SYNCHRONIZE, FALSE, id));
  return thread && WaitForSingleObject(thread.get(), 0) == WAIT_TIMEOUT;
}

// The start of a process is a time of day here, which no later boot repeats.
World this_world() { return {host_name(), "", ""}; }

std::string start_of(const std::string& process) {
  const auto id = static_cast<DWORD>(std::strtoul(process.c_str(), nullptr, 10));
  const Handle handle(OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION | SYNCHRONIZE, FALSE, id));
  FILETIME start{}, end{}, kernel{}, user{};
  // Of a process that has ended the number stays as long as somebody has it open.
  const bool lives = handle && WaitForSingleObject(handle.get(), 0) == WAIT_TIMEOUT &&
                     GetProcessTimes(handle.get(), &start, &end, &kernel, &user);
  return lives ? std::to_string(ticks(start)) : "";
}

std::string host_name() {
  wchar_t name[MAX_COMPUTERNAME_LENGTH + 1];
  DWORD size = MAX_COMPUTERNAME_LENGTH + 1;
  return GetComputerNameW(name, &size) ? narrow(name) : "unknown";
}

int n_processors() {
  DWORD_PTR own = 0, all = 0;
  if (!GetProcessAffinityMask(GetCurrentProcess(), &own, &all)) return 1;
  return std::max(1, std::popcount(std::uint64_t{own}));
}

double thread_seconds() {
  FILETIME start{}, end{}, kernel{}, user{};
  if (!GetThreadTimes(GetCurrentThread(), &start, &end, &kernel, &user)) return 0.0;
  return 1e-7 * static_cast<double>(ticks(kernel) + ticks(user));
}

std::tm utc(std::time_t time) {
  std::tm parts{};
  gmtime_s(&parts, &time);
  return parts;
}

bool ports_linger() { return false; }

bool random_bytes(unsigned char* to, std::size_t n) {
  return BCryptGenRandom(nullptr, to, static_cast<ULONG>(n), BCRYPT_USE_SYSTEM_PREFERRED_RNG) == 0;
}

std::filesystem::path cache_folder() { return variable(L"LOCALAPPDATA"); }

std::vector<std::string> arguments(int, char**) {
  int n = 0;
  wchar_t** words = CommandLineToArgvW(GetCommandLineW(), &n);
  std::vector<std::string> all;
  for (int i = 1; i < n; ++i) all.push_back(narrow(words[i]));
  LocalFree(words);
  return all;
}

}  // namespace phy::system
