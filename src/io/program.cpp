#include "io/program.hpp"

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/check.hpp"
#include "io/disk.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "system/child.hpp"
#include "system/files.hpp"
#include "system/process.hpp"
#include "system/terminal.hpp"

namespace phy::io {
namespace {

namespace fs = std::filesystem;

/// A file in the folder for temporary files; it goes with this object.
struct Passing {
  std::string path = (fs::temp_directory_path() / "phyllite").string();
  Passing() {
    const auto made = system::passing_file(path);
    if (!made) throw IoError(path + ": cannot be made: " + std::strerror(errno));
    path = *made;
  }
  Passing(const Passing&) = delete;
  Passing& operator=(const Passing&) = delete;
  ~Passing() { system::remove_file(path); }
};

std::string message_in(const std::string& file) {
  std::string text = read_file(file);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
  // The end of a long text: the error comes last.
  return text.size() > 600 ? "..." + text.substr(text.size() - 600) : text;
}

}  // namespace

void run_program(const std::string& program, const std::vector<std::string>& arguments,
                 const std::string& package,
                 const std::function<void(const std::function<void(const std::string&)>& write)>& feed) {
  const Passing said;
  system::FedProgram child;
  const auto check = [&](int error, const std::string& remedy) {
    if (error != 0) throw IoError(program + ": cannot be started: " + std::strerror(error) + remedy);
  };
  check(child.open_pipe(), "");
  const std::string where =
      system::has_posix_shell() ? ": apt install " + package : ", with its folder in PATH";
  check(child.start(program, arguments, said.path), "; install it" + where);
  bool ok = true;
  // After a failed write the rest is not sent; the exit status tells why.
  feed([&](const std::string& text) { ok = ok && child.write(text); });
  ok = child.finish() && ok;
  const std::string message = message_in(said.path);
  if (!ok) throw IoError(program + " did not succeed: " + (message.empty() ? "it said nothing" : message));
}

void make_file(const std::string& path, const std::function<void(const std::string& temporary)>& make) {
  const fs::path place(path);
  if (is_stream(path)) throw IoError(path + ": is no place for a picture; name a file with --out");
  check_outputs({path});
  // Before minutes of drawing.
  check_writable(place.has_parent_path() ? place.parent_path().string() : ".");
  // The ending stays last, as programs choose the format by it.
  const std::string part =
      (place.parent_path() / ("." + place.stem().string() + ".phyllite-part-" +
                              std::to_string(system::thread_number()) + place.extension().string()))
          .string();
  std::error_code ignored;
  try {
    make(part);
    // Listed before it appears (io/output.hpp).
    list_written(path, part);
  } catch (...) {
    fs::remove(part, ignored);
    throw;
  }
  const int error = system::replace(part, path);
  if (error == 0) return;
  fs::remove(part, ignored);
  throw IoError(path + ": cannot be written: " + std::strerror(error) + "; check the folder");
}

}  // namespace phy::io
