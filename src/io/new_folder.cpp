#include "io/new_folder.hpp"

#include <cerrno>
#include <filesystem>
#include <utility>

#include "base/check.hpp"
#include "base/option.hpp"
#include "io/disk.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "system/files.hpp"

namespace phy::io {

namespace fs = std::filesystem;

void check_place(const std::string& folder, const std::string& mark, const std::string& kind) {
  std::error_code none;
  // Symbolic links are not followed: a dangling one also occupies the name.
  if (!fs::exists(fs::symlink_status(folder, none))) return;
  if (!fs::is_directory(folder, none)) fail(folder, "be replaced", ENOTDIR);
  if (fs::is_empty(folder, none)) return;
  if (!fs::exists(fs::path(folder) / mark, none))
    throw IoError(folder + ": cannot be replaced: the folder holds no " + kind + " (no " + mark +
                  "); move it, or use another " + option("out"));
  if (!fs::exists(fs::path(folder) / written_list, none)) return;  // made before there were lists
  // Every file in it has to be ours and unchanged: the folder is replaced as a whole.
  for (fs::recursive_directory_iterator entry(folder, none), end; entry != end; entry.increment(none)) {
    const std::string name = entry->path().lexically_relative(folder).generic_string();
    if (name != written_list && (entry->is_symlink(none) || !entry->is_directory(none)) &&
        !is_as_written(folder, name))
      throw IoError(entry->path().string() + ": stands in a " + kind +
                    " that would be replaced, and is not as this program left it; move it away, or use "
                    "another " +
                    option("out"));
  }
}

void remove_folder(const std::string& path) {
  // Renamed first: readers see the whole folder or none, though deleting takes time.
  const std::string old = beside(path, "old");
  if (const int why = system::replace(path, old); why != 0) fail(path, "be removed", why);
  std::error_code error;
  fs::remove_all(old, error);
  if (error) fail(path, "be removed", error);
}

NewFolder::NewFolder(std::string folder, std::string mark, std::string kind)
    : folder_(std::move(folder)), mark_(std::move(mark)), kind_(std::move(kind)) {
  // The part lies beside x/, not in it.
  if (const fs::path place(folder_); !place.has_filename()) folder_ = place.parent_path().string();
  part_ = beside(folder_, "part");
  check_place(folder_, mark_, kind_);
  make_folder(parent_of(folder_));
  remove_leftovers(parent_of(folder_));
  // Left behind by a process of the same number that was killed.
  std::error_code ignored;
  fs::remove_all(part_, ignored);
  make_folder(part_);
  // So that another process, which clears leftovers here, sees that somebody is at it.
  lock_ = system::lock_folder(part_);
}

NewFolder::~NewFolder() {
  if (lock_ >= 0) system::close(lock_);
  std::error_code ignored;
  fs::remove_all(part_, ignored);
}

void NewFolder::add(const std::string& name, const std::string& content) {
  const std::string real = (fs::path(part_) / name).string();
  make_folder(parent_of(real));
  // Errors name the final place, which the user knows.
  write_synced(real, (fs::path(folder_) / name).string(), content);
  folders_.insert(parent_of(real));
  list_ += list_line(name, content);
}

void NewFolder::publish() {
  write_synced((fs::path(part_) / written_list).string(), (fs::path(folder_) / written_list).string(), list_);
  for (const std::string& name : folders_) system::sync_folder(name);
  // Again: something may have been put there while the files were made.
  check_place(folder_, mark_, kind_);
  // An exchange leaves no moment without a result; the older one then has the temporary name and is removed.
  if (const int why = system::exchange(part_, folder_); why != 0) {
    const bool older = why != ENOENT;  // some file systems cannot exchange: step aside, then move in
    const std::string old = beside(folder_, "old");
    int error = older ? system::replace(folder_, old) : 0;
    if (error == 0) error = system::replace(part_, folder_);
    std::error_code ignored;
    if (error != 0) {
      // The older result goes back where the new one cannot take its place.
      if (older && !fs::exists(folder_, ignored)) system::replace(old, folder_);
      fail(folder_, "be replaced", error);
    }
    fs::remove_all(old, ignored);
  }
  system::sync_folder(parent_of(folder_));
}

}  // namespace phy::io
