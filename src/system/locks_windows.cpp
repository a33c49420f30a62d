#include <fcntl.h>
#include <io.h>

#include <cerrno>
#include <cstdlib>

#include "system/files.hpp"
#include "system/names_windows.hpp"
#include "system/process.hpp"

// Windows knows who has a file open. So a lock that lasts "until it is closed" is the open file itself, and
// is free where the file can be opened for oneself alone.
namespace phy::system {
namespace {

HANDLE open(const std::string& path, DWORD access, DWORD share, DWORD creation) {
  return CreateFileW(wide(path).c_str(), access, share, nullptr, creation,
                     FILE_FLAG_BACKUP_SEMANTICS | FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
}

/// One byte far behind the end: nobody may read what is locked, and the number of the process is to be read.
bool take(HANDLE file) {
  OVERLAPPED place{};
  place.OffsetHigh = 1U << 30U;
  return LockFileEx(file, LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &place);
}

int number_in(HANDLE file) {
  char text[16] = {};
  DWORD n = 0;
  OVERLAPPED start{};
  return ReadFile(file, text, sizeof text - 1, &n, &start) ? std::atoi(text) : 0;
}

void write_number(HANDLE file) {
  const std::string number = std::to_string(process_number()) + "\n";
  SetFilePointer(file, 0, nullptr, FILE_BEGIN);
  SetEndOfFile(file);
  DWORD n = 0;
  WriteFile(file, number.data(), static_cast<DWORD>(number.size()), &n, nullptr);
}

}  // namespace

void lock(int) {}

int lock_folder(const std::string& path) {
  const HANDLE folder = open(path, FILE_LIST_DIRECTORY, share_all, OPEN_EXISTING);
  return folder == INVALID_HANDLE_VALUE ? -1
                                        : ::_open_osfhandle(reinterpret_cast<intptr_t>(folder), _O_NOINHERIT);
}

bool lock_is_free(const std::string& path) {
  return static_cast<bool>(Handle(open(path, GENERIC_READ | DELETE, 0, OPEN_EXISTING)));
}

ProcessLock lock_for_process(const std::string& path) {
  const HANDLE file = open(path, GENERIC_READ | GENERIC_WRITE, share_all, OPEN_ALWAYS);
  if (file == INVALID_HANDLE_VALUE) return {};
  if (take(file)) {
    write_number(file);
    return {::_open_osfhandle(reinterpret_cast<intptr_t>(file), _O_NOINHERIT), false};
  }
  const bool refused = GetLastError() == ERROR_LOCK_VIOLATION;
  const bool own = number_in(file) == process_number();
  CloseHandle(file);
  return {-1, refused && !own};
}

int locked_by(const std::string& path) {
  const Handle file(open(path, GENERIC_READ | GENERIC_WRITE, share_all, OPEN_EXISTING));
  return !file || take(file.get()) ? 0 : number_in(file.get());  // closing gives it back
}

}  // namespace phy::system
