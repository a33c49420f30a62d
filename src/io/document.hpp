// A file that the user writes, held against the list of its keys: recipe, rock, study and regressions are
// read in this one way, with the same checks and the same words.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/toml_tree.hpp"
#include "records/field.hpp"

namespace phy::io {

/// What a kind of file may hold.
struct Schema {
  std::string name;                          ///< "recipe"
  std::string verb;                          ///< `phyllite VERB --reference` lists its keys; empty: none does
  const Fields& fields;                      ///< the one list
  std::map<std::string, std::size_t> lists;  ///< tables that are lists of tables, and at most how many
  std::string of_recipe;                     ///< what to do with a key of the recipe that stands here

  /// "[test]", "[[bedding]]", "the top of the file"
  std::string in_brackets(const std::string& table) const;
};

/// What to do about an unknown key of a table ("" = top level): where it belongs, PFC's name for what (with
/// the line that `value` comes to), or the nearest.
std::string unknown_key_hint(const Schema& schema, const std::string& word, const std::string& table,
                             const TomlValue& value = {});

/// One value of a key, with its unit and within its range. False: `remedy` says what to do (may be empty
/// where range_text says it all).
bool take_value(const Field& field, const TomlValue& value, double& number, std::string& remedy);

/// "bedding[0].k_n" as it stands in the list of keys: "bedding.k_n".
std::string without_index(std::string path);

class Document {
 public:
  /// Reads all values; what is wrong goes to `problems`. Throws InputError where nothing can be read.
  Document(std::string_view text, const std::string& where, const Schema& schema);
  /// Of a tree that has been parsed, with the problems so far.
  Document(TomlValue root, std::string where, const Schema& schema, std::vector<Problem> so_far);
  Document(const Document&) = delete;  // it points into itself
  Document& operator=(const Document&) = delete;

  std::vector<Problem> problems;
  std::vector<std::string> notes;  ///< what its reader wants the user to know
  void report_problem(const TomlValue& value, const std::string& path, const std::string& expected,
                      const std::string& remedy);
  /// Throws InputError with all problems, if there are any.
  void check() const;

  /// The value as it stands in the file; nullptr: not given. Of a list of tables: "bedding[0].k_n".
  const TomlValue* find(const std::string& path) const;
  /// The tables of that name: none, one, or all of a list. The top level is "".
  std::vector<const TomlValue*> tables(const std::string& name) const;
  /// File and line of a key; the file where it is not given.
  std::string place(const std::string& path) const;
  /// Read well; or not given, and none of the lines that were not understood can have been meant to give it.
  bool is_known(const std::string& path) const;

  /// Values that were read well; of the others `by_default`. A choice is its place in the list.
  double number(const std::string& path, double by_default) const;
  std::string text(const std::string& path, const std::string& by_default) const;
  std::vector<double> list(const std::string& path) const;
  /// What the file says it is called; without a word the name of the file, which has to be plain text then.
  std::string name();
  /// A file named in this one: counted from its folder.
  std::string beside(const std::string& file) const;
  /// What `read` makes of the file that this one names under `key`; nothing, with its problems among those of
  /// this one, where it cannot be read.
  template <class Read>
  auto read_named(const std::string& key, const Read& read) {
    std::optional<decltype(read(std::string()))> made;
    try {
      made = read(beside(text(key, "")));
    } catch (const InputError& e) {
      problems.insert(problems.end(), e.problems().begin(), e.problems().end());
    } catch (const IoError& e) {
      report_problem(*find(key), key, "a file that can be read", e.what());
    }
    return made;
  }

 private:
  struct Value {
    const TomlValue* written = nullptr;
    bool read = false;
    double number = 0.0;
    std::string text;
    std::vector<double> list;
  };
  TomlValue root_;
  std::string where_;
  const Schema& schema_;
  std::map<std::string, Value> values_;
  bool all_lines_known_ = true;  // every line of the file is TOML, and belongs to a key that we know

  void check_tables();
  void check_keys(const TomlValue& table, const std::string& name, const std::string& prefix);
  void read_values();
  void read(const Field& field, const TomlValue& value, const std::string& path);
  bool take_list(const Field& field, const TomlValue& list, const std::string& path, Value& into);
  const Value* value_at(const std::string& path) const;
};

}  // namespace phy::io
