// A key of a file that the program writes, for the pages that list them.
#pragma once

namespace phy {

struct FileKey {
  const char* name;
  const char* content;  ///< in Markdown
};

}  // namespace phy
