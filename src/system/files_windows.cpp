#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cerrno>
#include <vector>

#include "system/files.hpp"
#include "system/names_windows.hpp"
#include "system/process.hpp"

namespace phy::system {
namespace {

constexpr DWORD retry_every = 20, retry_for = 1000;  // [ms]

HANDLE handle_of(int descriptor) { return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor)); }

HANDLE open(const std::string& path, DWORD access, DWORD creation, DWORD flags = 0) {
  // With this flag folders can be opened too.
  return CreateFileW(wide(path).c_str(), access, share_all, nullptr, creation,
                     flags | FILE_FLAG_BACKUP_SEMANTICS, nullptr);
}

int descriptor_of(HANDLE handle, int flags) {
  if (handle == INVALID_HANDLE_VALUE) return errno = last_error(), -1;
  return ::_open_osfhandle(reinterpret_cast<intptr_t>(handle), flags | _O_BINARY | _O_NOINHERIT);
}

std::optional<About> about_handle(HANDLE handle) {
  const DWORD type = GetFileType(handle);
  if (type == FILE_TYPE_PIPE) return About{Kind::pipe, 0, {}};
  if (type == FILE_TYPE_CHAR) return About{Kind::device, 0, {}};
  BY_HANDLE_FILE_INFORMATION about{};
  if (!GetFileInformationByHandle(handle, &about)) return errno = last_error(), std::nullopt;
  const auto joined = [](DWORD high, DWORD low) { return std::uint64_t{high} << 32U | low; };
  const bool folder = (about.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  return About{folder ? Kind::folder : Kind::file,
               joined(about.nFileSizeHigh, about.nFileSizeLow),
               {about.dwVolumeSerialNumber, joined(about.nFileIndexHigh, about.nFileIndexLow),
                joined(about.ftLastWriteTime.dwHighDateTime, about.ftLastWriteTime.dwLowDateTime), 0}};
}

std::string random_ending() {
  unsigned char random[12] = {};
  random_bytes(random, sizeof random);
  std::string ending = "-";
  for (const unsigned char r : random) ending += static_cast<char>('a' + r % 26);
  return ending;
}

bool is_link(HANDLE handle) {
  BY_HANDLE_FILE_INFORMATION about{};
  return GetFileInformationByHandle(handle, &about) &&
         (about.dwFileAttributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0;
}

}  // namespace

std::optional<About> about(const std::string& path) {
  const Handle handle(open(path, FILE_READ_ATTRIBUTES, OPEN_EXISTING));
  if (!handle) return errno = last_error(), std::nullopt;
  return about_handle(handle.get());
}

std::optional<About> about(int descriptor) { return about_handle(handle_of(descriptor)); }

int open_to_read(const std::string& path) {
  return descriptor_of(open(path, GENERIC_READ, OPEN_EXISTING), _O_RDONLY);
}

int open_new(const std::string& path) {
  return descriptor_of(open(path, GENERIC_WRITE, CREATE_NEW), _O_WRONLY);
}

int open_to_append(const std::string& path) {
  const HANDLE handle = open(path, FILE_APPEND_DATA | FILE_READ_ATTRIBUTES | SYNCHRONIZE, OPEN_ALWAYS,
                             FILE_FLAG_OPEN_REPARSE_POINT);
  if (handle == INVALID_HANDLE_VALUE || !is_link(handle)) return descriptor_of(handle, _O_WRONLY);
  CloseHandle(handle);
  return errno = ELOOP, -1;
}

int open_stream(const std::string& path) {
  if (path == "/dev/stdout") return ::_dup(1);
  if (path == "/dev/stderr") return ::_dup(2);
  return descriptor_of(open(path, GENERIC_WRITE, OPEN_EXISTING), _O_WRONLY);
}

std::FILE* as_stream(int descriptor) { return ::_fdopen(descriptor, "rb"); }

std::ptrdiff_t read_at(int descriptor, char* to, std::size_t n, std::size_t from) {
  constexpr std::size_t most = 1U << 30U;
  OVERLAPPED place{};
  place.Offset = static_cast<DWORD>(from), place.OffsetHigh = static_cast<DWORD>(from >> 32U);
  DWORD done = 0;
  if (ReadFile(handle_of(descriptor), to, static_cast<DWORD>(std::min(n, most)), &done, &place)) return done;
  if (GetLastError() == ERROR_HANDLE_EOF) return 0;
  return errno = last_error(), -1;
}

int write_all(int descriptor, std::string_view text) {
  constexpr std::size_t most = 1U << 30U;
  while (!text.empty()) {
    const int n = ::_write(descriptor, text.data(), static_cast<unsigned>(std::min(text.size(), most)));
    if (n <= 0) return n < 0 ? errno : ENOSPC;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

int sync(int descriptor) { return ::_commit(descriptor) != 0 && errno != EBADF ? errno : 0; }

int close(int descriptor) { return ::_close(descriptor); }

void sync_folder(const std::string&) {}  // Windows has nothing of the kind

void remove_file(const std::string& path) { DeleteFileW(wide(path).c_str()); }

int replace(const std::string& from, const std::string& to) {
  const std::wstring old_name = wide(from), new_name = wide(to);
  // What reads every new file (indexers, virus scanners) has it open for a moment, and does not share it.
  for (DWORD waited = 0;; waited += retry_every) {
    if (MoveFileExW(old_name.c_str(), new_name.c_str(), MOVEFILE_REPLACE_EXISTING)) return 0;
    const DWORD error = GetLastError();
    const bool passes = error == ERROR_SHARING_VIOLATION || error == ERROR_ACCESS_DENIED;
    SetLastError(error);
    if (!passes || waited >= retry_for) return last_error();
    Sleep(retry_every);
  }
}

int exchange(const std::string&, const std::string& other) { return about(other) ? ENOSYS : ENOENT; }

bool is_full(int error) { return error == ENOSPC; }

bool may_write(const std::string& file) {
  return static_cast<bool>(Handle(open(file, GENERIC_WRITE, OPEN_EXISTING)));
}

bool may_write_in(const std::string& folder) {
  return static_cast<bool>(Handle(open(folder.empty() ? "." : folder, FILE_ADD_FILE, OPEN_EXISTING)));
}

bool on_network(const std::string& folder) {
  constexpr DWORD most = 32768;  // characters of a long path
  std::vector<wchar_t> full(most), root(most);
  const std::wstring name = wide(folder.empty() ? "." : folder);
  return GetFullPathNameW(name.c_str(), most, full.data(), nullptr) != 0 &&
         GetVolumePathNameW(full.data(), root.data(), most) && GetDriveTypeW(root.data()) == DRIVE_REMOTE;
}

std::optional<std::string> passing_file(std::string name) {
  name += random_ending();
  const int fd = open_new(name);
  if (fd < 0) return std::nullopt;
  close(fd);
  return name;
}

std::optional<std::string> passing_folder(std::string name) {
  name += random_ending();
  if (CreateDirectoryW(wide(name).c_str(), nullptr)) return name;
  return errno = last_error(), std::nullopt;
}

}  // namespace phy::system
