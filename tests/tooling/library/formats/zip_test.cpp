#include "tooling/library/formats/zip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace capstan::tooling {
namespace {

using ::testing::HasSubstr;

constexpr const char* kNone = "libcapstan_has_none.so.1";

TEST(Zip, SaysWhatToInstallWhereItsLibraryIsNotThere) {
  const auto packed = write_zip({{"tools.json", "{}"}});
  ASSERT_TRUE(packed) << to_text(packed.error());
  const auto read = read_zip(*packed, "mine.tools", nullptr, {}, kNone);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, "ZIP-LIBRARY");
  EXPECT_EQ(read.error().file, "mine.tools");
  EXPECT_THAT(read.error().message, HasSubstr(kNone));
  EXPECT_THAT(read.error().hint, HasSubstr("libzip4"));
  const auto written = write_zip({{"tools.json", "{}"}}, kNone);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, "ZIP-LIBRARY");
  EXPECT_THAT(written.error().hint, HasSubstr("libzip4"));
  EXPECT_TRUE(read_zip(*packed, "mine.tools")) << "one that is missing hides none that is there";
}

TEST(Zip, SaysWhichFunctionALibraryOfItsNameLacks) {
  const auto written = write_zip({}, "libm.so.6");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, "ZIP-LIBRARY");
  EXPECT_THAT(written.error().message, HasSubstr("zip_"));
}

}  // namespace
}  // namespace capstan::tooling
