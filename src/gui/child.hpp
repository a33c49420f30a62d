// This very program, started once more for a long piece of work: what the page starts is the command that it
// shows, and goes the same way as from a terminal. Its output goes into a file.
#pragma once
#include <chrono>
#include <string>
#include <vector>

namespace phy::gui {

/// How a process is asked to end: first as by Ctrl-C on a terminal, which keeps what is finished; by force if
/// it is still there a while later.
class Ending {
 public:
  static constexpr std::chrono::seconds patience{15};
  /// To be called again as long as the process is there. False: it may not be ended, or is not there.
  bool ask(int process);
  bool asked(int process) const { return process == process_; }

 private:
  int process_ = 0;
  std::chrono::steady_clock::time_point since_;
};

class Child {
 public:
  /// `words` follow the program's name; `log` gets the command, and all that it writes. Throws IoError.
  Child(const std::vector<std::string>& words, const std::string& log);
  /// Waits for its end, which it asks for.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  bool running();
  int process() const { return process_; }
  /// Once it runs no more; of a child that a signal has killed 128 and its number, or 1 if it was asked to
  /// end.
  int exit_code() const { return exit_code_; }
  Ending ending;

 private:
  int process_ = 0;
  bool running_ = true;
  int exit_code_ = 0;
};

}  // namespace phy::gui
