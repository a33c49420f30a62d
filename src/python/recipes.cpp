// Recipe and Rock.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "base/quote.hpp"
#include "io/toml_in.hpp"
#include "jobs/check_summary.hpp"
#include "jobs/keys.hpp"
#include "jobs/machine.hpp"
#include "jobs/rock_base.hpp"
#include "python/module.hpp"
#include "records/calibration.hpp"
#include "records/measured_property.hpp"
#include "records/recipe_schema.hpp"
#include "records/specimen_record.hpp"
#include "report/finding_json.hpp"
#include "rock/file.hpp"
#include "rock/schema.hpp"
#include "study/study_in.hpp"

namespace phy::python {
namespace {

using io::TomlValue;
using Kind = TomlValue::Kind;

// Values become the tree that the parser of TOML makes: one reader checks files and keyword arguments alike.
TomlValue value_of(const py::handle& value, const std::string& path, const std::string& where);

TomlValue of_kind(Kind kind, double number, std::string text = "") {
  TomlValue v;
  v.kind = kind, v.number = number, v.text = std::move(text);
  return v;
}

[[noreturn]] void refuse(const py::handle& value, const std::string& path, const std::string& where,
                         const char* expected) {
  // repr shows the type, too: '5' and 5 look alike otherwise.
  throw InputError(Problem{where, path, py::repr(value).cast<std::string>(), expected, ""});
}

TomlValue list_of(const py::handle& values, const std::string& path, const std::string& where) {
  TomlValue list = of_kind(Kind::list, 0.0);
  for (const py::handle item : values) list.items.push_back(value_of(item, path, where));
  return list;
}

/// The value of that name in a table, made where it is not there yet.
TomlValue& item_of(TomlValue& table, const std::string& name) {
  for (std::size_t i = 0; i < table.keys.size(); ++i)
    if (table.keys[i].name == name) return table.items[i];
  table.keys.push_back({name});
  table.items.push_back(of_kind(Kind::table, 0.0));
  return table.items.back();
}

TomlValue table_of(const py::dict& keys, const std::string& path, const std::string& where) {
  TomlValue table = of_kind(Kind::table, 0.0);
  for (const auto& [key, value] : keys) {
    const auto name = py::str(key).cast<std::string>();
    const std::size_t dot = path.empty() ? name.find('.') : name.npos;  // "matrix.E_c" of the whole
    TomlValue& place = dot == name.npos ? item_of(table, name)
                                        : item_of(item_of(table, name.substr(0, dot)), name.substr(dot + 1));
    place = value_of(value, path.empty() ? name : fmt::format("{}.{}", path, name), where);
  }
  return table;
}

TomlValue value_of(const py::handle& value, const std::string& path, const std::string& where) {
  if (py::isinstance<py::str>(value)) {
    auto text = value.cast<std::string>();
    // The recipe is written as TOML again, where a line break in a name would not be read back.
    if (!is_plain(text)) refuse(value, path, where, "text without line breaks and other control characters");
    return of_kind(Kind::text, 0.0, std::move(text));
  }
  // Before integers: True is an integer in Python, too.
  if (py::isinstance<py::bool_>(value)) return of_kind(Kind::boolean, value.cast<bool>() ? 1.0 : 0.0);
  if (py::isinstance<py::dict>(value)) return table_of(py::reinterpret_borrow<py::dict>(value), path, where);
  if (py::hasattr(value, "tolist")) return value_of(value.attr("tolist")(), path, where);  // of NumPy
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) return list_of(value, path, where);
  // Through __index__, which integers of NumPy have as well. The text is for messages: a double may show
  // other digits.
  if (PyIndex_Check(value.ptr()) != 0)
    return of_kind(Kind::integer, py::float_(value.attr("__index__")()), py::str(value).cast<std::string>());
  if (py::isinstance<py::float_>(value)) return of_kind(Kind::number, value.cast<double>());
  // pathlib.Path and its like, for keys that name files.
  if (py::hasattr(value, "__fspath__")) return value_of(value.attr("__fspath__")(), path, where);
  refuse(value, path, where, "text (a quantity with its unit), a number, a switch, a list or a dict");
}

/// `more` over `keys`: tables key by key, lists of tables of one length table by table.
void put_over(TomlValue& keys, const TomlValue& more) {
  const bool tables = keys.kind == Kind::table && more.kind == Kind::table;
  if (tables)
    for (std::size_t i = 0; i < more.keys.size(); ++i)
      put_over(item_of(keys, more.keys[i].name), more.items[i]);
  // With another number of sets nobody could tell which is meant: the list as a whole is new.
  const bool lists = keys.kind == Kind::list && more.kind == Kind::list && !more.items.empty() &&
                     keys.items.size() == more.items.size() && more.items.front().kind == Kind::table;
  if (lists)
    for (std::size_t i = 0; i < more.items.size(); ++i) put_over(keys.items[i], more.items[i]);
  if (!tables && !lists) keys = more;
}

Recipe changed(const Recipe& recipe, const py::kwargs& keys) {
  std::vector<Problem> none;
  // Through text: the completed recipe has every key, and all checks run again on what comes out.
  TomlValue tree = io::parse_toml(io::write_recipe(recipe), "recipe", none);
  put_over(tree, tree_of(keys, "Recipe.changed"));
  return io::recipe_of(std::move(tree), "Recipe.changed");
}

/// "bedding[1].k_n": the index; 0 where there is none.
std::size_t index_in(const std::string& path) {
  std::size_t index = 0;
  if (const std::size_t open = path.find('['); open != path.npos)
    std::from_chars(path.data() + open + 1, path.data() + path.size(), index);
  return index;
}

py::object value_in(const Recipe& recipe, const std::string& path) {
  const Field* f = find_field(recipe_fields(), io::without_index(path));
  const std::size_t index = index_in(path);
  if (f == nullptr)
    throw InputError(Problem{"Recipe", path, "", "a key of the recipe", io::recipe_key_hint(path)});
  if (f->table == "bedding" && index >= recipe.bedding.size())
    throw InputError(Problem{"Recipe", path, "", "a set of bedding of this recipe",
                             "it has " + std::to_string(recipe.bedding.size())});
  if (f->get_text) return py::str(f->get_text(recipe));
  if (f->list) {
    // The access to lists is that of the reader, which writes.
    Recipe copy = recipe;
    return py::cast(f->list(copy));
  }
  const double value = f->get(recipe, index);
  switch (f->kind) {
    case FieldKind::boolean: return py::bool_(value != 0.0);
    case FieldKind::integer: return py::int_(static_cast<std::int64_t>(value));
    case FieldKind::choice: return py::str(f->choices[static_cast<std::size_t>(value)]);
    default: return py::float_(value);
  }
}

std::string text_of(const py::object& path) {
  return py::module_::import("os").attr("fspath")(path).cast<std::string>();
}

/// What stands at the top of a file: keys, and names of tables.
std::vector<std::string> top_keys(const io::Schema& schema) {
  std::vector<std::string> keys;
  for (const Field& f : schema.fields)
    if (const std::string& top = f.table.empty() ? f.key : f.table;
        std::find(keys.begin(), keys.end(), top) == keys.end())
      keys.push_back(top);
  return keys;
}

/// As JSON: Python reads its kinds, cells and numbers.
std::string findings_of(const NamedRock& r) {
  const jobs::RockCheck found = jobs::check(r.rock);
  report::Json all = report::findings_json(found.doubts);
  // In the order of `rock check`: doubts first.
  for (const auto* more : {&found.statements, &found.limits})
    for (const report::Json& finding : report::findings_json(*more)) all.push_back(finding);
  return all.dump();
}

py::list rows_of_targets(const NamedRock& rock) {
  py::list rows;
  for (const Target& t : targets_of(rock.rock)) {
    py::dict row;
    row["property"] = to_string(t.property), row["theta"] = t.theta, row["mean"] = t.mean, row["sd"] = t.sd;
    row["unit"] = si_unit(t.property);
    row["n"] = t.n, row["confining"] = t.confining, row["diameter"] = t.diameter;
    rows.append(row);
  }
  return rows;
}

/// Keys of a rock, whose recipe may be an object and whose table may be text.
NamedRock rock_of(const py::dict& keys, const std::string& where, const std::optional<std::string>& table) {
  rock::RockParts parts;
  parts.table = table;
  if (keys.contains("recipe") && py::isinstance<Recipe>(keys["recipe"])) {
    parts.recipe = keys["recipe"].cast<Recipe>();
    keys["recipe"] = parts.recipe->name;
  }
  return {rock::rock_of(tree_of(keys, where), where, parts), where};
}

}  // namespace

TomlValue tree_of(const py::dict& keys, const std::string& where) { return table_of(keys, "", where); }

namespace {

/// How a recipe is made: of keys, a file, a text, another recipe.
void add_makers(py::class_<Recipe>& recipe) {
  recipe
      .def(py::init([](const py::kwargs& keys) { return io::recipe_of(tree_of(keys, "Recipe"), "Recipe"); }),
           R"(A recipe from keys: Recipe(matrix={"E_c": "38 GPa"}, bedding=[{}], test={"angles": ["30 deg"]}).

Tables of the file are dicts, [[bedding]] is a list of them; quantities carry their unit. What is left out has
its default, which is the paper's specimen without bedding; bedding=[{}] gives it the paper's. Every key with
unit, range and meaning: docs/reference.md, or phyllite.explain("matrix.E_c").

Raises InputError with every problem found.)")
      .def_static(
          "from_file", [](const py::object& path) { return io::read_recipe(text_of(path)); }, py::arg("path"),
          "from_file(path)\n--\n\nThe recipe of a TOML file. Raises IoError, or InputError with every "
          "problem found.")
      .def_static(
          "from_toml",
          [](const std::string& text, const std::string& where) { return io::parse_recipe(text, where); },
          py::arg("text"), py::arg("where") = "recipe",
          "from_toml(text, where='recipe')\n--\n\nThe recipe of a TOML text; `where` names it in messages. "
          "Raises InputError with every problem "
          "found.")
      .def("changed", &changed,
           R"(changed(self, **keys)
--

Another recipe with some keys changed: recipe.changed(matrix={"sigma_c": "40 MPa"}).

Tables are changed key by key; a list of as many sets of bedding as the recipe has, set by set.)");
}

void add_contents(py::class_<Recipe>& recipe) {
  recipe
      .def("__getitem__", &value_in, py::arg("key"),
           R"(__getitem__(self, key)
--

The value of a key, "matrix.E_c" or "bedding[0].k_n": SI and degrees, words for choices.)")
      .def(
          "to_toml", [](const Recipe& r) { return io::write_recipe(r); },
          "to_toml(self)\n--\n\nThe completed recipe as TOML: every key with its value, in units that read "
          "back to the same bits.")
      .def_property_readonly(
          "name", [](const Recipe& r) { return r.name; }, "Its name.")
      .def_property_readonly(
          "notes", [](const Recipe& r) { return r.notes; }, "How the keys were understood, a line each.")
      .def_property_readonly(
          "specimens", [](const Recipe& r) { return specimen_names(r); },
          R"(Names of the specimens that it asks for: "theta = 30 deg", "intact".)")
      .def(
          // As text: a recipe is what its file says, and text reads back in another version, too.
          py::pickle([](const Recipe& r) { return py::make_tuple(io::write_recipe(r)); },
                     [](const py::tuple& t) { return io::parse_recipe(t[0].cast<std::string>(), "recipe"); }))
      .def("__eq__",
           // By their texts: notes on how keys were written do not make another recipe.
           [](const Recipe& a, const Recipe& b) { return io::write_recipe(a) == io::write_recipe(b); })
      .def("__repr__", [](const Recipe& r) { return "<phyllite.Recipe \"" + r.name + "\">"; });
}

}  // namespace

void add_recipes(py::module_& m) {
  py::options own_signatures;  // the first line of each text, which inspect.signature reads
  own_signatures.disable_function_signatures();
  py::class_<Recipe> recipe(m, "Recipe",
                            "Everything that a run depends on, checked and completed. Not to be changed.");
  add_makers(recipe), add_contents(recipe);

  m.def("rocks", &jobs::base_rocks);
  py::class_<NamedRock>(m, "RockRecord")
      .def_static("from_toml",
                  [](const std::string& path) {
                    return NamedRock{rock::read_rock(path), path};
                  })
      .def_static("from_keys", &rock_of)
      .def_static("from_base",
                  [](const std::string& name) {
                    return NamedRock{jobs::base_rock(name), name};
                  })
      .def_property_readonly("name", [](const NamedRock& r) { return r.rock.name; })
      .def_property_readonly("notes", [](const NamedRock& r) { return r.rock.notes; })
      .def_property_readonly("targets", &rows_of_targets)
      .def_property_readonly("findings", &findings_of)
      .def("check", [](const NamedRock& r, bool all) {
        // Width 0: a notebook breaks lines itself.
        return jobs::rock_check(r.rock, r.source, 0, jobs::n_threads(0), all);
      });

  // All three files at once: in Python nobody knows which of them has a key.
  m.def("explain", [](const std::string& key) {
    return jobs::explain({&io::recipe_schema(), &rock::rock_schema(), &study::study_schema()}, key);
  });
  m.def("keys", [] {
    py::dict all;
    for (const io::Schema* schema : {&io::recipe_schema(), &rock::rock_schema(), &study::study_schema()})
      all[py::str(schema->name)] = top_keys(*schema);
    return all;
  });
}

}  // namespace phy::python
