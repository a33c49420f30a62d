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

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "records/recipe_schema.hpp"

namespace phy {
namespace {

/// Control characters anywhere, and non-ASCII characters outside strings and comments.
void scan(std::string_view text, const std::string& where, std::vector<Problem>& problems) {
  int line = 1;
  char quote = 0;
  bool comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const auto u = static_cast<unsigned char>(c);
    if (c == '\n') ++line, comment = false, quote = 0;
    const bool odd = (u < 32 && c != '\n' && c != '\r' && c != '\t') || u == 127;
    if (odd || (u > 127 && quote == 0 && !comment)) {
      problems.push_back({where + ":" + std::to_string(line), "", "", "plain ASCII text",
                          "remove the odd character (byte " + std::to_string(u) + ") from this line"});
      return;
    }
    if (comment) continue;
    if (quote == '"' && c == '\\')
      ++i;
    else if (quote != 0)
      quote = c == quote ? char{0} : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '#')
      comment = true;
  }
}

/// Walks the parsed table along the schema.
class Reader {
 public:
  Reader(const toml::table& root, std::string where) : root_(root), where_(std::move(where)) {}

  Recipe read() {
    find_unknown();
    count_bedding();
    for (const Field& f : recipe_fields()) {
      if (f.table != "bedding")
        read_field(f, table_of(f.table), f.path(), 0);
      else
        for (std::size_t i = 0; i < recipe_.bedding.size(); ++i)
          read_field(f, bedding_[i], "bedding[" + std::to_string(i) + "]." + f.key, i);
    }
    choose_number_or_porosity();
    if (problems.empty())
      for (Problem& p : cross_checks(recipe_, [&](const std::string& path) { return place(path); }))
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

  std::string at(const toml::node& node) const {
    return where_ + ":" + std::to_string(node.source().begin.line);
  }
  std::string place(const std::string& path) const {
    const auto it = places_.find(path);
    return it == places_.end() ? where_ : it->second;
  }
  const toml::table* table_of(const std::string& name) const {
    if (name.empty()) return &root_;
    const toml::node* node = root_.get(name);
    return node != nullptr ? node->as_table() : nullptr;
  }
  static std::string as_written(const toml::node& node) {
    std::ostringstream s;
    if (const auto* v = node.as_string())
      s << '"' << v->get() << '"';
    else if (const auto* n = node.as_integer())
      s << n->get();
    else if (const auto* d = node.as_floating_point())
      s << print_number(d->get());
    else if (const auto* b = node.as_boolean())
      s << (b->get() ? "true" : "false");
    else
      s << (node.is_array() ? "a list" : node.is_table() ? "a table" : "a date");
    return s.str();
  }
  void tell(const toml::node& node, const std::string& path, const std::string& expected,
            const std::string& remedy) {
    problems.push_back({at(node), path, as_written(node), expected, remedy});
  }

  void check_keys(const toml::table& table, const std::string& name, const std::string& path) {
    std::vector<std::string> known;
    for (const Field& f : recipe_fields())
      if (f.table == name) known.push_back(f.key);
    if (name.empty())
      known.insert(known.end(), {"specimen", "packing", "matrix", "bedding", "test", "engine"});
    for (const auto& [key, node] : table) {
      const std::string word(key.str());
      if (std::find(known.begin(), known.end(), word) != known.end()) continue;
      const std::string near = nearest(word, known);
      problems.push_back(
          {where_ + ":" + std::to_string(key.source().begin.line), path + word, "", "a known key",
           near.empty() ? "see phyllite recipe --reference" : "did you mean \"" + near + "\"?"});
    }
  }
  void find_unknown() {
    check_keys(root_, "", "");
    for (const char* name : {"specimen", "packing", "matrix", "test", "engine"}) {
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
    switch (f.kind) {
      case FieldKind::text:
        if (const auto* s = node->as_string())
          f.set_text(recipe_, s->get());
        else
          tell(*node, path, "text in quotes", "");
        return;
      case FieldKind::boolean:
        if (const auto* b = node->as_boolean())
          f.set(recipe_, index, b->get() ? 1.0 : 0.0);
        else
          tell(*node, path, "true or false", "");
        return;
      case FieldKind::choice: return read_choice(f, *node, path, index);
      case FieldKind::quantities: return read_list(f, *node, path);
      default: break;
    }
    double value = 0.0;
    if (read_value(f, *node, path, value)) f.set(recipe_, index, value);
  }
  void read_choice(const Field& f, const toml::node& node, const std::string& path, std::size_t index) {
    const auto* s = node.as_string();
    const std::string word = s != nullptr ? s->get() : "";
    const auto it = std::find(f.choices.begin(), f.choices.end(), word);
    if (it != f.choices.end()) return f.set(recipe_, index, static_cast<double>(it - f.choices.begin()));
    static const std::set<std::string> planned = {"direct_tension", "brazilian", "biaxial", "direct_shear"};
    const std::string near = nearest(word, f.choices);
    tell(node, path, range_text(f),
         planned.contains(word) ? "this test is planned, but not in this version"
         : near.empty()         ? ""
                                : "did you mean \"" + near + "\"?");
  }
  void read_list(const Field& f, const toml::node& node, const std::string& path) {
    const toml::array* list = node.as_array();
    if (list == nullptr)
      return tell(node, path, range_text(f), "write a list, for example [\"0 deg\", \"30 deg\"]");
    for (const toml::node& item : *list) {
      double value = 0.0;
      if (read_value(f, item, path, value)) f.list(recipe_).push_back(value);
    }
  }
  /// One number with its unit and range.
  bool read_value(const Field& f, const toml::node& node, const std::string& path, double& value) {
    if (f.dimension != Dimension::none) {
      const std::string text = node.is_string() ? node.as_string()->get() : as_written(node);
      const Quantity q = node.is_string() || node.is_number() ? parse_quantity(text, f.dimension)
                                                              : Quantity{false, 0.0, "is no quantity"};
      if (!q.ok) return tell(node, path, range_text(f), q.problem), false;
      value = q.value;
    } else if (const auto* n = node.as_integer()) {
      value = static_cast<double>(n->get());
    } else if (const auto* d = node.as_floating_point(); d != nullptr && f.kind == FieldKind::number) {
      value = d->get();
    } else {
      return tell(node, path, range_text(f),
                  f.kind == FieldKind::integer ? "write a whole number" : "write a bare number"),
             false;
    }
    const bool low = f.above_min ? !(value > f.min) : !(value >= f.min);
    const bool high = f.below_max ? !(value < f.max) : !(value <= f.max);
    if (low || high) return tell(node, path, range_text(f), ""), false;
    return true;
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

}  // namespace

Recipe parse_recipe(std::string_view text, const std::string& where) {
  std::vector<Problem> problems;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  scan(text, where, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  const toml::parse_result result = toml::parse(text);
  if (!result)
    throw InputError(Problem{where + ":" + std::to_string(result.error().source().begin.line), "", "", "TOML",
                             std::string(result.error().description())});
  Reader reader(result.table(), where);
  Recipe recipe = reader.read();
  if (!reader.problems.empty()) throw InputError(std::move(reader.problems));
  return recipe;
}

Recipe read_recipe(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  if (!in || text.fail()) throw IoError(path + ": cannot be read; check the name and the permissions");
  return parse_recipe(text.str(), path);
}

std::string write_recipe(const Recipe& recipe) { return write(recipe, false); }
std::string commented_recipe(const Recipe& recipe) { return write(recipe, true); }

}  // namespace phy
