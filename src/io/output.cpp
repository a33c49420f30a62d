#include "io/output.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/check.hpp"
#include "base/hash.hpp"
#include "base/option.hpp"
#include "base/quote.hpp"
#include "io/disk.hpp"
#include "io/file.hpp"
#include "system/files.hpp"

namespace phy::io {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  return folder.empty() ? "." : folder.string();
}

bool is_free(const std::string& file) {
  std::error_code none;
  return is_stream(file) || !fs::exists(fs::symlink_status(file, none));
}

std::optional<Problem> problem_with(const std::string& file, const std::string& word) {
  if (is_free(file)) return std::nullopt;
  // Without an option the name itself is the place of the problem.
  const auto problem = [&](const char* expected) {
    if (word.empty()) return Problem{"", file, "", expected, "move it away"};
    return option_problem(word, file, expected, "move it away, or use another " + option(word));
  };
  // An input is never overwritten, even if this program wrote it.
  if (was_read(file)) return problem("another file than those that are read");
  if (is_as_written(folder_of(file), fs::path(file).filename().string())) return std::nullopt;
  return problem("a name that is free, or a file as this program left it");
}

void add_to_list(const std::string& file, std::string_view content) {
  const std::string list = (fs::path(folder_of(file)) / written_list).string(),
                    line = list_line(fs::path(file).filename().string(), content);
  // With the line breaks around it, so that no part of a longer line matches.
  if (const auto known = read_if_file(list); known && ("\n" + *known).find("\n" + line) != known->npos)
    return;
  // Appended in one write, so that several processes can share a list. A link is not followed: the list could
  // be made to point elsewhere. Nor is a pipe waited for.
  const int fd = system::open_to_append(list);
  if (fd < 0) return;
  system::write_all(fd, line);
  system::close(fd);
}

}  // namespace

std::string list_line(const std::string& name, std::string_view content) {
  Hash hash;
  hash.bytes(content.data(), content.size());
  return hash.text() + " " + comment_text(name) + "\n";
}

bool is_as_written(const std::string& folder, const std::string& name) {
  const auto list = read_if_file((fs::path(folder) / written_list).string()),
             content = read_if_file((fs::path(folder) / name).string());
  // The fingerprint is part of the line: a file changed by hand is not found.
  return list && content && ("\n" + *list).find("\n" + list_line(name, *content)) != list->npos;
}

std::string read_written(const std::string& file) {
  std::string content = read_file(file);
  const auto list = read_if_file((fs::path(folder_of(file)) / written_list).string());
  const std::string name = fs::path(file).filename().string();
  const bool listed = list && list->find(" " + comment_text(name) + "\n") != list->npos;
  if (listed && ("\n" + *list).find("\n" + list_line(name, content)) == list->npos)
    throw IoError(file +
                  ": is not as this program wrote it: cut short, damaged or changed by hand; bring it back "
                  "from a copy, or make the result anew");
  return content;
}

void list_written(const std::string& file, const std::string& part) {
  if (const auto content = read_if_file(part)) add_to_list(file, *content);
}

bool holds(const std::string& file, const std::string& content) { return read_if_file(file) == content; }

void check_outputs(const std::vector<std::string>& files, const std::string& word) {
  std::vector<Problem> problems;
  for (const std::string& file : files)
    if (auto problem = problem_with(file, word)) problems.push_back(std::move(*problem));
  if (!problems.empty()) throw InputError(std::move(problems));
}

void check_ending(const std::string& file, const std::vector<std::string>& endings) {
  const std::string ending = fs::path(file).extension().string();
  if (ending.empty() || std::find(endings.begin(), endings.end(), ending) != endings.end()) return;
  std::string all;
  for (const std::string& one : endings) all += (all.empty() ? "" : ", ") + one;
  throw InputError(option_problem("out", file, "a name that ends in " + all, "nothing was written"));
}

void write_output(const std::string& file, const std::string& content) {
  if (is_stream(file)) return write_stream(file, content);
  // Left alone, with its time: make and the like see no change.
  if (holds(file, content)) return;
  if (!is_free(file) && !is_as_written(folder_of(file), fs::path(file).filename().string()))
    throw IoError(file + ": is not as this program left it, and was not replaced; move it away");
  make_folder(folder_of(file));
  // First the list: killed in between, the file is at worst listed and missing, never present and foreign.
  add_to_list(file, content);
  write_file(file, content);
}

}  // namespace phy::io
