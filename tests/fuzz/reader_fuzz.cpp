#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/readers.h"

// One of the readers, by the name that the build gives.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const capstan::fuzz::Reader& reader = *capstan::fuzz::find_reader(CAPSTAN_READER);
  reader.read(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
