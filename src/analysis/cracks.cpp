#include "analysis/cracks.hpp"

#include <limits>

#include "base/nan.hpp"

namespace phy::analysis {
namespace {

struct Kind {
  const char* name;
  const char* meaning;
  std::int64_t CrackCounts::*count;
};
constexpr Kind kinds[] = {
    {"cracks_tension_matrix", "number of matrix bonds broken in tension", &CrackCounts::tension_matrix},
    {"cracks_shear_matrix", "number of matrix bonds broken in shear", &CrackCounts::shear_matrix},
    {"cracks_tension_bedding", "number of bedding joints broken in tension", &CrackCounts::tension_bedding},
    {"cracks_shear_bedding", "number of bedding joints broken in shear", &CrackCounts::shear_bedding},
};

}  // namespace

CrackCounts count_cracks(const std::vector<CrackEvent>& cracks, double up_to_strain) {
  CrackCounts n;
  for (const CrackEvent& c : cracks) {
    // Without a peak its strain is NaN, and no crack is counted.
    if (!(c.strain <= up_to_strain)) continue;
    // How it broke and where it lay: four counts.
    const bool tension = c.mode == CrackMode::tension;
    if (c.place == CrackPlace::matrix)
      ++(tension ? n.tension_matrix : n.shear_matrix);
    else
      ++(tension ? n.tension_bedding : n.shear_bedding);
  }
  return n;
}

std::vector<Number> crack_numbers(const LoadingBranch& branch, const std::vector<CrackEvent>& cracks) {
  constexpr double all = std::numeric_limits<double>::infinity();
  // In the whole test, also behind the peak: pictures show these.
  const CrackCounts at_end = count_cracks(cracks, all), at_peak = count_cracks(cracks, branch.strain);
  std::vector<Number> out;
  for (const Kind& k : kinds)
    out.push_back({k.name, static_cast<double>(at_end.*k.count), "1",
                   std::string(k.meaning) + " in the whole test", ""});
  for (const Kind& k : kinds)
    out.push_back({std::string(k.name) + "_at_peak",
                   branch.peaked ? static_cast<double>(at_peak.*k.count) : nan, "1",
                   std::string(k.meaning) + " up to " + branch.point(), branch_note(branch)});
  return out;
}

}  // namespace phy::analysis
