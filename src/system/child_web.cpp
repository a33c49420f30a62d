// In a browser another instance of the program is a worker, which the page's script starts and ends
// (packaging/browser/worker.js). It has files of its own, copies of those here; what it writes comes back.
#include <emscripten.h>
#include <fcntl.h>

#include <cerrno>

#include "system/child.hpp"

// clang-format off
EM_JS(int, phyllite_start, (const char* words, int log), {
  return Module["start"] ? Module["start"](UTF8ToString(words).split("\n"), log) : 0;
});
EM_JS(int, phyllite_ended, (int number), { return Module["ended"](number); });
EM_JS(int, phyllite_end, (int number), { return Module["end"](number) ? 1 : 0; });
// clang-format on

namespace phy::system {

FedProgram::FedProgram() : before_(nullptr) {}
FedProgram::~FedProgram() = default;
int FedProgram::open_pipe() { return 0; }
int FedProgram::start(const std::string&, const std::vector<std::string>&, const std::string&) {
  return ENOENT;  // as where it is not installed
}
bool FedProgram::write(const std::string&) { return false; }
bool FedProgram::finish() { return false; }

int start_again(const std::vector<std::string>& arguments, const std::string& log, int& process) {
  std::string words;
  for (const std::string& word : arguments) words += (words.empty() ? "" : "\n") + word;
  // Stays with the file when that is renamed.
  const int to = ::open(log.c_str(), O_WRONLY | O_APPEND);
  if (to < 0) return errno;
  process = phyllite_start(words.c_str(), to);
  return process > 0 ? 0 : ENOSYS;
}

std::optional<Ended> ended(int child) {
  const int code = phyllite_ended(child);
  if (code < 0) return std::nullopt;
  constexpr int by_page = 256;  // beyond all exit codes
  return Ended{code >= by_page, code % by_page};
}

// It hears nothing while it works. What it has finished is here already.
bool ask_to_end(int process) { return phyllite_end(process) != 0; }
bool kill(int process) { return ask_to_end(process); }
bool is_there(int process) { return !ended(process); }

}  // namespace phy::system
