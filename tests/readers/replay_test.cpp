#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "planner/ground/base/file.h"
#include "tests/casebase/sample.h"
#include "tests/fuzz/readers.h"
#include "tests/support/corpus.h"

namespace capstan::fuzz {
namespace {

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15U + 88172645463325252U) {}
  std::size_t below(std::size_t n) {
    state_ ^= state_ << 13U;
    state_ ^= state_ >> 7U;
    state_ ^= state_ << 17U;
    return n == 0 ? 0 : static_cast<std::size_t>((state_ >> 11U) % n);
  }

 private:
  std::uint64_t state_;
};

/// One to four edits: a byte, a number by one that is hard to take, a piece moved, doubled, cut out, the end
/// cut off.
std::string edited(std::string s, Chance& c) {
  static const std::vector<std::string> kHard = {"1e-320",       "-1",   "0",   "1e300", "-1e300",
                                                 "999999999999", "1e-9", "nan", "inf",   "1e6",
                                                 "4294967296",   "-0",   "0.5", "\"\"",  "null"};
  const std::size_t edits = 1 + c.below(4);
  for (std::size_t i = 0; i < edits && !s.empty(); ++i) {
    const std::size_t at = c.below(s.size()), n = 1 + c.below(std::min<std::size_t>(s.size() - at, 40));
    switch (c.below(7)) {
      case 0:
        s[at] = static_cast<char>(c.below(256));
        break;
      case 1:
        s.erase(at, n);
        break;
      case 2:
        s.insert(c.below(s.size()), s.substr(at, n));
        break;
      case 3:
        if (c.below(4) == 0) s.resize(at);
        break;
      case 4:
        s.insert(at, 1, "{}[]()<>,:;'\"#%/*-.0eE\n\t "[c.below(26)]);
        break;
      default: {
        const std::size_t from = s.find_first_of("0123456789", at);
        if (from == std::string::npos) break;
        const std::size_t to = std::min(s.find_first_not_of("0123456789.eE+-", from), s.size());
        s.replace(from, to - from, kHard[c.below(kHard.size())]);
      }
    }
  }
  return s;
}

std::vector<std::string> seeds_of(const Reader& r) {
  std::vector<std::string> files, out;
  const std::string folder = capstan::testing::source_dir() + "/tests/fuzz/seeds/" + std::string(r.name);
  if (std::filesystem::exists(folder)) {
    for (const auto& e : std::filesystem::directory_iterator(folder)) files.push_back(e.path().string());
  }
  for (const std::string& s : r.seeds) {
    // Of the corpus beside the checkout, where it is there.
    if (s.rfind("corpus/", 0) != 0) {
      files.push_back(capstan::testing::source_dir() + "/" + s);
    } else if (!testing::corpus_folder().empty()) {
      files.push_back(testing::corpus_folder() + s.substr(6));
    }
  }
  std::sort(files.begin(), files.end());
  for (const std::string& f : files) out.push_back(testing::slurp(f));
  if (r.name == "cases") out.push_back(casebase::to_csv(std::vector{casebase::sample()}));
  return out;
}

/// CAPSTAN_FUZZ_INPUTS: how many edited seeds per reader; CAPSTAN_FUZZ_READER: of this one only.
std::size_t inputs() {
  const char* n = std::getenv("CAPSTAN_FUZZ_INPUTS");
  return n != nullptr ? static_cast<std::size_t>(std::atol(n)) : 40;
}

TEST(ReadersOfSeeds, TakeAnyBytesWithAnAnswer) {
  const char* only = std::getenv("CAPSTAN_FUZZ_READER");
  static auto seed = static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed());
  ++seed;
  std::size_t all = 0;
  for (const Reader& r : readers()) {
    if (only != nullptr && r.name != only) continue;
    const auto seeds = seeds_of(r);
    ASSERT_FALSE(seeds.empty()) << r.name;
    for (const std::string& s : seeds) r.read(s);
    for (std::size_t i = 0; i < inputs(); ++i) {
      Chance chance(seed * 1000003U + i);
      const std::string input = edited(seeds[chance.below(seeds.size())], chance);
      try {
        r.read(input);
      } catch (const std::exception& e) {
        const std::string file = ::testing::TempDir() + std::string(r.name) + ".input";
        (void)write_file(file, input);
        ADD_FAILURE() << r.name << ", input " << i << " of seed " << seed << ": " << e.what() << "; see "
                      << file;
      }
      ++all;
    }
  }
  RecordProperty("inputs", static_cast<int>(all));
}

}  // namespace
}  // namespace capstan::fuzz
