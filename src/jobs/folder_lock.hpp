// One process at a time works in a folder. The lock ends with its process, however that ends; who looks at a
// folder learns which process it is. On file systems without locks nobody is kept out.
#pragma once
#include <string>
#include <utility>

namespace phy::jobs {

class FolderLock {
 public:
  /// Throws InputError where another process works in `folder`, which is there.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderLock& operator=(FolderLock&&) = delete;
  FolderLock(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// The process that works in a folder; 0: none; below 0: one of another machine.
int working_in(const std::string& folder);

/// How long ago the last process began to work in a folder [s]; 0: none ever has.
double seconds_since_lock(const std::string& folder);

}  // namespace phy::jobs
