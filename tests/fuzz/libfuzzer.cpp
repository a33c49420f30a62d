// `fuzz READER [options of libFuzzer] FOLDER...`: one reader under libFuzzer (make fuzz). In the ordinary
// tests nothing calls what stands here.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "readers.hpp"

namespace {
const phy::fuzz::Reader* chosen = nullptr;
}

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string_view name = *argc > 1 ? (*argv)[1] : "";
  for (const phy::fuzz::Reader& reader : phy::fuzz::readers())
    if (name == reader.name) chosen = &reader;
  if (chosen == nullptr) {
    for (const phy::fuzz::Reader& reader : phy::fuzz::readers()) std::puts(reader.name);
    std::exit(name.empty() ? 0 : 2);
  }
  // libFuzzer takes the rest.
  (*argv)[1] = (*argv)[0];
  ++*argv, --*argc;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen->read({reinterpret_cast<const char*>(data), size});
  return 0;
}
