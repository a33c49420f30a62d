// Folders as files are (io/file.hpp): whole or not at all, and nothing replaced that somebody else has put
// there.
#pragma once
#include <set>
#include <string>

namespace phy::io {

/// Throws IoError where something else than an older folder of a kind stands in its place, or something in it
/// that the program did not write (io/output.hpp). `mark` is a file that every folder of this kind holds,
/// `kind` its name in messages ("result").
void check_place(const std::string& folder, const std::string& mark, const std::string& kind);

/// Removes a folder, in one step as seen by other processes.
void remove_folder(const std::string& path);

/// A folder in the making. Files go into a temporary folder beside the place; `publish` syncs it and puts it
/// in the place of `folder` in one step, exchanging it for an older one. Without `publish` nothing is left
/// behind.
class NewFolder {
 public:
  /// As check_place().
  NewFolder(std::string folder, std::string mark, std::string kind);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// `name` may lie in a subfolder: "snapshots/grains_0.vtp".
  void add(const std::string& name, const std::string& content);
  void publish();

 private:
  std::string folder_, part_, mark_, kind_;
  int lock_ = -1;                  // on the temporary folder, until it is published
  std::set<std::string> folders_;  // to be synced
  std::string list_;               // of its files, io/output.hpp
};

}  // namespace phy::io
