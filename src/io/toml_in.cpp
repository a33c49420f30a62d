#include "io/toml_in.hpp"

// toml++ 3.3 asserts on some half-written headers and misreads some non-ASCII keys (upstream issue 294): its
// assertions are made harmless here, and the scan below refuses such bytes before the parser sees them.
#undef NDEBUG
#define TOML_ASSERT(x) static_assert(true)
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <toml++/toml.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include "base/quote.hpp"
#include "base/spelling.hpp"
#include "io/csv.hpp"
#include "io/file.hpp"
#include "io/toml_tree.hpp"
#include "records/recipe_schema.hpp"
#include "records/test_description.hpp"

namespace phy::io {
namespace {

constexpr std::size_t max_bytes = 1U << 20U;  // a recipe has some kilobytes
constexpr std::size_t max_line = 4096;        // bounds the depth of nesting, on which the parser recurses
constexpr std::size_t max_told = 50;          // problems; more help nobody

std::string at_line(const std::string& where, std::size_t line) { return where + ":" + std::to_string(line); }

/// Follows strings and comments through a text, one character after the other.
class Lexer {
 public:
  /// Takes the character at `i`; may move `i` on over the rest of an escape or of triple quotes.
  void take(std::string_view text, std::size_t& i) {
    const char c = text[i];
    if (c == '\n') {
      comment_ = false;
      if (!triple_) quote_ = 0;  // a string that is not closed ends with its line
    } else if (comment_) {
      return;
    } else if (quote_ == 0) {
      comment_ = c == '#';
      if (c == '"' || c == '\'') open(text, i);
    } else if (quote_ == '"' && c == '\\' && i + 1 < text.size() && text[i + 1] != '\n') {
      if (static_cast<unsigned char>(text[i + 1]) >= 32) ++i;
    } else if (c == quote_ && !triple_) {
      quote_ = 0;
    } else if (c == quote_ && text.substr(i, 3) == std::string(3, c)) {
      quote_ = 0, i += 2;
    }
  }
  bool in_text() const { return comment_ || quote_ != 0; }

 private:
  char quote_ = 0;
  bool triple_ = false, comment_ = false;

  void open(std::string_view text, std::size_t& i) {
    quote_ = text[i];
    triple_ = text.substr(i, 3) == std::string(3, quote_);
    if (triple_) i += 2;
  }
};

/// Lines in another encoding, one problem a line.
void find_other_encodings(std::string_view text, const std::string& where, std::vector<Problem>& problems) {
  std::size_t line = 1, told = 0;
  for (std::size_t i = 0; i < text.size() && problems.size() < max_told;) {
    const std::size_t n = utf8_length(text.substr(i));
    if (n == 0 && told != line)
      problems.push_back({at_line(where, told = line), "", "", "text in UTF-8", "save the file as UTF-8"});
    line += text[i] == '\n' ? 1 : 0;
    i += std::max<std::size_t>(1, n);
  }
}

/// Control characters anywhere, other than ASCII outside strings and comments, and overlong lines: one
/// problem a line.
void scan(std::string_view text, const std::string& where, std::vector<Problem>& problems) {
  if (text.size() > max_bytes) {
    problems.push_back({where, "", "", "a recipe of at most 1 MB", "this is some other file"});
    return;
  }
  find_other_encodings(text, where, problems);
  if (!problems.empty()) return;
  Lexer lexer;
  std::size_t line = 1, begin = 0, told = 0;
  const auto tell = [&](const std::string& expected, const std::string& remedy) {
    if (told != line) problems.push_back({at_line(where, line), "", "", expected, remedy});
    told = line;
  };
  for (std::size_t i = 0; i < text.size() && problems.size() < max_told; ++i) {
    const auto u = static_cast<unsigned char>(text[i]);
    lexer.take(text, i);
    if (u == '\n') {
      ++line, begin = i + 1;
      continue;
    }
    const bool control = (u < 32 && u != '\r' && u != '\t') || u == 127;
    if (control || (u > 127 && !lexer.in_text()))
      tell("plain ASCII text", "remove the odd character (byte " + std::to_string(u) + ") from this line");
    if (i - begin >= max_line)
      tell("lines of at most " + std::to_string(max_line) + " characters", "break the line");
  }
}

/// A parsed value without toml++.
TomlValue tree_of(const toml::node& node) {
  TomlValue v;
  v.line = node.source().begin.line;
  if (const auto* s = node.as_string())
    v.kind = TomlValue::Kind::text, v.text = s->get();
  else if (const auto* n = node.as_integer())
    v.kind = TomlValue::Kind::integer, v.number = static_cast<double>(n->get()),
    v.text = std::to_string(n->get());
  else if (const auto* d = node.as_floating_point())
    v.kind = TomlValue::Kind::number, v.number = d->get();
  else if (const auto* b = node.as_boolean())
    v.kind = TomlValue::Kind::boolean, v.number = b->get() ? 1.0 : 0.0;
  else if (const auto* list = node.as_array()) {
    v.kind = TomlValue::Kind::list;
    for (const toml::node& item : *list) v.items.push_back(tree_of(item));
  } else if (const auto* table = node.as_table()) {
    v.kind = TomlValue::Kind::table;
    for (const auto& [key, item] : *table) {
      v.keys.push_back({std::string(key.str()), key.source().begin.line});
      v.items.push_back(tree_of(item));
    }
  }
  return v;
}

/// Texts with control characters, written as escapes or over several lines: a name that other programs,
/// terminals and scripts would take for more than a name.
void find_control_characters(const toml::node& node, const std::string& path, const std::string& where,
                             std::vector<Problem>& problems) {
  if (const auto* s = node.as_string(); s != nullptr && !is_plain(s->get()))
    problems.push_back({at_line(where, node.source().begin.line), path, as_written(tree_of(node)),
                        "text without line breaks and other control characters", "write it on one line"});
  if (const auto* list = node.as_array())
    for (const toml::node& item : *list) find_control_characters(item, path, where, problems);
  if (const auto* table = node.as_table())
    for (const auto& [key, item] : *table)
      find_control_characters(item, path + (path.empty() ? "" : ".") + std::string(key.str()), where,
                              problems);
}

/// Walks the parsed table along the schema.
class Reader {
 public:
  Reader(const toml::table& root, std::string where, std::vector<Problem> so_far)
      : problems(std::move(so_far)), root_(root), where_(std::move(where)) {}

  Recipe read() {
    find_unknown();
    count_bedding();
    all_told_apart_ = problems.empty();
    for (const Field& f : recipe_fields()) {
      if (f.table != "bedding")
        read_field(f, table_of(f.table), f.path(), 0);
      else
        for (std::size_t i = 0; i < recipe_.bedding.size(); ++i)
          read_field(f, bedding_[i], "bedding[" + std::to_string(i) + "]." + f.key, i);
    }
    choose_number_or_porosity();
    for (Problem& p : cross_checks(
             recipe_, [&](const std::string& path) { return place(path); },
             [&](const std::string& path) { return is_known(path); }))
      problems.push_back(std::move(p));
    return recipe_;
  }
  std::vector<Problem> problems;

 private:
  const toml::table& root_;
  std::string where_;
  Recipe recipe_;
  std::vector<const toml::table*> bedding_;
  std::map<std::string, std::string> places_;
  std::set<std::string> misread_;
  bool all_told_apart_ = true;  // every line of the file is TOML, and belongs to a key that we know

  std::string at(const toml::node& node) const { return at_line(where_, node.source().begin.line); }
  std::string place(const std::string& path) const {
    const auto it = places_.find(path);
    return it == places_.end() ? where_ : it->second;
  }
  /// Read well; or not given, and none of the lines that were not understood can have been meant to give it.
  bool is_known(const std::string& path) const {
    return places_.contains(path) ? !misread_.contains(path) : all_told_apart_;
  }
  const toml::table* table_of(const std::string& name) const {
    if (name.empty()) return &root_;
    const toml::node* node = root_.get(name);
    return node != nullptr ? node->as_table() : nullptr;
  }
  void tell(const toml::node& node, const std::string& path, const std::string& expected,
            const std::string& remedy) {
    problems.push_back({at(node), path, as_written(tree_of(node)), expected, remedy});
  }

  void check_keys(const toml::table& table, const std::string& name, const std::string& path) {
    for (const auto& [key, node] : table) {
      const std::string word(key.str());
      const bool known = std::any_of(recipe_fields().begin(), recipe_fields().end(), [&](const Field& f) {
        return name.empty() && !f.table.empty() ? f.table == word : f.table == name && f.key == word;
      });
      if (known) continue;
      const bool table_like = node.is_table() || node.is_array_of_tables();
      problems.push_back({at_line(where_, key.source().begin.line), path + word, "",
                          table_like ? "a known table" : "a known key", unknown_key_hint(word, name)});
    }
  }
  void find_unknown() {
    check_keys(root_, "", "");
    for (const char* name : {"specimen", "packing", "matrix", "test", "engine", "sweep"}) {
      const toml::node* node = root_.get(name);
      if (node == nullptr) continue;
      if (const toml::table* t = node->as_table())
        check_keys(*t, name, std::string(name) + ".");
      else
        tell(*node, name, "a table", "write [" + std::string(name) + "] on a line of its own");
    }
  }
  void count_bedding() {
    const toml::node* node = root_.get("bedding");
    if (node == nullptr) return;
    const toml::array* sets = node->as_array();
    if (sets != nullptr && sets->empty()) return;
    if (sets == nullptr || !sets->is_homogeneous(toml::node_type::table) || sets->size() > 16) {
      tell(*node, "bedding", "up to 16 tables", "write [[bedding]] above the keys of each set");
      return;
    }
    for (std::size_t i = 0; i < sets->size(); ++i) {
      bedding_.push_back(sets->get(i)->as_table());
      check_keys(*bedding_.back(), "bedding", "bedding[" + std::to_string(i) + "].");
    }
    recipe_.bedding.resize(bedding_.size());
  }

  void read_field(const Field& f, const toml::table* table, const std::string& path, std::size_t index) {
    const toml::node* node = table != nullptr ? table->get(f.key) : nullptr;
    if (node == nullptr) return;
    places_[path] = at(*node);
    const std::size_t n_before = problems.size();
    take_field(f, *node, path, index);
    if (problems.size() > n_before) misread_.insert(path);
  }
  void take_field(const Field& f, const toml::node& node, const std::string& path, std::size_t index) {
    switch (f.kind) {
      case FieldKind::text:
        if (const auto* s = node.as_string())
          f.set_text(recipe_, s->get());
        else
          tell(node, path, "text in quotes", "");
        return;
      case FieldKind::boolean:
        if (const auto* b = node.as_boolean())
          f.set(recipe_, index, b->get() ? 1.0 : 0.0);
        else
          tell(node, path, "true or false", "");
        return;
      case FieldKind::choice: return read_choice(f, node, path, index);
      case FieldKind::quantities: return read_list(f, node, path);
      default: break;
    }
    double value = 0.0;
    if (read_value(f, node, path, value)) f.set(recipe_, index, value);
  }
  void read_choice(const Field& f, const toml::node& node, const std::string& path, std::size_t index) {
    const auto* s = node.as_string();
    const std::string word = s != nullptr ? s->get() : "";
    const auto it = std::find(f.choices.begin(), f.choices.end(), word);
    if (it != f.choices.end()) return f.set(recipe_, index, static_cast<double>(it - f.choices.begin()));
    const std::string near = nearest(word, f.choices);
    tell(node, path, range_text(f), near.empty() ? "" : "did you mean \"" + near + "\"?");
  }
  void read_list(const Field& f, const toml::node& node, const std::string& path) {
    const toml::array* list = node.as_array();
    if (list == nullptr)
      return tell(node, path, range_text(f),
                  f.dimension == Dimension::none ? "write a list, for example [0.5, 1, 2]"
                                                 : "write a list, for example [\"0 deg\", \"30 deg\"]");
    f.list(recipe_).clear();
    for (const toml::node& item : *list) {
      double value = 0.0;
      if (read_value(f, item, path, value)) f.list(recipe_).push_back(value);
    }
  }
  bool read_value(const Field& f, const toml::node& node, const std::string& path, double& value) {
    std::string remedy;
    if (take_value(f, tree_of(node), value, remedy)) return true;
    return tell(node, path, range_text(f), remedy), false;
  }
  /// The defaults give a number of grains; a file that gives a porosity means it instead.
  void choose_number_or_porosity() {
    const toml::table* packing = table_of("packing");
    if (packing != nullptr && packing->contains("porosity") && !packing->contains("n_grains"))
      recipe_.packing.n_grains = 0;
  }
};

std::string write(const Recipe& recipe, bool comments) {
  std::string text;
  const auto line = [&](const Field& f, std::size_t index) {
    if (!comments && !f.only_of.empty() && f.only_of != recipe.test.kind->name) return;
    if (comments) {
      text += "# " + f.meaning + "; " + range_text(f);
      if (!f.pfc_name.empty()) text += "; PFC: " + f.pfc_name;
      text += "\n";
    }
    text += f.key + " = " + print_field(f, recipe, index) + "\n";
  };
  std::string table;
  for (const Field& f : recipe_fields()) {
    if (f.table == "bedding") continue;
    if (f.table != table) text += "\n[" + f.table + "]\n", table = f.table;
    line(f, 0);
  }
  for (std::size_t i = 0; i < recipe.bedding.size(); ++i) {
    text += "\n[[bedding]]\n";
    for (const Field& f : recipe_fields())
      if (f.table == "bedding") line(f, i);
  }
  return text;
}

std::size_t begin_of_line(std::string_view text, std::size_t line) {
  std::size_t at = 0;
  for (std::size_t i = 1; i < line && at < text.size(); ++i)
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  return at;
}

bool stands_twice(std::string_view problem) { return problem.find("redefin") != problem.npos; }

/// True for a "key = value" line that is wrong in itself, so that the text without it is what was meant. Not
/// for a line that only follows a mistake (an open list), nor for a header: the keys below it would land in
/// another table.
bool can_be_left_out(std::string_view line, std::string_view problem) {
  const std::size_t equals = line.find('=');
  if (equals == line.npos || line.find_first_of("[#") < equals) return false;
  return stands_twice(problem) || !toml::parse(line);
}

/// The likeliest slip in a line "key = value" that is no TOML.
std::string syntax_remedy(std::string_view line, std::string_view problem) {
  if (stands_twice(problem)) return "a key stands once in its table: remove one of the two";
  const std::size_t equals = line.find('=');
  if (equals == line.npos) return "";
  const std::size_t at = line.find_first_not_of(" \t", equals + 1);
  if (at == line.npos) return "write a value behind the =";
  const char c = line[at];
  if (c == '"' || c == '\'')
    return std::count(line.begin(), line.end(), c) % 2 == 1 ? "close the quotes" : "";
  if (c == '-' || c == '+' || c == '.' || (c >= '0' && c <= '9'))
    return "put a quantity in quotes: \"38 mm\"";
  return c == '[' || c == '{' ? "" : "put text in quotes; a switch is true or false";
}

/// Parses, and after a syntax error goes on without that line, so that one slip of the pen does not hide the
/// next.
toml::parse_result parse_all(std::string text, const std::string& where, std::vector<Problem>& problems) {
  for (;;) {
    toml::parse_result result = toml::parse(text);
    if (result) return result;
    const std::string description(result.error().description());
    const std::size_t line = result.error().source().begin.line;
    const std::size_t begin = begin_of_line(text, line), end = std::min(text.find('\n', begin), text.size());
    const std::string_view content = std::string_view(text).substr(begin, end - begin);
    const bool in_list = description.find("array") != std::string::npos;
    const bool left_out = can_be_left_out(content, description);
    problems.push_back({at_line(where, line), "", "", "TOML (" + description + ")",
                        left_out  ? syntax_remedy(content, description)
                        : in_list ? "close the list begun above with ]"
                                  : ""});
    if (problems.size() >= max_told || !left_out) return result;
    text.erase(begin, end - begin);
  }
}

/// What a recipe and the discs that it imports say against each other.
std::vector<Problem> disc_problems(const Recipe& recipe, const std::string& where) {
  const DiscFile file = parse_discs(read_file(recipe.packing.file), recipe.packing.file);
  std::vector<Problem> problems;
  const auto length = [](double v) { return print_quantity(v, Dimension::length); };
  const auto differs = [](double box, double size) {
    return box > 0.0 && std::fabs(box - size) > 1e-6 * box;
  };
  for (const auto& [key, box, size] : {std::tuple{"width", file.width, recipe.specimen.width},
                                       std::tuple{"height", file.height, recipe.specimen.height}})
    if (differs(box, size))
      problems.push_back({where, std::string("specimen.") + key, length(size),
                          "the box of " + recipe.packing.file + ", " + length(box),
                          std::string("write ") + key + " = \"" + length(box) + "\" under [specimen]"});
  double largest = 0.0;
  for (const Disc& d : file.discs) largest = std::max(largest, 2.0 * d.r);
  for (std::size_t i = 0; i < recipe.bedding.size(); ++i)
    if (recipe.bedding[i].spacing < largest)
      problems.push_back({where, "bedding[" + std::to_string(i) + "].spacing",
                          length(recipe.bedding[i].spacing),
                          "at least the largest grain diameter, " + length(largest),
                          "use a wider spacing or smaller grains"});
  return problems;
}

/// The table of a whole text. Throws InputError where nothing can be read; else problems are added.
toml::table parse_checked(std::string_view text, const std::string& where, std::vector<Problem>& problems) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  scan(text, where, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  toml::parse_result result = parse_all(std::string(text), where, problems);
  if (!result) throw InputError(std::move(problems));
  find_control_characters(result.table(), "", where, problems);
  return std::move(result).table();
}

/// The value that a key has by default.
double usual_of(const Field& field) {
  Recipe recipe;
  recipe.bedding.resize(1);
  return field.get ? field.get(recipe, 0) : 0.0;
}

}  // namespace

Recipe parse_recipe(std::string_view text, const std::string& where) {
  std::vector<Problem> problems;
  const toml::table root = parse_checked(text, where, problems);
  Reader reader(root, where, std::move(problems));
  Recipe recipe = reader.read();
  if (!reader.problems.empty()) throw InputError(std::move(reader.problems));
  return recipe;
}

TomlValue parse_toml(std::string_view text, const std::string& where, std::vector<Problem>& problems) {
  return tree_of(parse_checked(text, where, problems));
}

Recipe read_recipe(const std::string& path) {
  Recipe recipe = parse_recipe(read_file(path), path);
  if (recipe.packing.file.empty()) return recipe;
  const auto folder = std::filesystem::absolute(path).parent_path();
  recipe.packing.file = (folder / recipe.packing.file).lexically_normal().string();
  if (!is_plain(recipe.packing.file))  // the name of a folder above it
    throw InputError(Problem{path, "packing.file", recipe.packing.file,
                             "a place whose name is UTF-8 without control characters", "rename the folder"});
  std::vector<Problem> problems = disc_problems(recipe, path);
  if (!problems.empty()) throw InputError(std::move(problems));
  return recipe;
}

const TomlValue* TomlValue::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i].name == key) return &items[i];
  return nullptr;
}

std::string as_written(const TomlValue& v) {
  switch (v.kind) {
    case TomlValue::Kind::text: return toml_string(v.text);
    case TomlValue::Kind::integer: return v.text;
    case TomlValue::Kind::number: return print_number(v.number);
    case TomlValue::Kind::boolean: return v.number != 0.0 ? "true" : "false";
    case TomlValue::Kind::list: return "a list";
    case TomlValue::Kind::table: return "a table";
    case TomlValue::Kind::date: break;
  }
  return "a date";
}

bool within_range(const Field& f, double value) {
  return (f.above_min ? value > f.min : value >= f.min) && (f.below_max ? value < f.max : value <= f.max);
}

bool take_value(const Field& field, const TomlValue& value, double& number, std::string& remedy) {
  const bool text = value.kind == TomlValue::Kind::text, whole = value.kind == TomlValue::Kind::integer;
  const bool numeric = whole || value.kind == TomlValue::Kind::number;
  if (field.dimension != Dimension::none) {
    const Quantity q = text || numeric ? parse_quantity(text ? value.text : as_written(value),
                                                        field.dimension, usual_of(field))
                                       : Quantity{false, 0.0, "is no quantity"};
    if (!q.ok) return remedy = q.problem, false;
    number = q.value;
  } else if (whole || (numeric && field.kind != FieldKind::integer)) {
    number = value.number;
  } else {
    remedy = field.kind == FieldKind::integer ? "write a whole number" : "write a bare number";
    return false;
  }
  return within_range(field, number);
}

std::string write_recipe(const Recipe& recipe) { return write(recipe, false); }
std::string commented_recipe(const Recipe& recipe) { return write(recipe, true); }

}  // namespace phy::io
