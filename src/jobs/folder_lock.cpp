#include "jobs/folder_lock.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "base/check.hpp"
#include "base/option.hpp"
#include "system/files.hpp"

namespace phy::jobs {
namespace {

std::string lock_file(const std::string& folder) {
  // Never removed: a lock on a removed file would keep nobody out.
  return (std::filesystem::path(folder) / ".lock").string();
}

}  // namespace

FolderLock::FolderLock(const std::string& folder) {
  const system::ProcessLock lock = system::lock_for_process(lock_file(folder));
  if (lock.of_another)
    throw InputError(option_problem("out", folder, "a folder in which no other process works",
                                    "another does: wait for its end, or stop it"));
  descriptor_ = lock.descriptor;
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) system::close(descriptor_);
}

int working_in(const std::string& folder) { return system::locked_by(lock_file(folder)); }

double seconds_since_lock(const std::string& folder) {
  std::error_code none;
  const auto begun = std::filesystem::last_write_time(lock_file(folder), none);
  if (none) return 0.0;
  const std::chrono::duration<double> worked = std::filesystem::file_time_type::clock::now() - begun;
  // Files on a server have its clock, which may run ahead of this machine's.
  return std::max(0.0, worked.count());
}

}  // namespace phy::jobs
