#include <random>

#include "planner/files/p21/print.h"
#include "planner/files/p21/read/parse.h"
#include "tests/files/p21/p21_helpers.h"

namespace capstan::p21::testing {
namespace {

/// What stands between the quotes, decoded.
std::string decoded(const std::string& raw) {
  const Outcome o = read(data_file(std::string("#1=A('").append(raw).append("');")));
  EXPECT_TRUE(o.file) << o.all();
  return o.file ? o.file->instance(0).parameters()[0].as_text() : std::string("?");
}

TEST(Text, DecodesWhatTheStandardWrites) {
  EXPECT_EQ(decoded("plain"), "plain");
  EXPECT_EQ(decoded("it''s"), "it's");
  EXPECT_EQ(decoded("a\\\\b"), "a\\b");
  EXPECT_EQ(decoded("\\\\X2\\\\"), "\\X2\\");
  EXPECT_EQ(decoded("\\X\\E9"), "\u00E9");
  EXPECT_EQ(decoded("\\X2\\00E920AC\\X0\\."), "\u00E9\u20AC.");
  EXPECT_EQ(decoded("\\X4\\0001F600\\X0\\"), "\U0001F600");
  EXPECT_EQ(decoded("\\X2\\D83DDE00\\X0\\"), "\U0001F600");
  EXPECT_EQ(decoded("\\X2\\\\X0\\"), "");
}

// ISO 8859-1 E9 is e acute, 8859-5 D0 is Cyrillic a, 8859-7 E1 Greek alpha; S subtracts 128.
TEST(Text, ShiftsIntoTheChosenPage) {
  EXPECT_EQ(decoded("\\S\\i"), "\u00E9");
  EXPECT_EQ(decoded("\\PE\\\\S\\P"), "\u0430");
  EXPECT_EQ(decoded("\\PG\\\\S\\a\\PA\\\\S\\i"), "\u03B1\u00E9");
  EXPECT_EQ(decoded("\\S\\''x"), "\u00A7x");  // the quote of S stands doubled
}

TEST(Text, KeepsWhatItOnlyWarnsOf) {
  EXPECT_EQ(decoded("C:\\temp\\"), "C:\\temp\\");
  EXPECT_EQ(decoded("caf\xE9"), "caf\u00E9");
  EXPECT_EQ(decoded("caf\xC3\xA9"), "caf\u00E9");
  EXPECT_EQ(decoded("a\r\nb"), "ab");
  EXPECT_EQ(decoded("a\\N\\b"), "ab");
}

TEST(Text, EncodesToPrintableAscii) {
  EXPECT_EQ(encode_text("it's \\"), "it''s \\\\");
  EXPECT_EQ(encode_text("\u00E9\u20ACx\U0001F600\u00E9"),
            "\\X2\\00E920AC\\X0\\x\\X4\\0001F600\\X0\\\\X2\\00E9\\X0\\");
  EXPECT_EQ(encode_text("\t"), "\\X\\09");
  EXPECT_THROW((void)encode_text("\xFF"), std::logic_error);
}

TEST(Text, AnyUnicodeComesBack) {
  std::mt19937_64 random(7);
  for (int run = 0; run < 2000; ++run) {
    std::string hex;
    for (std::size_t i = random() % 12 + 1; i > 0; --i) {
      // From the ASCII range as often as from all of Unicode, without the surrogates.
      std::uint32_t code = static_cast<std::uint32_t>(random() % (random() % 2 == 0 ? 0x80 : 0x110000));
      if (code >= 0xD800 && code < 0xE000) code = '\'';
      char buffer[9];
      std::snprintf(buffer, sizeof buffer, "%08X", code);
      hex += buffer;
    }
    const std::string text = decoded(std::string("\\X4\\").append(hex).append("\\X0\\"));
    EXPECT_EQ(decoded(encode_text(text)), text);
  }
}

TEST(Text, NeedsNoBufferWherePlain) {
  const File f = read_clean(data_file("#1=A('plain','it''s');"));
  std::string buffer = "untouched";
  EXPECT_EQ(f.instance(0).parameters()[0].as_text(buffer), "plain");
  EXPECT_EQ(buffer, "untouched");
  EXPECT_EQ(f.instance(0).parameters()[1].as_text(buffer), "it's");
  EXPECT_EQ(buffer, "it's");
}

}  // namespace
}  // namespace capstan::p21::testing
