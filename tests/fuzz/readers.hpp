// Every reader of outside input, each as one small function of bytes: what libFuzzer drives (libfuzzer.cpp)
// and what the seeds go through in every run of the tests (seeds.test.cpp).
//
// The contract is the same for all: the bytes are read, or InputError or IoError is thrown and caught here.
// Anything else escapes, and is a finding: another exception, a sanitizer's report, an exit code 4, seconds
// for a small input. What was read and can be written is written, and must be read again to the same; if not,
// Finding is thrown.
//
// Not here: messages between MPI ranks (the program writes both ends).
#pragma once
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace phy::fuzz {

struct Finding : std::logic_error {
  using std::logic_error::logic_error;
};

struct Reader {
  const char* name;                      ///< also the folder of its seeds
  bool (*read)(std::string_view bytes);  ///< false: refused
};

/// The one list.
const std::vector<Reader>& readers();
inline void PrintTo(const Reader& reader, std::ostream* out) {
  *out << reader.name;
}  // for messages of tests

// Numbers and single texts.
bool read_quantity(std::string_view);
bool read_recipe(std::string_view);
bool read_readings(std::string_view);
bool read_discs(std::string_view);
bool read_series(std::string_view);
bool read_scene(std::string_view);
bool read_packing(std::string_view);
// Several files, each begun by a line "=== name".
bool read_workbook(std::string_view);
bool read_rock(std::string_view);
bool read_study(std::string_view);
bool read_regressions(std::string_view);
bool read_result(std::string_view);
bool read_variation(std::string_view);
bool read_store(std::string_view);
// The whole program, with words as its command line.
bool read_words(std::string_view);
bool read_report(std::string_view);

}  // namespace phy::fuzz
