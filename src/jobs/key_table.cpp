#include "jobs/key_table.hpp"

#include <fmt/format.h>

namespace phy::jobs {

std::string key_table(const std::vector<FileObject>& objects) {
  std::string text = "| object | key | objects in it | content |\n|---|---|---|---|\n";
  for (const FileObject& object : objects)
    for (const FileKey& key : object.keys)
      text += fmt::format("| {} | {} | {} | {} |\n", object.kind,
                          *key.name == '*' ? std::string("other names") : fmt::format("`{}`", key.name),
                          key.holds, key.content);
  return text;
}

}  // namespace phy::jobs
