#include "planner/ground/base/shared_text.h"

#include <gtest/gtest.h>

#include <string>

namespace capstan {
namespace {

TEST(SharedText, CopiesReferToTheSameBytes) {
  const SharedText a = std::string(300, 'x');
  const SharedText b = a;  // NOLINT: the copy is what is tested
  EXPECT_EQ(&a.text(), &b.text());
  EXPECT_EQ(a, b);
}

TEST(SharedText, EqualsWhatSaysTheSame) {
  const SharedText a = "vc: default", other = "vc: stated";
  EXPECT_EQ(a, SharedText(std::string("vc: default")));
  EXPECT_EQ(a, "vc: default");
  EXPECT_EQ(a, std::string("vc: default"));
  EXPECT_FALSE(a == other);
  EXPECT_EQ(SharedText(), "");
  EXPECT_TRUE(SharedText("").empty());
}

TEST(SharedText, ReadsAsAString) {
  const std::string said = "vc: 1.7 x the material's; fz: default";
  const SharedText a = said;
  const std::string& whole = a;
  EXPECT_EQ(whole, said);
  EXPECT_TRUE(a.starts_with("vc: "));
  EXPECT_TRUE(a.ends_with("default"));
  EXPECT_EQ(a.find("; fz: "), said.find("; fz: "));
  EXPECT_EQ(a.find("no such"), std::string::npos);
}

TEST(SharedText, AnotherTextForOneLeavesTheOther) {
  SharedText a = "one";
  const SharedText b = a;
  a = "two";
  EXPECT_EQ(a, "two");
  EXPECT_EQ(b, "one");
}

}  // namespace
}  // namespace capstan
