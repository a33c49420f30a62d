// Readers of a single text.
#include <cmath>

#include "base/hash.hpp"
#include "base/units.hpp"
#include "contract.hpp"
#include "genesis/cache.hpp"
#include "io/csv.hpp"
#include "io/deflate.hpp"
#include "io/scene.hpp"
#include "io/toml_in.hpp"
#include "rock/table.hpp"

namespace phy::fuzz {

/// The first byte chooses the dimension.
bool read_quantity(std::string_view bytes) {
  if (bytes.empty()) return false;
  const auto dimension = static_cast<Dimension>(static_cast<unsigned char>(bytes.front()) % 7);
  const Quantity q = parse_quantity(bytes.substr(1), dimension, 1.0);
  if (q.ok != q.problem.empty()) throw Finding("a quantity is read, or has a problem");
  if (!q.ok) return false;
  if (!std::isfinite(q.value)) throw Finding("a quantity that is no number");
  const Quantity again = parse_quantity(print_quantity(q.value, dimension), dimension);
  if (!again.ok || again.value != q.value) throw Finding("printed, it is another: " + print_number(q.value));
  rounded(q.value, 6);
  return true;
}

bool read_recipe(std::string_view bytes) {
  return accepts([&] {
    const std::string text = io::write_recipe(io::parse_recipe(bytes, "recipe.toml"));
    same(text, io::write_recipe(io::parse_recipe(text, "written.toml")));
  });
}

/// All rows, and those under one confining pressure.
bool read_readings(std::string_view bytes) {
  bool read = false;
  for (const double confining : {1e7, std::nan("")}) {
    std::vector<Problem> problems;
    std::vector<std::string> notes;
    const rock::Readings readings =
        rock::parse_readings(bytes, "table.csv", {confining, "", {}}, problems, notes);
    read = problems.empty();
    for (const RockReading& r : readings.values)
      if (read && !std::isfinite(r.value)) throw Finding("a reading that is no number");
  }
  return read;
}

bool read_discs(std::string_view bytes) {
  return accepts([&] {
    const auto csv = [](const io::DiscFile& file) {
      Packing p;
      p.width = file.width, p.height = file.height, p.discs = file.discs;
      return io::discs_csv(p);
    };
    const std::string text = csv(io::parse_discs(bytes, "discs.csv"));
    same(text, csv(io::parse_discs(text, "written.csv")));
  });
}

/// A history, a list of cracks or of events: their headers tell which.
bool read_series(std::string_view bytes) {
  const bool history = accepts([&] {
    const std::string text = io::history_csv(io::parse_history(bytes, "history.csv"));
    same(text, io::history_csv(io::parse_history(text, "written.csv")));
  });
  const bool cracks = accepts([&] {
    const TestKind kind("uniaxial");
    const std::string text = io::cracks_csv(io::parse_cracks(bytes, "cracks.csv"), kind);
    same(text, io::cracks_csv(io::parse_cracks(text, "written.csv"), kind));
  });
  const bool events = accepts([&] {
    const TestKind kind("uniaxial");
    const std::string text = io::events_csv(io::parse_events(bytes, "events.csv"), kind);
    same(text, io::events_csv(io::parse_events(text, "written.csv"), kind));
  });
  return history || cracks || events;
}

/// The stream behind the first line is compressed here, so that changed bytes are read and not refused by its
/// checksum; what begins with a full stop is taken as it is.
bool read_scene(std::string_view bytes) {
  const std::size_t end = bytes.find('\n');
  std::string scene(bytes.substr(bytes.starts_with('.') ? 1 : 0));
  if (!bytes.starts_with('.') && end != bytes.npos)
    scene = std::string(bytes.substr(0, end + 1)) + io::deflated(bytes.substr(end + 1));
  return accepts([&] {
    const TestKind kind("uniaxial");
    // A report packs it anew.
    io::unpack_scene(io::pack_scene(io::unpack_scene(scene, "scene.bin"), kind), "written.bin");
  });
}

/// A packing of the cache: the bytes follow its two first lines, and its fingerprint is made to fit. Whatever
/// they are, there is a packing: that of the file or a new one.
bool read_packing(std::string_view bytes) {
  Recipe recipe;
  recipe.specimen = {0.002, 0.002}, recipe.packing.n_grains = 12;
  const std::string key = genesis::packing_key(recipe.specimen, recipe.packing, recipe.matrix);
  const std::string text = "phyllite packing, format 1\n" + key + "\n" + std::string(bytes);
  Hash hash;
  hash.add(std::string_view(text));
  const Files files("", {"none"});
  const std::filesystem::path file = genesis::cache_file(files.folder(), key);
  files.write(file.filename().string(), text + "end " + hash.text() + "\n");
  const auto packing =
      genesis::cached_packing(recipe.specimen, recipe.packing, recipe.matrix, files.folder());
  if (packing->discs.empty()) throw Finding("a packing without discs");
  for (const Disc& d : packing->discs)
    if (!(d.r > 0.0) || !std::isfinite(d.x + d.y + d.r)) throw Finding("a disc that is none");
  return true;
}

}  // namespace phy::fuzz
