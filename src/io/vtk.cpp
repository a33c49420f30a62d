#include "io/vtk.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <type_traits>

#include "base/check.hpp"
#include "base/units.hpp"
#include "records/test_description.hpp"

namespace phy::io {
namespace {

/// Collects arrays and renders one PolyData file. Raw appended data: each block is its length, then its
/// bytes.
class PolyData {
 public:
  explicit PolyData(std::size_t n_points, std::size_t n_lines = 0, std::size_t n_verts = 0)
      : n_points_(n_points), n_lines_(n_lines), n_verts_(n_verts) {}

  template <class T>
  std::string array(const std::string& name, int components, const std::vector<T>& values) {
    // The three types that are written: 8 bytes floating or whole, 4 bytes floating.
    const std::string type = sizeof(T) == 8 ? (std::is_floating_point_v<T> ? "Float64" : "Int64") : "Float32";
    std::string tag = "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                      std::to_string(components) + "\" format=\"appended\" offset=\"" +
                      std::to_string(raw_.size()) + "\"/>\n";
    // header_type UInt64 below: the length in front of each block.
    const std::uint64_t bytes = values.size() * sizeof(T);
    append(&bytes, sizeof bytes);
    append(values.data(), bytes);
    return tag;
  }
  std::string render(const std::string& points, const std::string& verts, const std::string& lines,
                     const std::string& point_data, const std::string& cell_data) const {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
           std::to_string(n_points_) + "\" NumberOfVerts=\"" + std::to_string(n_verts_) +
           "\" NumberOfLines=\"" + std::to_string(n_lines_) +
           "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData>\n" + point_data +
           "</PointData>\n<CellData>\n" + cell_data + "</CellData>\n<Points>\n" + points +
           "</Points>\n<Verts>\n" + verts + "</Verts>\n<Lines>\n" + lines +
           // Raw data begin after the underscore; offsets count from there.
           "</Lines>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + raw_ +
           "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  void append(const void* data, std::size_t bytes) {
    const std::size_t at = raw_.size();
    raw_.resize(at + bytes);
    if (bytes > 0) std::memcpy(raw_.data() + at, data, bytes);
  }
  std::size_t n_points_, n_lines_, n_verts_;
  std::string raw_;
};

/// Tags of arrays that follow one another. In braces they are made from left to right; with `+` every
/// compiler has an order of its own, and the same numbers would be other files.
std::string in_order(std::initializer_list<std::string> tags) {
  std::string all;
  for (const std::string& tag : tags) all += tag;
  return all;
}

/// connectivity 0 1 2 ... and offsets step, 2 step, ...
std::string cells(PolyData& file, std::size_t n_cells, std::int64_t step,
                  const std::vector<std::int64_t>& connectivity) {
  std::vector<std::int64_t> offsets;
  for (std::size_t i = 1; i <= n_cells; ++i) offsets.push_back(static_cast<std::int64_t>(i) * step);
  return in_order({file.array("connectivity", 1, connectivity), file.array("offsets", 1, offsets)});
}

std::vector<std::int64_t> counting(std::size_t n) {
  std::vector<std::int64_t> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i] = static_cast<std::int64_t>(i);
  return all;
}

/// Values of an unstable test that are not finite are written as 0: ParaView cannot read them.
double or_zero(double value) { return std::isfinite(value) ? value : 0.0; }

std::vector<double> grain_points(const Packing& packing, const Snapshot& shot) {
  PHY_CHECK(shot.grains.size() == packing.discs.size(), "a snapshot holds every grain of its packing");
  std::vector<double> xyz;
  for (std::size_t i = 0; i < packing.discs.size(); ++i) {
    xyz.push_back(packing.discs[i].x + or_zero(shot.grains[i].ux));
    xyz.push_back(packing.discs[i].y + or_zero(shot.grains[i].uy));
    // Points are three-dimensional in VTK.
    xyz.push_back(0.0);
  }
  return xyz;
}

}  // namespace

std::string grains_vtp(const Packing& packing, const Snapshot& shot) {
  const std::size_t n = packing.discs.size();
  std::vector<double> radius, displacement, rotation;
  for (std::size_t i = 0; i < n; ++i) {
    radius.push_back(packing.discs[i].r);
    displacement.insert(displacement.end(), {or_zero(shot.grains[i].ux), or_zero(shot.grains[i].uy), 0.0});
    rotation.push_back(or_zero(shot.grains[i].rotation));
  }
  PolyData file(n, 0, n);
  const std::string points = file.array("points", 3, grain_points(packing, shot));
  // One vertex per grain: without cells ParaView draws nothing.
  const std::string verts = cells(file, n, 1, counting(n));
  const std::string lines = cells(file, 0, 2, {});
  const std::string data =
      in_order({file.array("radius [m]", 1, radius), file.array("displacement [m]", 3, displacement),
                file.array("rotation [rad]", 1, rotation)});
  return file.render(points, verts, lines, data, "");
}

std::string contacts_vtp(const Packing& packing, const Snapshot& shot) {
  std::vector<std::int64_t> ends, kind, broken;
  std::vector<double> F_n, F_s;
  for (const ContactState& c : shot.contacts) {
    ends.push_back(c.a), ends.push_back(c.b);
    kind.push_back(static_cast<std::int64_t>(c.kind)), broken.push_back(c.broken ? 1 : 0);
    F_n.push_back(or_zero(c.F_n)), F_s.push_back(or_zero(c.F_s));
  }
  PolyData file(packing.discs.size(), shot.contacts.size());
  const std::string points = file.array("points", 3, grain_points(packing, shot));
  const std::string verts = cells(file, 0, 1, {});
  const std::string lines = cells(file, shot.contacts.size(), 2, ends);
  const std::string data = in_order({file.array("F_n [N/m]", 1, F_n), file.array("F_s [N/m]", 1, F_s),
                                     file.array("kind", 1, kind), file.array("broken", 1, broken)});
  return file.render(points, verts, lines, "", data);
}

std::string cracks_vtp(const std::vector<CrackEvent>& cracks, TestKind kind) {
  std::vector<double> xyz, strain, energy;
  std::vector<std::int64_t> mode, place;
  for (const CrackEvent& c : cracks) {
    // A crack lies across the line of the centres: from its middle half a length to either side along the
    // plane.
    const Vec2 half = 0.5 * c.size * tangent(c.normal);
    for (const Vec2 p : {c.position - half, c.position + half}) xyz.insert(xyz.end(), {p.x, p.y, 0.0});
    strain.push_back(c.strain), energy.push_back(c.energy);
    mode.push_back(static_cast<std::int64_t>(c.mode)), place.push_back(static_cast<std::int64_t>(c.place));
  }
  PolyData file(2 * cracks.size(), cracks.size());
  const std::string points = file.array("points", 3, xyz);
  const std::string verts = cells(file, 0, 1, {});
  const std::string lines = cells(file, cracks.size(), 2, counting(2 * cracks.size()));
  const std::string data =
      in_order({file.array("mode", 1, mode), file.array("place", 1, place),
                file.array(kind->loads_by_strain() ? "strain" : heading(kind->loading_column()), 1, strain),
                file.array("energy [J per m]", 1, energy)});
  return file.render(points, verts, lines, "", data);
}

std::string events_vtp(const std::vector<AcousticEvent>& events, TestKind kind) {
  std::vector<double> xyz, time, strain, moment, magnitude, share, energy, tensor;
  std::vector<std::int64_t> type, cracks;
  for (const AcousticEvent& e : events) {
    // Without a moment there is no magnitude, and 0 would be the largest of all.
    if (!std::isfinite(e.magnitude)) continue;
    // Three coordinates, as of grains.
    xyz.insert(xyz.end(), {e.position.x, e.position.y, 0.0});
    time.push_back(e.time), strain.push_back(e.strain);
    moment.push_back(e.moment), magnitude.push_back(e.magnitude);
    share.push_back(e.volume_share), energy.push_back(e.energy);
    const MomentTensor& m = e.tensor;  // ParaView draws tensors of three directions
    tensor.insert(tensor.end(), {m.xx, m.xy, 0.0, m.xy, m.yy, 0.0, 0.0, 0.0, 0.0});
    type.push_back(static_cast<std::int64_t>(e.type)), cracks.push_back(e.n_cracks);
  }
  const std::size_t n = magnitude.size();
  PolyData file(n, 0, n);
  const std::string points = file.array("points", 3, xyz);
  const std::string verts = cells(file, n, 1, counting(n));
  const std::string lines = cells(file, 0, 2, {});
  const std::string way = kind->loads_by_strain() ? "strain" : heading(kind->loading_column());
  const std::string data = in_order(
      {file.array("time [s]", 1, time), file.array(way, 1, strain), file.array("n_cracks", 1, cracks),
       file.array("moment [N]", 1, moment), file.array("magnitude", 1, magnitude),
       file.array("volume share [%]", 1, share), file.array("source", 1, type),
       file.array("energy [J per m]", 1, energy), file.array("moment tensor [N]", 9, tensor)});
  return file.render(points, verts, lines, data, "");
}

std::string collection_pvd(const std::vector<std::pair<double, std::string>>& files) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const auto& [time, name] : files)
    text += "<DataSet timestep=\"" + print_number(time) + "\" file=\"" + name + "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace phy::io
