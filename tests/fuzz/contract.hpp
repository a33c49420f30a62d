// What the readers share: the contract, and files in a folder of their own.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/check.hpp"
#include "readers.hpp"

namespace phy::fuzz {

/// Runs a reader; false where it refuses the input in one of the two ways that are allowed.
template <class Read>
bool accepts(const Read& read) {
  try {
    read();
    return true;
  } catch (const InputError& e) {
    if (e.problems().empty()) throw Finding("refused without a problem");
  } catch (const IoError& e) {
    if (*e.what() == '\0') throw Finding("refused without a word");
  }
  return false;
}

/// What was read is written, read and written again.
inline void same(const std::string& first, const std::string& again) {
  if (first != again) throw Finding("read again it is another: \n" + first + "\nand\n" + again);
}

/// The files of one input, in a folder that goes with this object. Text before the first "=== name" belongs
/// to the first of `names`; what follows another name is left out.
class Files {
 public:
  Files(std::string_view input, const std::vector<std::string>& names);
  ~Files();
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::string folder() const { return folder_.string(); }
  std::string read(const std::string& name) const;
  /// Another file beside them, or one of them anew.
  void write(const std::string& name, std::string_view content) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace phy::fuzz
