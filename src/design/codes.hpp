// The codes that constants are written for: a table each. A further code is one more table.
//
// A row is a name of the code's own documentation, the constants that it is made of, and the unit. Names,
// signs and angles are those of the document in `source`, which was read; a row whose name no document shows
// is `unnamed`, and its file gives the meaning in its place.
//
// Signs: all of these codes take strengths and moduli as positive numbers, whatever the sign of their
// stresses. Angles: `dip` is the inclination of the planes in the section, counter-clockwise from the
// horizontal axis x, the vertical axis upwards; a code that asks for a normal gets (-sin dip, cos dip).
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "design/draws.hpp"
#include "design/strength.hpp"

namespace phy::design {

/// What a row is computed from.
struct Values {
  const Pooled* parts[n_parts] = {};  ///< by Part; nullptr: there are none
  double dip = 0.0;                   ///< [deg]
  /// In SI; NaN: it is not known.
  double operator()(Constant constant) const;
  /// Strength of the rock between planes in uniaxial tension by c and phi alone [Pa].
  double tension_by_cohesion() const;
};

struct CodeRow {
  const char* name;  ///< of the code; "": no document names it
  double (*value)(const Values& values);
  double factor;     ///< from SI to the unit
  const char* unit;  ///< for the reader of the file
  const char* meaning;
};

/// How a table becomes a file.
enum class Syntax { flac, python_rs2, xml, table };

struct Code {
  const char* name;    ///< as people call it: "FLAC"
  const char* model;   ///< the constitutive model, in the code's own word
  const char* file;    ///< in the folder of the design
  const char* source;  ///< address of the documentation
  Syntax syntax;
  std::vector<CodeRow> rows;
  std::vector<const char*> notes;                    ///< what the reader of the file has to know
  std::vector<const char*> before = {}, after = {};  ///< lines of the code's own around the rows
};
std::span<const Code> codes();

/// The file of a code; nothing: a constant that it needs is not known.
std::optional<std::string> file_of(const Code& code, const Values& values, const std::string& rock);

/// All constants, a row each; the covariances of each part, a row per pair.
std::string constants_csv(const Values& values);
std::string covariance_csv(const Values& values);

}  // namespace phy::design
