// What the columns of a laboratory's table hold: headers as laboratories write them (rock/columns.hpp),
// the word of the rock file before them, units in the header or in a row of their own, specimens side by
// side. A column that may hold a direction, a strength or a modulus is read or asked for, never left out in
// silence.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "io/table.hpp"
#include "rock/columns.hpp"

namespace phy::rock {

/// What a rock file says of its table.
struct TableKeys {
  double confining = nan;  ///< [Pa] of several confining pressures these rows alone give E and nu; NaN: all
  std::string sheet;       ///< of a workbook; "": the first
  std::map<std::string, std::string> columns;  ///< header, with or without its unit -> our name, or "-"
  std::optional<bool> bedded;  ///< the rock has layers; nothing: the angles of the table say so
};

struct Heads {
  std::vector<Head> all;          ///< one per column of the table
  bool asked_for_angles = false;  ///< a column may hold the inclination: that is among the problems

  /// The first column of a kind; of values and scatter, of this property.
  std::optional<std::size_t> find(Column kind, Property p = Property::E) const;
  /// The column that says how the layers lie.
  std::optional<std::size_t> angles() const {
    const auto theta = find(Column::theta);
    return theta ? theta : find(Column::beta);
  }
};

/// Reads the header of `table`, and takes a row of units below it out of the rows. Appends to `problems` what
/// has to be asked or cannot be read, to `notes` how the rest is read.
Heads read_heads(io::Table& table, const TableKeys& keys, std::vector<Problem>& problems,
                 std::vector<std::string>& notes);

}  // namespace phy::rock
