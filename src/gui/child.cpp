#include "gui/child.hpp"

#include <cstring>
#include <thread>
#include <utility>

#include "base/check.hpp"
#include "base/quote.hpp"
#include "io/file.hpp"
#include "system/child.hpp"

namespace phy::gui {
Child::Child(const std::vector<std::string>& words, const std::string& log) {
  // The command as its first line: after a restart of the server the log alone knows it.
  io::write_file(log, "$ " + command_of(words) + "\n");
  if (const int error = system::start_again(words, log, process_); error != 0)
    throw IoError("phyllite cannot be started once more: " + std::string(std::strerror(error)));
}

bool Child::running() {
  if (!running_) return false;
  const auto end = system::ended(process_);
  if (!end) return true;
  // 128 and the number, as shells count. A process that was asked to end has stopped, not failed.
  exit_code_ = !end->killed ? end->code : ending.asked(process_) ? 1 : 128 + end->code;
  return running_ = false;
}

Child::~Child() {
  // Again and again, since asking for long enough ends by force; a child must not outlive the page unseen.
  for (; running(); std::this_thread::sleep_for(std::chrono::milliseconds(20))) ending.ask(process_);
}

bool Ending::ask(int process) {
  const auto now = std::chrono::steady_clock::now();
  // Another number is another process, whose patience begins anew.
  if (process != std::exchange(process_, process)) {
    since_ = now;
    return system::ask_to_end(process);
  }
  // Another SIGTERM would do for one that is busy, but not for one that has been halted.
  return now - since_ < patience ? system::is_there(process) : system::kill(process);
}

}  // namespace phy::gui
