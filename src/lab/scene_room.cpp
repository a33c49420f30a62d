#include "lab/scene_room.hpp"

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/largest_file.hpp"

namespace phy::lab {

void check_scene_room(const Specimen& specimen, const Recipe& recipe) {
  // Bytes (io/scene.hpp): a disc has three numbers, a link two and its kind, a frame two numbers of three
  // bytes per disc, a snapshot a byte per link. Of both up to twice as many are kept, and the last.
  constexpr double disc = 3 * 4.0, link = 2 * 4.0 + 1.0, frame = 2 * 3.0, force = 1.0, new_links = 1.5;
  const auto kept = [](std::int64_t wanted) { return 2.0 * static_cast<double>(wanted) + 1.0; };
  const auto n = static_cast<double>(specimen.packing->discs.size());
  const double links = new_links * static_cast<double>(specimen.contacts.size());
  const double bytes = n * (disc + frame * kept(recipe.test.n_frames)) +
                       links * (link + force * kept(recipe.test.n_snapshots));
  if (bytes <= static_cast<double>(largest_file)) return;
  throw InputError(Problem{
      "", "test.n_frames",
      fmt::format("{}, with n_snapshots = {}", recipe.test.n_frames, recipe.test.n_snapshots),
      fmt::format(
          "less: with {:.0f} grains up to {:.1f} GB would be stored for pictures, and {:.1f} can be read", n,
          1e-9 * bytes, 1e-9 * static_cast<double>(largest_file)),
      "lower n_frames or n_snapshots"});
}

}  // namespace phy::lab
