// Keys of a file that the program writes, for the pages that list them.
#pragma once
#include <vector>

namespace phy {

struct FileKey {
  const char* name;        ///< "*": any other name
  const char* content;     ///< in Markdown
  const char* holds = "";  ///< the kind of the object in it, or of the objects in its list
};

/// Objects of one kind. The first kind of a list is the file itself.
struct FileObject {
  const char* kind;
  std::vector<FileKey> keys;
};

}  // namespace phy
