#include "engine/isa.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "base/check.hpp"
#include "base/text_table.hpp"

namespace phy::engine {

const char* to_string(Isa isa) { return isa_names().at(static_cast<std::size_t>(isa)); }

Isa native_isa() {
  const Isa best = best_isa();
  const char* wish = std::getenv("PHYLLITE_ISA");
  if (wish == nullptr || *wish == 0) return best;
  // The environment can lower the set (to compare them) but not raise it: the processor would stop at an
  // unknown instruction.
  const std::vector<const char*> names = isa_names();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::strcmp(wish, names[i]) == 0) return std::min(static_cast<Isa>(i), best);
  throw InputError(Problem{"environment", "PHYLLITE_ISA", wish,
                           joined_text({names.begin(), names.end()}, ", ", " or "), "or leave it unset"});
}

namespace {

int lanes_in(int bytes, Precision precision) {
  return bytes / static_cast<int>(precision == Precision::single_precision ? sizeof(float) : sizeof(double));
}

}  // namespace

int native_lanes(Precision precision, Isa isa) {
  return lanes_in(isa == Isa::sse2 ? 16 : isa == Isa::avx2 ? 32 : 64, precision);
}

std::vector<int> lanes_of(Precision precision, Isa isa) {
  std::vector<int> lanes = {1};
  for (int n = lanes_in(16, precision); n <= native_lanes(precision, isa); n *= 2) lanes.push_back(n);
  return lanes;
}

}  // namespace phy::engine
