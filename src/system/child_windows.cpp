#include <fcntl.h>
#include <io.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "system/child.hpp"
#include "system/files.hpp"
#include "system/names_windows.hpp"

namespace phy::system {
namespace {

constexpr DWORD first_status = 0xC0000000;  // of Windows' own codes for what went wrong

/// Processes of ours that have not been asked how they ended: with the last handle of one its exit code goes.
std::mutex mutex;
std::map<int, std::shared_ptr<Handle>> started;

/// One word of a command line, as CommandLineToArgvW and the C library of the other program take it apart.
std::wstring quoted(const std::string& word) {
  std::wstring out = L"\"";
  std::size_t slashes = 0;  // before a quote they count double
  for (const wchar_t c : wide(word)) {
    if (c == L'"') out.append(slashes + 1, L'\\');
    slashes = c == L'\\' ? slashes + 1 : 0;
    out += c;
  }
  return out.append(slashes, L'\\') + L"\"";
}

std::wstring line_of(const std::string& name, const std::vector<std::string>& arguments) {
  std::wstring line = quoted(name);
  for (const std::string& a : arguments) line += L" " + quoted(a);
  return line;
}

/// A file that a child inherits.
HANDLE inherited(const std::wstring& name, DWORD access, DWORD creation) {
  SECURITY_ATTRIBUTES to_child{sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
  return CreateFileW(name.c_str(), access, share_all, &to_child, creation, 0, nullptr);
}

/// Standard input, output and error of a new process: the only handles that it inherits.
class Streams {
 public:
  Streams(HANDLE in, HANDLE out, HANDLE error) : all_{in, out, error} {
    SIZE_T size = 0;
    InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
    memory_.resize(size);
    start_.StartupInfo.cb = sizeof start_;
    start_.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    start_.StartupInfo.hStdInput = in, start_.StartupInfo.hStdOutput = out,
    start_.StartupInfo.hStdError = error;
    start_.lpAttributeList = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(memory_.data());
    InitializeProcThreadAttributeList(start_.lpAttributeList, 1, 0, &size);
    const std::size_t n = out == error ? 2 : 3;  // none twice
    UpdateProcThreadAttribute(start_.lpAttributeList, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, all_.data(),
                              n * sizeof(HANDLE), nullptr, nullptr);
  }
  ~Streams() { DeleteProcThreadAttributeList(start_.lpAttributeList); }
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;
  STARTUPINFOW* get() { return &start_.StartupInfo; }

 private:
  std::array<HANDLE, 3> all_;
  std::vector<char> memory_;
  STARTUPINFOEXW start_{};
};

/// The errno of what failed, or 0.
int launch(const std::wstring& image, std::wstring line, Streams& streams, DWORD flags, int& process) {
  PROCESS_INFORMATION made{};
  if (!CreateProcessW(image.c_str(), line.data(), nullptr, nullptr, TRUE,
                      flags | EXTENDED_STARTUPINFO_PRESENT, nullptr, nullptr, streams.get(), &made))
    return last_error();
  CloseHandle(made.hThread);
  process = static_cast<int>(made.dwProcessId);
  const std::lock_guard lock(mutex);
  started[process] = std::make_shared<Handle>(made.hProcess);
  return 0;
}

std::shared_ptr<Handle> handle_of(int process) {
  const std::lock_guard lock(mutex);
  const auto at = started.find(process);
  return at == started.end() ? nullptr : at->second;
}

/// Its exit code, after it has ended.
DWORD take_code(int process) {
  DWORD code = 1;
  if (const auto handle = handle_of(process)) GetExitCodeProcess(handle->get(), &code);
  const std::lock_guard lock(mutex);
  started.erase(process);
  return code;
}

/// Along PATH alone: Windows itself would look into the present folder first.
std::wstring found(const std::string& program) {
  wchar_t name[32768];
  const DWORD n =
      SearchPathW(variable(L"PATH").c_str(), wide(program).c_str(), L".exe", std::size(name), name, nullptr);
  return n > 0 && n < std::size(name) ? name : L"";
}

void close_once(int& descriptor) {
  if (const int open = std::exchange(descriptor, -1); open >= 0) ::_close(open);
}

}  // namespace

FedProgram::FedProgram() : before_(nullptr) {}

FedProgram::~FedProgram() {
  finish();
  close_once(ends_[0]);
}

int FedProgram::open_pipe() { return ::_pipe(ends_, 1 << 16, _O_BINARY | _O_NOINHERIT) != 0 ? errno : 0; }

int FedProgram::start(const std::string& program, const std::vector<std::string>& arguments,
                      const std::string& said) {
  const std::wstring image = found(program);
  if (image.empty()) return ENOENT;
  const auto in = reinterpret_cast<HANDLE>(::_get_osfhandle(ends_[0]));
  SetHandleInformation(in, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  const Handle nowhere(inherited(L"NUL", GENERIC_WRITE, OPEN_EXISTING)),
      error(inherited(wide(said), GENERIC_WRITE, CREATE_ALWAYS));
  Streams streams(in, nowhere.get(), error.get());
  const int failed = launch(image, line_of(program, arguments), streams, 0, process_);
  // Our copy of the reading end: with it open a child that has ended would not break the pipe.
  close_once(ends_[0]);
  return failed;
}

bool FedProgram::write(const std::string& text) { return write_all(ends_[1], text) == 0; }

bool FedProgram::finish() {
  close_once(ends_[1]);
  const int process = std::exchange(process_, 0);
  const auto handle = handle_of(process);
  if (!handle) return false;
  WaitForSingleObject(handle->get(), INFINITE);
  return take_code(process) == 0;
}

int start_again(const std::vector<std::string>& arguments, const std::string& log, int& process) {
  wchar_t self[32768];
  if (GetModuleFileNameW(nullptr, self, std::size(self)) == 0) return last_error();
  const Handle in(inherited(L"NUL", GENERIC_READ, OPEN_EXISTING)),
      out(inherited(wide(log), FILE_APPEND_DATA | SYNCHRONIZE, OPEN_ALWAYS));
  Streams streams(in.get(), out.get(), out.get());
  return launch(self, line_of("phyllite", arguments), streams, CREATE_NEW_PROCESS_GROUP, process);
}

std::optional<Ended> ended(int child) {
  const auto handle = handle_of(child);
  if (handle && WaitForSingleObject(handle->get(), 0) == WAIT_TIMEOUT) return std::nullopt;
  const DWORD code = take_code(child);
  // What Windows or kill() has ended has a status of Windows, not a number of its own.
  if (code < first_status) return Ended{false, static_cast<int>(code)};
  return Ended{true, code == STATUS_ACCESS_VIOLATION ? SIGSEGV : SIGTERM};
}

bool ask_to_end(int process) {
  const Handle event(OpenEventW(EVENT_MODIFY_STATE, FALSE, event_of(process).c_str()));
  // Who does not listen yet has nothing to lose.
  return event ? SetEvent(event.get()) != FALSE : kill(process);
}

bool kill(int process) {
  const Handle handle(OpenProcess(PROCESS_TERMINATE, FALSE, static_cast<DWORD>(process)));
  return handle && TerminateProcess(handle.get(), static_cast<UINT>(STATUS_CONTROL_C_EXIT));
}

bool is_there(int process) {
  const Handle handle(OpenProcess(SYNCHRONIZE, FALSE, static_cast<DWORD>(process)));
  return handle && WaitForSingleObject(handle.get(), 0) == WAIT_TIMEOUT;
}

}  // namespace phy::system
