#include "python/module.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <new>
#include <string_view>

#include "base/check.hpp"
#include "base/option.hpp"
#include "base/version.hpp"
#include "jobs/failure.hpp"

namespace phy::python {
namespace {

void raise(const char* type, const std::string& message, const py::list& problems = py::list()) {
  // Classes of Python, made there, so that a user can catch them and read their docstrings.
  const py::object made = py::module_::import("phyllite.errors").attr(type)(message);
  // A program that fills a form needs each problem with its key, not one text.
  if (!problems.empty()) made.attr("problems") = problems;
  PyErr_SetObject(py::type::of(made).ptr(), made.ptr());
}

py::list problems_of(const InputError& e) {
  const py::object problem = py::module_::import("phyllite.errors").attr("Problem");
  py::list problems;
  for (const Problem& p : e.problems())
    problems.append(problem(p.where, p.key, p.value, p.expected, p.remedy));
  return problems;
}

/// The program's messages, as the command prints them.
void translate(std::exception_ptr failure) {  // NOLINT(performance-unnecessary-value-param): pybind's type
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const InputError& e) {
    raise("InputError", e.what(), problems_of(e));
  } catch (const IoError& e) {
    raise("IoError", e.what());
    // pybind would make a RuntimeError of it, which no caller expects for a full disk.
  } catch (const std::filesystem::filesystem_error& e) {
    raise("IoError", jobs::in_words(e));
  } catch (const InternalError& e) {
    raise("InternalError", std::string(jobs::internal) + e.what());
  } catch (const std::bad_alloc&) {
    // A fixed text: there may be no memory left to put one together.
    PyErr_SetString(PyExc_MemoryError, "not enough memory; use fewer grains, or fewer threads");
  }
}

/// "max_tests" of "max-tests", the parameter k_n of "set k_n", `path` of the corners "to".
std::string argument(std::string_view word) {
  // Three words that are otherwise called in Python.
  if (word == "to") return "path";
  if (word == "explain") return "key";
  if (word.starts_with("set ")) return std::string(word.substr(4));
  std::string name(word);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return c == '-' ? '_' : static_cast<char>(std::tolower(c)); });
  return name;
}

/// Of options that are set to a text, or switched on.
std::string argument_set(std::string_view word, std::string_view value) {
  if (value.empty()) return argument(word) + "=True";
  const std::string text = "\"" + std::string(value) + "\"";
  return argument(word) + "=" + (word == "to" ? "[" + text + "]" : text);
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.attr("__version__") = phy::version;
  py::register_exception_translator(translate);
  // Messages are made far below and name options; here those are keyword arguments.
  spell_options({"", argument, argument_set});
  add_recipes(m), add_specimens(m), add_runs(m), add_calibrations(m);
  py::module_ theory = m.def_submodule("theory");
  add_theory(theory);
}

}  // namespace phy::python
