#include "report/words.hpp"

namespace phy::report {

const std::vector<Wording>& words_of_table() {
  static const std::vector<Wording> list = {};
  return list;
}

}  // namespace phy::report
