// Recipe and Rock.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <charconv>
#include <filesystem>

#include "base/quote.hpp"
#include "io/rock_in.hpp"
#include "io/toml_in.hpp"
#include "jobs/keys.hpp"
#include "jobs/rock_check.hpp"
#include "python/module.hpp"
#include "records/calibration.hpp"
#include "records/recipe_schema.hpp"
#include "records/specimen_record.hpp"
#include "study/study_in.hpp"

namespace phy::python {
namespace {

using io::TomlValue;
using Kind = TomlValue::Kind;

TomlValue value_of(const py::handle& value, const std::string& path, const std::string& where);

TomlValue of_kind(Kind kind, double number, std::string text = "") {
  TomlValue v;
  v.kind = kind, v.number = number, v.text = std::move(text);
  return v;
}

[[noreturn]] void refuse(const py::handle& value, const std::string& path, const std::string& where,
                         const char* expected) {
  throw InputError(
      Problem{where, path, py::repr(value).cast<std::string>(), expected, "quantities carry their unit"});
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
    if (!is_plain(text)) refuse(value, path, where, "text without line breaks and other control characters");
    return of_kind(Kind::text, 0.0, std::move(text));
  }
  if (py::isinstance<py::bool_>(value)) return of_kind(Kind::boolean, value.cast<bool>() ? 1.0 : 0.0);
  if (py::isinstance<py::dict>(value)) return table_of(py::reinterpret_borrow<py::dict>(value), path, where);
  if (py::hasattr(value, "tolist")) return value_of(value.attr("tolist")(), path, where);  // of NumPy
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) return list_of(value, path, where);
  if (PyIndex_Check(value.ptr()) != 0)
    return of_kind(Kind::integer, py::float_(value.attr("__index__")()), py::str(value).cast<std::string>());
  if (py::isinstance<py::float_>(value)) return of_kind(Kind::number, value.cast<double>());
  if (py::hasattr(value, "__fspath__")) return value_of(value.attr("__fspath__")(), path, where);
  refuse(value, path, where, "text, a number, a switch, a list or a dict");
}

/// `more` over `keys`: tables key by key, lists of tables of one length table by table.
void put_over(TomlValue& keys, const TomlValue& more) {
  const bool tables = keys.kind == Kind::table && more.kind == Kind::table;
  if (tables)
    for (std::size_t i = 0; i < more.keys.size(); ++i)
      put_over(item_of(keys, more.keys[i].name), more.items[i]);
  const bool lists = keys.kind == Kind::list && more.kind == Kind::list && !more.items.empty() &&
                     keys.items.size() == more.items.size() && more.items.front().kind == Kind::table;
  if (lists)
    for (std::size_t i = 0; i < more.items.size(); ++i) put_over(keys.items[i], more.items[i]);
  if (!tables && !lists) keys = more;
}

Recipe changed(const Recipe& recipe, const py::kwargs& keys) {
  std::vector<Problem> none;
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

/// Keys of a rock, whose recipe may be an object and whose table may be text.
NamedRock rock_of(const py::dict& keys, const std::string& where, const std::optional<std::string>& table) {
  io::RockParts parts;
  parts.table = table;
  if (keys.contains("recipe") && py::isinstance<Recipe>(keys["recipe"])) {
    parts.recipe = keys["recipe"].cast<Recipe>();
    keys["recipe"] = parts.recipe->name;
  }
  return {io::rock_of(tree_of(keys, where), where, parts), where};
}

}  // namespace

TomlValue tree_of(const py::dict& keys, const std::string& where) { return table_of(keys, "", where); }

void add_recipes(py::module_& m) {
  py::class_<Recipe>(m, "Recipe",
                     "Everything that a run depends on, checked and completed. Not to be changed.")
      .def(py::init([](const py::kwargs& keys) { return io::recipe_of(tree_of(keys, "Recipe"), "Recipe"); }),
           R"(A recipe from keys: Recipe(matrix={"E_c": "38 GPa"}, bedding=[{}], test={"angles": ["30 deg"]}).

Tables of the file are dicts, [[bedding]] is a list of them; quantities carry their unit. What is left out has
its default, which is the paper's specimen without bedding; bedding=[{}] gives it the paper's. Every key with
unit, range and meaning: docs/reference.md, or phyllite.explain("matrix.E_c").

Raises InputError with every problem found.)")
      .def_static(
          "from_file", [](const py::object& path) { return io::read_recipe(text_of(path)); }, py::arg("path"),
          "The recipe of a TOML file. Raises IoError, or InputError with every problem found.")
      .def_static(
          "from_toml",
          [](const std::string& text, const std::string& where) { return io::parse_recipe(text, where); },
          py::arg("text"), py::arg("where") = "recipe",
          "The recipe of a TOML text; `where` names it in messages. Raises InputError with every problem "
          "found.")
      .def("changed", &changed,
           R"(Another recipe with some keys changed: recipe.changed(matrix={"sigma_c": "40 MPa"}).

Tables are changed key by key; a list of as many sets of bedding as the recipe has, set by set.)")
      .def("__getitem__", &value_in, py::arg("key"),
           R"(The value of a key, "matrix.E_c" or "bedding[0].k_n": SI and degrees, words for choices.)")
      .def(
          "to_toml", [](const Recipe& r) { return io::write_recipe(r); },
          "The completed recipe as TOML: every key with its value, in units that read back to the same bits.")
      .def_property_readonly(
          "name", [](const Recipe& r) { return r.name; }, "Its name.")
      .def_property_readonly(
          "notes", [](const Recipe& r) { return r.notes; }, "How the keys were understood, a line each.")
      .def_property_readonly(
          "specimens", [](const Recipe& r) { return specimen_names(r); },
          R"(Names of the specimens that it asks for: "theta = 30 deg", "intact".)")
      .def("__eq__",
           [](const Recipe& a, const Recipe& b) { return io::write_recipe(a) == io::write_recipe(b); })
      .def("__repr__", [](const Recipe& r) { return "<phyllite.Recipe \"" + r.name + "\">"; });

  py::class_<Target>(m, "Target", "A cell of a laboratory's table: one quantity at one inclination.")
      .def_property_readonly(
          "property", [](const Target& t) { return to_string(t.property); },
          R"("E", "nu", "UCS", "DTS", "BTS", "sigma_1", "sigma_ci" or "K_Ic".)")
      .def_readonly("theta", &Target::theta, "Inclination of the bedding [deg]; load along y.")
      .def_readonly("mean", &Target::mean,
                    "Mean of its specimens: E and strengths [Pa], nu [1], K_Ic [Pa sqrt(m)].")
      .def_readonly("sd", &Target::sd, "Scatter of single specimens, in the unit of the mean.")
      .def_readonly("n", &Target::n, "Number of specimens.")
      .def_readonly("confining", &Target::confining, "Confining stress [Pa].")
      .def("__repr__", [](const Target& t) { return "<phyllite.Target " + cell_name(t) + ">"; });

  py::class_<NamedRock>(m, "Rock", R"(A rock as a laboratory saw it: a table of tests.

Columns carry their unit: theta [deg], E [GPa], nu, UCS [MPa],
DTS [MPa], BTS [MPa], K_Ic [MPa sqrt(m)], n ... (docs/formats.md, "Rock").)")
      .def_static(
          "from_toml",
          [](const py::object& path) {
            return NamedRock{io::read_rock(text_of(path)), text_of(path)};
          },
          py::arg("path"),
          "The rock of a rock file. Raises IoError, or InputError with every problem of all its files.")
      .def_static(
          "from_csv",
          [](const py::object& path, const py::kwargs& keys) {
            keys["data"] = text_of(path);
            if (!keys.contains("name")) keys["name"] = std::filesystem::path(text_of(path)).stem().string();
            return rock_of(keys, "Rock.from_csv", {});
          },
          py::arg("path"),
          R"(The rock of a table, with keys of a rock file: Rock.from_csv("shale.csv", E_is="secant 50 %").

Workbooks are tables too: Rock.from_csv("shale.xlsx", sheet="UCS", columns={"peak stress": "UCS"}).

recipe may be a Recipe or the name of a file. Raises IoError, or InputError with every problem found.)")
      .def_static(
          "from_dataframe",
          [](const py::object& frame, const py::kwargs& keys) {
            keys["data"] = "DataFrame";
            if (!keys.contains("name")) keys["name"] = "rock";
            return rock_of(keys, "Rock.from_dataframe",
                           frame.attr("to_csv")(py::arg("index") = false).cast<std::string>());
          },
          py::arg("frame"),
          R"(The rock of a pandas DataFrame with the columns of a table; keys as of from_csv.

Its index is passed over. Lines in messages count from the names of the columns: the first row is line 2.)")
      .def_property_readonly(
          "name", [](const NamedRock& r) { return r.rock.name; }, "Its name.")
      .def_property_readonly(
          "notes", [](const NamedRock& r) { return r.rock.notes; },
          "How the table was understood, and warnings about it, a line each.")
      .def_property_readonly(
          "targets", [](const NamedRock& r) { return targets_of(r.rock); },
          "The table as a calibration reads it: a Target per quantity and inclination.")
      .def(
          "check", [](const NamedRock& r) { return jobs::rock_check(r.rock, r.source, 0); },
          "What its data can and cannot determine, before anything runs, as `phyllite rock check` tells it.")
      .def("__repr__", [](const NamedRock& r) { return "<phyllite.Rock \"" + r.rock.name + "\">"; });

  m.def(
      "explain",
      [](const std::string& key) {
        return jobs::explain({&io::recipe_schema(), &io::rock_schema(), &study::study_schema()}, key);
      },
      py::arg("key"),
      "Meaning, allowed values, default, units and name in PFC of a key of a recipe, rock or study.");
}

}  // namespace phy::python
