// This very program, started once more for a long piece of work: what the page starts is the command that it
// shows, and goes the same way as from a terminal. Its output goes into a file.
#pragma once
#include <sys/types.h>

#include <string>
#include <vector>

namespace phy::desk {

/// "phyllite calibrate 'my rock.toml'"
std::string command_of(const std::vector<std::string>& words);

class Child {
 public:
  /// `words` follow the program's name; `log` gets the command, and all that it writes. Throws IoError.
  Child(const std::vector<std::string>& words, const std::string& log);
  /// As interrupt(), and waits for its end.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  bool running();
  pid_t process() const { return process_; }
  /// Once it runs no more; of a child that a signal has killed 128 and its number.
  int exit_code() const { return exit_code_; }
  /// As Ctrl-C on a terminal: it keeps what is finished and ends soon. Only the first time: a second signal
  /// would end it at once.
  void interrupt();

 private:
  pid_t process_ = 0;
  bool running_ = true, interrupted_ = false;
  int exit_code_ = 0;
  void ended(int status);
};

}  // namespace phy::desk
