// Tables as CSV (docs/formats.md): packings in and out, for other programs and from them; histories,
// cracks, acoustic events, the wall of an opening.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy::io {

/// Discs of a file with the box that its comment line names; 0 where it names none.
struct DiscFile {
  double width = 0.0;   ///< [m]
  double height = 0.0;  ///< [m]
  std::vector<Disc> discs;
  std::vector<int> lines;  ///< where each stands
};

/// Discs as CSV: "x [m],y [m],r [m]" after a comment line with the box. Reads back to the same bits.
std::string discs_csv(const Packing& packing);
/// Reads discs from a text; `where` names the source. Throws InputError with every bad line (at most 20 in
/// full).
DiscFile parse_discs(std::string_view given, const std::string& where);
/// Reads discs from a file. Throws IoError, or InputError as parse_discs.
std::vector<Disc> read_discs(const std::string& path);
/// Contacts as CSV: grains, kind, normal, gap, stiffnesses per metre thickness, strengths.
std::string contacts_csv(const Specimen& specimen);

/// One line per row, one column per entry of the columns of its test, the unit in the header.
std::string history_csv(const History& history);
std::string cracks_csv(const std::vector<CrackEvent>& cracks, TestKind kind);
std::string events_csv(const std::vector<AcousticEvent>& events, TestKind kind);
std::string wall_csv(const std::vector<WallPoint>& wall);
/// Read what the four above have written, to the same bits (width and height of a history are not in the
/// table). Throw IoError with the line that does not fit.
History parse_history(std::string_view text, const std::string& where);
std::vector<CrackEvent> parse_cracks(std::string_view text, const std::string& where);
std::vector<AcousticEvent> parse_events(std::string_view text, const std::string& where);
std::vector<WallPoint> parse_wall(std::string_view text, const std::string& where);

}  // namespace phy::io
