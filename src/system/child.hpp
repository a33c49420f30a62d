// Processes that this one starts, and how others are ended.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace phy::system {

/// Another program with a pipe for its standard input; standard error goes to a file, standard output
/// nowhere. While it lives, a program that ends early is an error of writing and no signal.
class FedProgram {
 public:
  FedProgram();
  /// Ends the input, which lets the program finish, and waits.
  ~FedProgram();
  FedProgram(const FedProgram&) = delete;
  FedProgram& operator=(const FedProgram&) = delete;
  /// The errno of what failed, or 0.
  int open_pipe();
  /// After open_pipe(); looks for the program along PATH. The errno of what failed, or 0.
  int start(const std::string& program, const std::vector<std::string>& arguments, const std::string& said);
  bool write(const std::string& text);
  /// Ends the input and waits; true: it exited with 0.
  bool finish();

 private:
  // where programs can be started
  [[maybe_unused]] void (*before_)(int);
  [[maybe_unused]] int ends_[2] = {-1, -1};
  [[maybe_unused]] int process_ = 0;
};

/// Starts this very program once more, in a process group of its own: Ctrl-C on the terminal reaches this one
/// alone. It inherits no descriptor; all that it writes is appended to `log`. The errno of what failed, or 0.
int start_again(const std::vector<std::string>& arguments, const std::string& log, int& process);

/// How a child has ended: `code` is its exit code, or the signal that killed it.
struct Ended {
  bool killed;
  int code;
};
/// Nothing as long as it runs.
std::optional<Ended> ended(int child);

/// As by Ctrl-C on a terminal; at once, by force; whether it is there. False: not to be done, or not there.
bool ask_to_end(int process);
bool kill(int process);
bool is_there(int process);

}  // namespace phy::system
