#include "io/document.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/quote.hpp"
#include "io/file_kinds.hpp"

namespace phy::io {
namespace {

using Kind = TomlValue::Kind;

/// True for a table whose keys are data ([set] of a study): its list entry has a quoted key.
bool is_open(const Schema& schema, const std::string& table) {
  return std::any_of(schema.fields.begin(), schema.fields.end(),
                     [&](const Field& f) { return f.table == table && f.key.starts_with('"'); });
}

std::string list_remedy(const Field& f) {
  if (f.kind == FieldKind::integers) return "for example [1, 2, 3]";
  if (f.kind == FieldKind::values) return "write [value, value, ...]";
  return f.dimension == Dimension::none ? "write a list, for example [0.5, 1, 2]"
                                        : "write a list, for example [\"0 deg\", \"30 deg\"]";
}

/// "test.kind", "bedding[1].k_n", "name": how messages and callers name a value.
std::string path_in(const std::string& table, std::size_t i, bool is_one_of_many, const std::string& key) {
  if (table.empty()) return key;
  return table + (is_one_of_many ? "[" + std::to_string(i) + "]." : ".") + key;
}

}  // namespace

std::string Schema::in_brackets(const std::string& table) const {
  if (table.empty()) return "the top of the file";
  return lists.contains(table) ? "[[" + table + "]]" : "[" + table + "]";
}

std::string without_index(std::string path) {
  if (const std::size_t open = path.find('['), close = path.find(']'); open < close && close != path.npos)
    path.erase(open, close - open + 1);
  return path;
}

Document::Document(std::string_view text, const std::string& where, const Schema& schema)
    : where_(where), schema_(schema) {
  root_ = parse_toml(text, where, problems);
  check_tables();
}

Document::Document(TomlValue root, std::string where, const Schema& schema, std::vector<Problem> so_far)
    : problems(std::move(so_far)), root_(std::move(root)), where_(std::move(where)), schema_(schema) {
  check_tables();
}

void Document::report_problem(const TomlValue& value, const std::string& path, const std::string& expected,
                              const std::string& remedy) {
  problems.push_back({at_line(where_, value.line), path, as_written(value), expected, remedy});
}

void Document::check() const {
  if (!problems.empty()) throw InputError(problems);
}

void Document::check_tables() {
  refuse_other_kind(root_, where_, schema_.name);
  check_keys(root_, "", "");
  // Each table of the schema once: several fields share one.
  std::set<std::string> names;
  for (const Field& f : schema_.fields)
    if (!f.table.empty()) names.insert(f.table);
  for (const std::string& name : names) {
    const TomlValue* node = root_.find(name);
    if (node == nullptr) continue;
    // A list of tables with anything else in it, or too long a list, is reported and then not read at all:
    // tables() returns nothing.
    const auto list = schema_.lists.find(name);
    if (list == schema_.lists.end() && node->kind != Kind::table)
      report_problem(*node, name, "a table", "write [" + name + "] on a line of its own");
    else if (list != schema_.lists.end() &&
             (node->kind != Kind::list || node->items.size() > list->second ||
              std::any_of(node->items.begin(), node->items.end(),
                          [](const TomlValue& v) { return v.kind != Kind::table; })))
      report_problem(*node, name, "up to " + std::to_string(list->second) + " tables",
                     "write [[" + name + "]] above the keys of each");
    const std::vector<const TomlValue*> all = tables(name);
    // Keys of open tables are data: they are checked where they are read.
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!is_open(schema_, name))
        check_keys(*all[i], name, path_in(name, i, schema_.lists.contains(name), ""));
  }
  // An unknown line may be a misspelt key: from here on no key that is missing counts as left out on purpose.
  all_lines_known_ = problems.empty();
  read_values();
}

void Document::check_keys(const TomlValue& table, const std::string& name, const std::string& prefix) {
  for (std::size_t i = 0; i < table.keys.size(); ++i) {
    const std::string& word = table.keys[i].name;
    const bool known = std::any_of(schema_.fields.begin(), schema_.fields.end(), [&](const Field& f) {
      // At the top level a word is either a table or a key without table.
      return name.empty() && !f.table.empty() ? f.table == word : f.table == name && f.key == word;
    });
    if (known) continue;
    const TomlValue& v = table.items[i];
    // What looks like a table is called one in the message.
    const bool table_like = v.kind == Kind::table ||
                            (v.kind == Kind::list && !v.items.empty() && v.items.front().kind == Kind::table);
    // The line of the key, not of its value: a list may end far below.
    problems.push_back({at_line(where_, table.keys[i].line), prefix + word, "", "",
                        std::string(table_like ? "unknown table; " : "unknown key; ") +
                            unknown_key_hint(schema_, word, name, v)});
  }
}

void Document::read_values() {
  for (const Field& f : schema_.fields) {
    // Quoted: a placeholder for any key, described but not read here.
    if (f.key.starts_with('"')) continue;
    const std::vector<const TomlValue*> all = tables(f.table);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const TomlValue* v = all[i]->find(f.key))
        read(f, *v, path_in(f.table, i, schema_.lists.contains(f.table), f.key));
  }
}

void Document::read(const Field& f, const TomlValue& v, const std::string& path) {
  // Noted even if it is wrong: is_known() tells a bad value from none.
  Value& value = values_[path];
  value.written = &v;
  std::string remedy;
  switch (f.kind) {
    case FieldKind::value: value.read = true; return;
    case FieldKind::text:
      value.text = v.text, value.read = v.kind == Kind::text;
      if (!value.read) report_problem(v, path, "text in quotes", "");
      return;
    case FieldKind::quantities:
    case FieldKind::integers:
    case FieldKind::values: value.read = take_list(f, v, path, value); return;
    default: break;
  }
  value.read = take_value(f, v, value.number, remedy);
  if (!value.read) report_problem(v, path, range_text(f), remedy);
}

bool Document::take_list(const Field& f, const TomlValue& list, const std::string& path, Value& into) {
  // An empty list is allowed for quantities only (no angles); seeds and levels need one.
  const bool wrong = list.kind != Kind::list || (list.items.empty() && f.kind != FieldKind::quantities);
  if (wrong) return report_problem(list, path, range_text(f), list_remedy(f)), false;
  // Values take the unit of the key that they are for, which is read later.
  if (f.kind == FieldKind::values) return true;
  bool all = true;
  for (const TomlValue& item : list.items) {
    double number = 0.0;
    std::string remedy;
    const bool good = take_value(f, item, number, remedy);
    // Seeds twice would be the same specimen twice, counted as two.
    const bool twice = good && f.kind == FieldKind::integers &&
                       std::find(into.list.begin(), into.list.end(), number) != into.list.end();
    if (!good || twice)
      report_problem(item, path, range_text(f), twice ? "remove the second one" : remedy), all = false;
    if (good) into.list.push_back(number);
  }
  return all;
}

const Document::Value* Document::value_at(const std::string& path) const {
  const auto it = values_.find(path);
  return it == values_.end() ? nullptr : &it->second;
}

const TomlValue* Document::find(const std::string& path) const {
  const Value* v = value_at(path);
  return v != nullptr ? v->written : nullptr;
}

std::vector<const TomlValue*> Document::tables(const std::string& name) const {
  if (name.empty()) return {&root_};
  std::vector<const TomlValue*> all;
  const TomlValue* node = root_.find(name);
  if (node == nullptr) return all;
  const auto list = schema_.lists.find(name);
  if (list == schema_.lists.end()) {
    if (node->kind == Kind::table) all.push_back(node);
    return all;
  }
  if (node->kind != Kind::list || node->items.size() > list->second) return all;
  for (const TomlValue& item : node->items)
    if (item.kind == Kind::table)
      all.push_back(&item);
    else
      return {};
  return all;
}

std::string Document::place(const std::string& path) const {
  const TomlValue* v = find(path);
  return v != nullptr ? at_line(where_, v->line) : where_;
}

bool Document::is_known(const std::string& path) const {
  const Value* v = value_at(path);
  // Not given means default; but with misread lines in the file nothing may be concluded from that.
  return v != nullptr ? v->read : all_lines_known_;
}

double Document::number(const std::string& path, double by_default) const {
  const Value* v = value_at(path);
  return v != nullptr && v->read ? v->number : by_default;
}

std::string Document::text(const std::string& path, const std::string& by_default) const {
  const Value* v = value_at(path);
  return v != nullptr && v->read ? v->text : by_default;
}

std::vector<double> Document::list(const std::string& path) const {
  const Value* v = value_at(path);
  return v != nullptr ? v->list : std::vector<double>{};
}

std::string Document::name() {
  std::string name = text("name", std::filesystem::path(where_).stem().string());
  // A name becomes part of files and pages. A written one has been checked with the text of the file.
  if (find("name") == nullptr && !is_plain(name))
    problems.push_back({where_, "name", name, "a name in UTF-8 without control characters",
                        "the file has none: write name = \"...\""});
  return name;
}

std::string Document::beside(const std::string& file) const {
  return (std::filesystem::path(where_).parent_path() / file).string();
}

}  // namespace phy::io
