#include "gui/recipes.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

#include "io/document.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"
#include "records/test_description.hpp"

namespace phy::gui {
namespace {

constexpr const char* test_table = "test";

const char* kind_in_words(FieldKind kind) {
  switch (kind) {
    case FieldKind::quantity: return "quantity";
    case FieldKind::number: return "number";
    case FieldKind::integer: return "integer";
    case FieldKind::boolean: return "boolean";
    case FieldKind::choice: return "choice";
    case FieldKind::quantities:
    case FieldKind::integers:
    case FieldKind::values: return "list";
    default: return "text";
  }
}

/// What would stand behind a key. A word of a choice needs no quotes here, nor a quantity.
io::TomlValue value_of(const std::string& text) {
  std::vector<Problem> problems;
  try {
    // By the reader of recipes, so that "10 MPa", 10 and [0, 45] mean here what they mean in a file.
    io::TomlValue root = io::parse_toml("x = " + text, "", problems);
    // A line break in the text would bring a second key with it.
    if (problems.empty() && root.items.size() == 1) return std::move(root.items.front());
  } catch (const InputError&) {  // a word without quotes
  }
  io::TomlValue word;
  word.kind = io::TomlValue::Kind::text;
  word.text = text;
  return word;
}

/// False: `remedy` says why not, or nothing where the range says it.
bool take(const Field& field, const io::TomlValue& value, Recipe& recipe, std::string& remedy) {
  double number = 0.0;
  if (!field.list) {
    if (!io::take_value(field, value, number, remedy)) return false;
    field.set(recipe, 0, number);
    return true;
  }
  if (value.kind != io::TomlValue::Kind::list) return remedy = "write a list: [\"0 deg\", \"45 deg\"]", false;
  std::vector<double> numbers;
  for (const io::TomlValue& item : value.items) {
    if (!io::take_value(field, item, number, remedy)) return false;
    numbers.push_back(number);
  }
  field.list(recipe) = numbers;
  return true;
}

/// Path of the key of the stress that a test keeps.
std::string kept_key(const TestDescription& test) {
  return std::string(test_table) + "." + test.kept_stress.key;
}

}  // namespace

std::optional<Problem> missing_stress(const Recipe& recipe) {
  const TestDescription& test = *recipe.test.kind;
  if (test.kept_stress.value == nullptr || recipe.test.*test.kept_stress.value > 0.0) return {};
  return Problem{"", kept_key(test), "", "a stress above 0, such as 10 MPa", ""};
}

Json field_json(const Field& f) {
  Json key = {
      {"path", f.path()}, {"meaning", f.meaning}, {"range", range_text(f)}, {"kind", kind_in_words(f.kind)}};
  if (!f.read_by.empty()) key["tests"] = f.read_by;
  if (!f.choices.empty()) key["choices"] = f.choices;
  if (const std::string unit = inner_unit(f.dimension); unit != "1") key["unit"] = unit;
  return key;
}

Json keys_json() {
  Json keys = Json::array();
  for (const Field& f : recipe_fields())
    // The rest of the recipe is calibrated: who changes it tests another rock.
    if (f.table == test_table) keys.push_back(field_json(f));
  return keys;
}

Json kinds_json() {
  Json kinds = Json::array();
  for (const TestDescription* test : laboratory_tests()) {
    std::string title = test->name;
    std::replace(title.begin(), title.end(), '_', ' ');
    Json kind = {{"name", test->name}, {"title", title}};
    if (test->kept_stress.value != nullptr) kind["kept_stress"] = kept_key(*test);
    kinds.push_back(std::move(kind));
  }
  return kinds;
}

Json recipe_answer(const std::string& base, const std::map<std::string, std::string>& changes) {
  Recipe recipe = io::read_recipe(base);
  Json problems = Json::array();
  const auto problem = [&](const std::string& key, const std::string& text) {
    problems.push_back({{"key", key}, {"text", text}});
  };
  for (const auto& [path, text] : changes) {
    const Field* field = find_field(recipe_fields(), path);
    // The page offers no others; a request might.
    if (field == nullptr || field->table != test_table) {
      problem(path, "no key of a test; " + io::recipe_key_hint(path));
      continue;
    }
    std::string remedy;
    if (!take(*field, value_of(text), recipe, remedy))
      problem(path, "expected " + range_text(*field) + (remedy.empty() ? "" : "; " + remedy));
  }
  // The page shows a problem beside its control, so that its key need not stand in the text.
  const auto problem_of = [&](Problem p) {
    const std::string key = std::exchange(p.key, "");
    problem(key, to_line(p));
  };
  // Checks across keys assume that each key holds a value of its own range.
  if (problems.empty())
    for (const Problem& p : cross_checks(recipe, [](const std::string&) { return std::string(); }))
      problem_of(p);
  Json toml = problems.empty() ? Json(io::write_recipe(recipe)) : Json(nullptr);
  const auto missing = missing_stress(recipe);
  if (missing &&
      std::none_of(problems.begin(), problems.end(), [&](const Json& p) { return p["key"] == missing->key; }))
    problem_of(*missing);
  return {{"toml", std::move(toml)}, {"problems", std::move(problems)}};
}

}  // namespace phy::gui
