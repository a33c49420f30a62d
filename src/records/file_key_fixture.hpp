// For tests: a file of JSON held against the list of its keys.
#pragma once
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "records/file_key.hpp"

namespace phy {

/// "kind.key" of every key of a list.
inline std::set<std::string> listed_keys(const std::vector<FileObject>& objects) {
  std::set<std::string> all;
  for (const FileObject& object : objects)
    for (const FileKey& key : object.keys) all.insert(object.kind + std::string(".") + key.name);
  return all;
}

/// Walks a value that holds objects of `kind`, itself or in lists: adds each "kind.key" to `met` if it is
/// listed, else to `unlisted`.
inline void walk_keys(const nlohmann::json& value, std::string_view kind,
                      const std::vector<FileObject>& objects, std::set<std::string>& met,
                      std::set<std::string>& unlisted) {
  if (value.is_array())
    for (const auto& element : value) walk_keys(element, kind, objects, met, unlisted);
  if (!value.is_object()) return;
  const auto object =
      std::find_if(objects.begin(), objects.end(), [&](const FileObject& o) { return o.kind == kind; });
  for (const auto& [name, held] : value.items()) {
    const FileKey* listed = nullptr;
    if (object != objects.end())
      for (const FileKey& key : object->keys)
        if (key.name == name || (listed == nullptr && std::string_view(key.name) == "*")) listed = &key;
    (listed != nullptr ? met : unlisted)
        .insert(std::string(kind) + "." + (listed != nullptr ? listed->name : name));
    if (listed != nullptr && *listed->holds != '\0') walk_keys(held, listed->holds, objects, met, unlisted);
  }
}

/// The keys of a file that its list lacks; `met` gathers those that it has.
inline std::set<std::string> unlisted_keys(const std::string& file, const std::vector<FileObject>& objects,
                                           std::set<std::string>& met) {
  std::set<std::string> unlisted;
  walk_keys(nlohmann::json::parse(file), objects.front().kind, objects, met, unlisted);
  return unlisted;
}

}  // namespace phy
