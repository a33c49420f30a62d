// Every tutorial of docs/tutorials is done as it is written: a block behind a line "`NAME`:" is that file, a
// block of sh is run line by line, and a block of text behind it holds lines that were printed ("..." stands
// for anything). A line "From [...](PAGE): `NAME`" takes files of an earlier page.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "program.hpp"

namespace tutorial {

namespace fs = std::filesystem;

/// Pages of minutes on all cores: the long tests do these.
inline bool takes_long(const fs::path& page) {
  return page.stem().string().ends_with("from-table-to-drawing");
}

inline std::vector<fs::path> pages(bool long_ones) {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(fs::path(PHY_SOURCE_DIR) / "docs/tutorials"))
    if (takes_long(entry.path()) == long_ones) all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

inline std::string name_of(const testing::TestParamInfo<fs::path>& page) {
  std::string name = page.param.stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

struct Block {
  std::string language, before, text;  // `before`: the last line above it
  int line = 0;
};
inline std::vector<Block> blocks_of(const fs::path& file) {
  std::vector<Block> blocks;
  std::ifstream in(file);
  std::string line, before;
  bool inside = false;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (!inside) before.clear();
      if (inside) blocks.push_back({line.substr(3), before, "", number});
    } else if (inside) {
      blocks.back().text += line + "\n";
    } else if (!line.empty()) {
      before = line;
    }
  }
  return blocks;
}

/// The name in "`NAME`:", or "".
inline std::string file_name(const std::string& line) {
  return line.starts_with('`') && line.ends_with("`:") ? line.substr(1, line.size() - 3) : "";
}

/// Blocks of files that a page takes from others.
inline std::vector<Block> taken_over(const fs::path& page) {
  const std::regex from(R"(From \[[^\]]*\]\(([\w-]+\.md)\):.*)");
  std::vector<Block> taken;
  std::ifstream in(page);
  std::smatch link;
  for (std::string line; std::getline(in, line);) {
    if (!std::regex_match(line, link, from)) continue;
    for (const Block& block : blocks_of(page.parent_path() / link[1].str())) {
      const std::string name = file_name(block.before);
      if (!name.empty() && line.find("`" + name + "`") != line.npos) taken.push_back(block);
    }
  }
  return taken;
}

/// Does a line of `output` hold what stands between the "..." of `expected`, in this order?
inline bool printed(const std::string& output, const std::string& expected) {
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::size_t at = 0, from = 0;
    while (at != line.npos && from <= expected.size()) {
      const std::size_t to = std::min(expected.find("...", from), expected.size());
      const std::string part = expected.substr(from, to - from);
      const std::size_t found = line.find(part, at);
      at = found == line.npos ? found : found + part.size();
      from = to + 3;
    }
    if (at != line.npos) return true;
  }
  return false;
}

class Tutorial : public ProgramTest, public testing::WithParamInterface<fs::path> {
 protected:
  void do_as_written(const fs::path& page) {
    for (const char* shared : {"examples", "data"})
      fs::create_symlink(fs::path(PHY_SOURCE_DIR) / shared, at(shared));
    const std::string path = fs::path(PHY_PROGRAM).parent_path().string();
    for (const Block& block : taken_over(page)) write(file_name(block.before), block.text);
    std::string all;  // what the last block of sh has printed
    int n_commands = 0;
    for (const Block& block : blocks_of(page)) {
      const std::string where = page.filename().string() + ":" + std::to_string(block.line);
      std::istringstream lines(block.text);
      if (const std::string name = file_name(block.before); !name.empty()) {
        write(name, block.text);
      } else if (block.language == "sh") {
        all.clear();
        for (std::string line; std::getline(lines, line); ++n_commands) {
          if (line.find(" figure ") != line.npos && !has("gnuplot")) continue;
          EXPECT_EQ(run_line("cd " + folder.string() + " && PATH=" + path + ":$PATH && " + line), 0)
              << where << ": " << line << "\n"
              << output;
          all += output;
        }
      } else if (block.language == "text") {
        for (std::string line; std::getline(lines, line);)
          EXPECT_TRUE(printed(all, line)) << where << ": not printed: " << line << "\nbut\n" << all;
      }
    }
    EXPECT_GT(n_commands, 1);
  }
};

}  // namespace tutorial
