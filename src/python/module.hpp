// The Python package: the same rooms behind another front. What is here turns Python's values into those of
// the rooms and back; what both fronts do lies in `jobs`. The public face is python/phyllite, which documents
// it; nothing here is named to users but Recipe, Rock and the results.
#pragma once
#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "io/toml_tree.hpp"
#include "records/recipe.hpp"
#include "records/rock.hpp"

namespace phy::python {

namespace py = pybind11;

/// A rock, and where it came from, for messages.
struct NamedRock {
  Rock rock;
  std::string source;
};

/// Keys given as Python values: text, numbers, lists, dicts (tables; "matrix.E_c" is E_c of the table
/// matrix). Throws InputError for values that no file could hold.
io::TomlValue tree_of(const py::dict& keys, const std::string& where);

// Each adds a part of the module.
void add_recipes(py::module_& m);
void add_specimens(py::module_& m);
void add_runs(py::module_& m);
void add_calibrations(py::module_& m);
void add_theory(py::module_& m);

}  // namespace phy::python
