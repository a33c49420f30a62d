#include "survey/doubts.hpp"

#include "survey/angle_question.hpp"
#include "survey/outliers.hpp"
#include "survey/unusual.hpp"

namespace phy::survey {

std::vector<Finding> doubts_about(const Evidence& evidence) {
  std::vector<Finding> doubts;
  for (const auto& some : {angle_question(evidence.targets, evidence.rock.counts_from_load),
                           unusual_values(evidence.rock), conversion_in_part(evidence.rock),
                           outlying_specimens(evidence.rock), outlying_cells(evidence.targets)})
    doubts.insert(doubts.end(), some.begin(), some.end());
  return doubts;
}

}  // namespace phy::survey
