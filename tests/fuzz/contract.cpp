#include "contract.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace phy::fuzz {
namespace {

namespace fs = std::filesystem;

/// In memory where there is such a place: thousands of inputs a second would wear a disk.
fs::path place() {
  const fs::path memory = "/dev/shm";
  return ::access(memory.c_str(), W_OK) == 0 ? memory : fs::temp_directory_path();
}

}  // namespace

Files::Files(std::string_view input, const std::vector<std::string>& names)
    : folder_(place() / ("phyllite-fuzz-" + std::to_string(::getpid()))) {
  fs::create_directories(folder_);
  std::string name, content;
  const auto finish = [&] {
    if (name.empty() && !content.empty()) name = names.front();
    if (std::find(names.begin(), names.end(), name) != names.end()) write(name, content);
    content.clear();
  };
  while (!input.empty()) {
    const std::size_t end = std::min(input.find('\n'), input.size() - 1) + 1;
    const std::string_view line = input.substr(0, end);
    input.remove_prefix(end);
    if (line.starts_with("=== ") && line.ends_with('\n'))
      finish(), name = line.substr(4, line.size() - 5);
    else
      content += line;
  }
  finish();
}

Files::~Files() {
  std::error_code none;
  fs::remove_all(folder_, none);
}

std::string Files::read(const std::string& name) const {
  std::ifstream in(folder_ / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void Files::write(const std::string& name, std::string_view content) const {
  std::ofstream(folder_ / name, std::ios::binary) << content;
}

}  // namespace phy::fuzz
