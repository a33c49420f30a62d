// Numbers that a user of the long tests may set in the environment.
#pragma once
#include <cstdlib>
#include <string>

namespace phy {

inline double setting(const char* name, double otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtod(text, nullptr) : otherwise;
}

inline std::string text_setting(const char* name) {
  const char* text = std::getenv(name);
  return text != nullptr ? text : "";
}

}  // namespace phy
