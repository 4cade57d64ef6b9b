#include <gtest/gtest.h>

#include <random>

#include "tests/support/corpus.h"
#include "tooling/library/formats/all.h"

// Damaged files of tools: each reads or gets an error, none brings the reader down.

namespace capstan::tooling {
namespace {

struct Sample {
  const char* path;
  const Format& (*format)();
  int times;
};
void PrintTo(const Sample& s, std::ostream* os) { *os << s.path; }

std::string damaged(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const std::size_t at = below(bytes.size()), n = 1 + below(40);
  switch (below(5)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 1:
      bytes.resize(at);
      break;
    case 2:
      bytes.erase(at, n);
      break;
    case 3:
      bytes.insert(below(bytes.size()), bytes.substr(at, n));
      break;
    default:
      bytes.insert(at, std::string(n, "<>\"{}()#;,'&-9"[below(14)]));
      break;
  }
  return bytes;
}

class Damaged : public ::testing::TestWithParam<Sample> {};
TEST_P(Damaged, FilesReadOrGetAnErrorSoon) {
  CAPSTAN_CORPUS_FILE(path, GetParam().path);
  const std::string whole = capstan::testing::slurp(path);
  std::mt19937 random(4000);
  for (int i = 0; i < GetParam().times; ++i) {
    std::string bytes = whole;
    for (int k = 0; k <= i % 3 && !bytes.empty(); ++k) bytes = damaged(std::move(bytes), random);
    Job job;
    const auto r = GetParam().format().read(bytes, path, {}, job);
    if (r) continue;
    EXPECT_FALSE(r.error().code.empty());
    EXPECT_FALSE(r.error().message.empty());
  }
}
INSTANTIATE_TEST_SUITE_P(Formats, Damaged,
                         ::testing::Values(Sample{"tools/iso13399/iso13399.p21", iso13399_format, 400},
                                           Sample{"tools/iso13399/din4000-82.csv", din4000_format, 400},
                                           Sample{"tools/din4000/B720111000.xml", din4000_format, 400},
                                           Sample{"tools/din4000/EN_1000.xml", family_format, 15},
                                           Sample{"tools/iso13399/hypermill.xml", hypermill_format, 400},
                                           Sample{"tools/iso13399/solidcam.xml", solidcam_format, 400},
                                           Sample{"tools/freecad/Bit/375-16_Tap.fctb", freecad_format, 400},
                                           Sample{"tools/freecad/Library/Default.fctl", freecad_format,
                                                  100}));

}  // namespace
}  // namespace capstan::tooling
