#include <cstdint>
#include <filesystem>

#include "tests/files/p21/p21_helpers.h"
#include "tests/support/corpus.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace capstan::p21::testing {
namespace {

int replay(const std::string& bytes) {
  return LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

// The fuzzed function aborts when a property does not hold.
TEST(FuzzSeeds, HoldTheFuzzedProperties) {
  std::size_t seeds = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(capstan::testing::source_dir() + "/tests/fuzz/seeds/p21")) {
    SCOPED_TRACE(entry.path().string());
    EXPECT_EQ(replay(::capstan::testing::slurp(entry.path().string())), 0);
    ++seeds;
  }
  EXPECT_GE(seeds, 5U);
}

}  // namespace
}  // namespace capstan::p21::testing
