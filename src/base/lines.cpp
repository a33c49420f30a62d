#include "base/lines.hpp"

namespace phy {

void add_line(std::vector<std::string>& lines, const std::string& subject, const std::string& what) {
  const std::string end = ": " + what;
  for (std::string& line : lines)
    if (line.ends_with(end) && line.find(": ") == line.size() - end.size()) {
      line.insert(line.size() - end.size(), ", " + subject);
      return;
    }
  lines.push_back(subject + end);
}

}  // namespace phy
