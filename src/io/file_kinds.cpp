#include "io/file_kinds.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "base/largest_file.hpp"
#include "base/quote.hpp"
#include "io/file.hpp"

namespace phy::io {
namespace {

using Kind = TomlValue::Kind;

struct FileKind {
  const char* schema;                    // Schema::name
  std::vector<std::string_view> words;   // of its top level, that no other kind has there
  std::vector<std::string_view> tables;  // the same of words that another kind has in another form
  const char *called, *use;
};

const std::vector<FileKind>& file_kinds() {
  static const std::vector<FileKind> kinds = {
      {"recipe",
       {"packing", "test", "engine"},
       {"matrix", "bedding"},
       "a recipe",
       "To test it: phyllite run "},
      {"rock",
       {"data", "sheet", "elastic_reading", "E_is", "layers", "confining", "grain_size", "first_packing",
        "bedded", "brazilian", "columns", "report"},
       {},
       "a rock file",
       "To calibrate it: phyllite calibrate "},
      {"study",
       {"vary", "set", "by_angle", "design", "samples", "packings", "bond_seeds", "solver", "regressions"},
       {},
       "a study",
       "To run it: phyllite study "},
      {"file of regressions",
       {"line"},
       {},
       "a list of published lines",
       "Name it in a study, under regressions: "},
      {"request of a calibration",
       {"max_tests"},
       {},
       "what a calibration was asked for",
       "To go on with that: phyllite calibrate ROCK --resume --out FOLDER, the folder of "}};
  return kinds;
}

/// A rock has matrix = "..." and [bedding], a recipe [matrix] and [[bedding]].
bool is_as_in_recipe(const std::string& word, const TomlValue& value) {
  return value.kind == (word == "matrix" ? Kind::table : Kind::list);
}

bool has_words_of(const FileKind& kind, const TomlValue& root) {
  const auto among = [](const auto& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
  };
  for (std::size_t i = 0; i < root.keys.size(); ++i) {
    const std::string& word = root.keys[i].name;
    if (among(kind.words, word) || (among(kind.tables, word) && is_as_in_recipe(word, root.items[i])))
      return true;
  }
  return false;
}

[[noreturn]] void refuse(const std::string& path, const std::string& called, const std::string& wanted,
                         const std::string& use) {
  const auto own = std::find_if(file_kinds().begin(), file_kinds().end(),
                                [&](const FileKind& kind) { return wanted == kind.schema; });
  throw InputError(Problem{"", "", "", "", path + " is " + called + ", not " + own->called + ". " + use});
}

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

void refuse_other_kind(const TomlValue& root, const std::string& where, const std::string& wanted) {
  if (root.keys.empty() || root.keys.front().line == 0) return;  // of no file, which no verb takes
  const FileKind* other = nullptr;
  for (const FileKind& kind : file_kinds()) {
    if (!has_words_of(kind, root)) continue;
    // A file with words of its own kind is taken for it: odd keys in it are reported one by one then.
    if (wanted == kind.schema) return;
    other = &kind;
  }
  if (other != nullptr) refuse(where, other->called, wanted, other->use + shell_word(where));
}

std::string read_user_file(const std::string& path, const std::string& wanted) {
  const std::string ending = ending_of(path);
  const auto refuse_table = [&] {
    refuse(path, "a table", wanted,
           "To make a rock file of it: phyllite rock new NAME --data " + shell_word(path));
  };
  for (const char* of_tables : {".csv", ".tsv", ".ags", ".xlsx", ".xls"})
    if (ending == of_tables) refuse_table();
  std::string text = read_file(path, largest_document);
  // Editors add .txt to any name; a file of keys has an = somewhere.
  if (ending == ".txt" && text.find('=') == text.npos) refuse_table();
  return text;
}

}  // namespace phy::io
