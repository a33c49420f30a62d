// The three ways in which this library says that something is wrong (docs/architecture.md, "Errors"):
//
//   InputError    what the user gave cannot be used; carries every problem found, not only the first: exit 2
//   IoError       a file could not be read or written: exit 3
//   PHY_CHECK     we made a mistake, a condition that the program itself should have guaranteed: exit 4
//
// Physics that does not succeed (never peaked, unstable) is no error: it is an Outcome in the result.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace phy {

/// One thing wrong with the user's input, told so that it can be mended without reading the manual.
struct Problem {
  std::string where;     ///< "recipe.toml:12" or "command line"
  std::string key;       ///< "bedding[0].theta"
  std::string value;     ///< the value as the user wrote it
  std::string expected;  ///< unit and admissible range
  std::string remedy;    ///< what to do
};

/// Renders one problem as one line, leaving empty parts out.
std::string to_line(const Problem& p);

/// All problems of one input, collected before anything was run or written. They stand in the order of their
/// lines, file by file; what concerns a whole file comes before its lines.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  explicit InputError(Problem problem);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// A file that cannot be read or written; the message names the file, the reason and the remedy.
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A broken promise of the program itself.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace phy

/// Always on; for cold code. `message` says what was promised.
#define PHY_CHECK(condition, message)                                                     \
  do {                                                                                    \
    if (!(condition))                                                                     \
      throw ::phy::InternalError(std::string(__FILE__) + ":" + std::to_string(__LINE__) + \
                                 ": " #condition ": " + (message));                       \
  } while (false)
