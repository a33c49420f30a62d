#include "gui/project.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <system_error>

#include "base/check.hpp"
#include "base/hash.hpp"
#include "base/quote.hpp"
#include "gui/way_in.hpp"
#include "io/file.hpp"
#include "io/toml_tree.hpp"
#include "rock/file.hpp"
#include "rock/template.hpp"
#include "system/links.hpp"

namespace phy::gui {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t largest_text = 4 << 20;
// File names have at most 255 bytes on most systems; endings, "-calibration-12" and temporary names follow
// it.
constexpr std::size_t longest_name = 80;

bool is_text(const std::string& bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t n = utf8_length(std::string_view(bytes).substr(i));
    if (n == 0 || bytes[i] == '\0') return false;
    i += n;
  }
  return true;
}

/// Nothing: absent, too large to be edited in a page, or no text.
std::optional<std::string> text_of(const std::string& file) {
  auto text = io::read_if_file(file, largest_text);
  if (text && !is_text(*text)) text.reset();
  return text;
}

std::string stamp_of(const std::string& toml, const std::string& table) {
  Hash hash;
  hash.add(std::string_view(toml)), hash.add(std::string_view(table));
  return hash.text();
}

/// The text behind the key `data`; "": none, or no text.
std::string data_of(const std::string& toml) {
  std::vector<Problem> ignored;
  try {
    const io::TomlValue root = io::parse_toml(toml, "", ignored);
    const io::TomlValue* data = root.find("data");
    return data != nullptr && data->kind == io::TomlValue::Kind::text ? data->text : "";
  } catch (const InputError&) {
    return "";
  }
}

bool is_table_name(const std::string& name) {
  const std::string ending = fs::path(name).extension().string();
  // The table is typed in the page and written under this name: it must stay in the folder and be a text.
  return fs::path(name) == fs::path(name).filename() && !name.starts_with('.') && is_plain(name) &&
         (ending == ".csv" || ending == ".tsv" || ending == ".txt");
}

std::string toml_file(const std::string& name) { return name + ".toml"; }

/// Throws InputError where the page could not show the text again.
void check_size(const std::string& text, const std::string& file) {
  if (text.size() > largest_text)
    throw InputError(
        Problem{file, "", "", "a text of at most 4 MB",
                "the page can edit no more: keep a larger table in a file, and name it with data"});
}

}  // namespace

bool exists(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

void check_name(const std::string& name) {
  const bool good = !name.empty() && name.size() <= longest_name && is_plain(name) &&
                    // Quotes would have to be escaped in the rock file and in the command that the page
                    // shows.
                    // A dash in front would be read as an option.
                    name.find_first_of("/\\\"'") == name.npos && name.front() != '.' && name.front() != '-' &&
                    name.front() != ' ' && name.back() != ' ';
  if (!good)
    throw InputError(
        Problem{"", "name", name, fmt::format("1 to {} characters without / \\ and quotes", longest_name),
                "it becomes the name of a file: no dot, blank or - at its front, no blank at its end, "
                "and letters beyond ASCII count two to four"});
}

std::string table_named_in(const std::string& toml, const std::string& otherwise) {
  const std::string data = data_of(toml);
  return data.empty() ? otherwise : data;
}

std::vector<std::string> rock_names() {
  std::vector<std::string> names;
  for (const std::string& path : io::list_folder(".")) {
    const fs::path file = fs::path(path).filename();
    if (file.extension() != ".toml" || file.string().starts_with('.')) continue;
    const auto text = text_of(file.string());
    // Recipes and studies are TOML, too; only a rock names a table.
    if (text && !data_of(*text).empty()) names.push_back(file.stem().string());
  }
  return names;
}

RockFiles read_rock_files(const std::string& name) {
  check_name(name);
  if (!exists(toml_file(name))) {
    const std::string csv = name + ".csv", toml = rock::rock_template(name, csv);
    // A table is there and no rock file: the page begins with the user's own values.
    if (const auto table = text_of(csv)) return {toml, csv, table, stamp_of("", *table)};
    return {toml, csv, rock::rock_table_template(), ""};
  }
  const auto toml = text_of(toml_file(name));
  if (!toml) throw IoError(toml_file(name) + ": no text of at most 4 MB");
  RockFiles rock{*toml, table_named_in(*toml, name + ".csv"), {}, ""};
  if (is_table_name(rock.table_file)) {
    rock.table = text_of(rock.table_file);
    // Named but not there: an empty grid to be filled in.
    if (!exists(rock.table_file)) rock.table = "";
  }
  rock.stamp = stamp_of(rock.toml, rock.table.value_or(""));
  return rock;
}

std::string save_rock(const std::string& name, const std::string& toml,
                      const std::optional<std::string>& table, const std::string& stamp) {
  // Read again at the moment of saving: the page may be hours old.
  const RockFiles before = read_rock_files(name);
  if (before.stamp != stamp) throw Changed("the files of this rock have been changed since they were shown");
  check_size(toml, toml_file(name));
  const std::string table_file = table_named_in(toml, "");
  if (table_file.empty())
    throw InputError(Problem{toml_file(name), "data", "", "the name of the table",
                             fmt::format("write data = \"{}.csv\"; where {} is a recipe, choose another name",
                                         name, toml_file(name))});
  if (table && !is_table_name(table_file))
    throw InputError(Problem{toml_file(name), "data", table_file,
                             "a CSV file of this folder (.csv, .tsv, .txt)",
                             "the table that is typed here is saved under this name"});
  if (table) check_size(*table, table_file);
  // Of a table that could not be shown the stamp says nothing.
  const bool another = stamp.empty() || table_file != before.table_file || !before.table;
  if (table && another && exists(table_file) && text_of(table_file) != table)
    throw InputError(Problem{toml_file(name), "data", table_file, "a name that is free",
                             "another table lies there, which is not written over"});
  // The table first: a rock file that names a missing one could not be read.
  if (table) io::write_file(table_file, *table);
  io::write_file(toml_file(name), toml);
  return read_rock_files(name).stamp;
}

namespace {

// The first has no number, as most rocks are calibrated once.
std::string numbered(const std::string& rock, int k) {
  return k == 1 ? rock + "-calibration" : fmt::format("{}-calibration-{}", rock, k);
}

/// Numbers of the folders that are there, the largest first.
std::vector<int> calibration_numbers(const std::string& rock) {
  std::vector<int> numbers;
  if (exists(numbered(rock, 1))) numbers.push_back(1);
  const std::string stem = rock + "-calibration-";
  for (const std::string& path : io::list_folder(".")) {
    const std::string name = fs::path(path).filename().string();
    int k = 0;
    if (!name.starts_with(stem)) continue;
    const auto [end, error] = std::from_chars(name.data() + stem.size(), name.data() + name.size(), k);
    // Written back and compared: "-02" or "-3x" is a folder of the user's.
    if (error == std::errc() && k > 1 && name == numbered(rock, k) && fs::is_directory(name))
      numbers.push_back(k);
  }
  std::sort(numbers.rbegin(), numbers.rend());
  return numbers;
}

/// A path from this folder, links followed; nothing: it leads out, or cannot be found.
std::optional<fs::path> below_home(const fs::path& path) {
  // Both are followed to their ends: a link in the folder, and a folder that is itself a link.
  const auto home = system::followed("."), place = system::followed(path);
  if (!home || !place) return {};
  // Compared by parts: "/rocks-old" begins with "/rocks" and is not below it.
  const fs::path below = place->lexically_relative(*home);
  if (below.empty() || *below.begin() == "..") return {};
  return below;
}

}  // namespace

std::vector<std::string> calibrations_of(const std::string& rock) {
  std::vector<std::string> folders;
  for (const int k : calibration_numbers(rock)) folders.push_back(numbered(rock, k));
  return folders;
}
std::string calibration_of(const std::string& rock, const std::string& chosen) {
  const std::vector<std::string> all = calibrations_of(rock);
  if (chosen.empty()) return all.empty() ? numbered(rock, 1) : all.front();
  // Only names that were found on disk: a request cannot name a folder of its own.
  if (std::find(all.begin(), all.end(), chosen) == all.end())
    throw InputError(Problem{"", "calibration", chosen, "a calibration of this rock", ""});
  return chosen;
}
std::string next_calibration_of(const std::string& rock) {
  const std::vector<int> numbers = calibration_numbers(rock);
  return numbered(rock, numbers.empty() ? 1 : numbers.front() + 1);
}

void check_inside(const std::string& path) {
  if (!below_home(path))
    throw InputError(Problem{"", path, "", "a place in this folder", "a link leads out of it"});
}

std::string tests_of(const std::string& rock) { return rock + "-tests"; }

std::vector<std::string> test_names(const std::string& rock) {
  std::vector<std::string> names;
  if (!exists(tests_of(rock))) return names;
  for (const std::string& path : io::list_folder(tests_of(rock)))
    if (fs::path(path).extension() == ".toml") names.push_back(fs::path(path).stem().string());
  return names;
}

std::optional<std::string> served_file(const std::string& path) {
  std::error_code error;
  const fs::path asked(path);
  if (asked.is_absolute()) return {};
  // Before links are followed: ".." and hidden names are refused as they were typed.
  for (const fs::path& part : asked)
    if (part.empty() || part.string().starts_with('.') || part.string().find('\\') != std::string::npos)
      return {};
  const auto file = below_home(asked);
  // A pipe or device would let the answer wait for ever.
  if (!file || !fs::is_regular_file(*file, error)) return {};
  if (file->filename() == way_in_file) return {};  // whoever reads it can do everything
  const auto is_hidden = [](const fs::path& part) { return part.string().starts_with('.'); };
  // Again behind the links: an innocent name may lead to a hidden file.
  if (std::any_of(file->begin(), file->end(), is_hidden)) return {};
  return file->generic_string();
}

std::string content_type(const std::string& path) {
  static const std::map<std::string, std::string> types = {{".html", "text/html; charset=utf-8"},
                                                           {".json", "application/json"},
                                                           {".png", "image/png"},
                                                           {".csv", "text/csv; charset=utf-8"},
                                                           {".toml", "text/plain; charset=utf-8"},
                                                           {".txt", "text/plain; charset=utf-8"},
                                                           {".log", "text/plain; charset=utf-8"},
                                                           {".py", "text/plain; charset=utf-8"},
                                                           {".p2dat", "text/plain; charset=utf-8"}};
  const auto type = types.find(fs::path(path).extension().string());
  // Unknown endings are downloaded, never shown: a browser would guess a type.
  return type == types.end() ? "application/octet-stream" : type->second;
}

}  // namespace phy::gui
