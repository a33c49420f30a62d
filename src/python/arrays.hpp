// NumPy arrays over rows that lie in a result: a field per member, nothing copied. They keep the result alive
// and cannot be written to, as its hash stands for them.
#pragma once
#include <pybind11/numpy.h>

#include <string>
#include <vector>

namespace phy::python {

namespace py = pybind11;

/// A member of a row: its name, NumPy's word for its type, where it lies.
struct Member {
  std::string name;
  const char* type;
  std::size_t offset;
};

inline py::dtype row_type(const std::vector<Member>& members, std::size_t size) {
  py::list names, formats, offsets;
  for (const Member& m : members) names.append(m.name), formats.append(m.type), offsets.append(m.offset);
  return py::dtype(names, formats, offsets, static_cast<py::ssize_t>(size));
}

/// `owner` holds the rows.
template <class Row>
py::array view_of(const std::vector<Row>& rows, const std::vector<Member>& members, py::handle owner) {
  py::array view(row_type(members, sizeof(Row)), {rows.size()}, {sizeof(Row)}, rows.data(), owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

/// The same of rows that the array takes over.
template <class Row>
py::array array_of(std::vector<Row> rows, const std::vector<Member>& members) {
  auto* kept = new std::vector<Row>(std::move(rows));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Row>*>(p); });
  return view_of(*kept, members, owner);
}

}  // namespace phy::python
