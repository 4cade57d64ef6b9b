#include "tooling/library/formats/item/losses.h"

#include <gmock/gmock.h>

namespace capstan::tooling {
namespace {

using ::testing::ElementsAre;

constexpr const char* kNoParameter = "the shape has no parameter for it";
constexpr const char* kNoPlace = "of another format, no place for it";

TEST(Losses, WhatManyToolsLoseForOneReasonIsOneLine) {
  std::vector<LossReport::Line> lines;
  for (const char* tool : {"a", "b", "c"})
    for (const char* field : {"LPR", "HAND"}) lines.push_back({tool, field, kNoParameter});
  EXPECT_THAT(lines_together(lines), ElementsAre("3 tools, LPR, HAND: the shape has no parameter for it"));
}

TEST(Losses, SymbolsComeBeforeThePathsOfTheOtherSystemAndItsBookkeepingLast) {
  const std::vector<LossReport::Line> lines{{"a", "presets.0.guid", kNoPlace},
                                            {"", "version", kNoPlace},
                                            {"", "fusion:read", kNoPlace},
                                            {"a", "reference_guid", kNoPlace},
                                            {"a", "post-process.length-offset", kNoPlace},
                                            {"a", "parameter/Crest", kNoPlace},
                                            {"", "holder", "no holders"},
                                            {"a", "LPR", kNoParameter}};
  EXPECT_THAT(
      lines_together(lines),
      ElementsAre("a, LPR: the shape has no parameter for it", "holder: no holders",
                  "a, post-process.length-offset, parameter/Crest: of another format, no place for it",
                  "a, presets.0.guid, reference_guid: of another format, no place for it",
                  "version, fusion:read: of another format, no place for it"));
}

TEST(Losses, FieldsOfOtherToolsAreNotCountedAmongThem) {
  const std::vector<LossReport::Line> lines{
      {"a", "LPR", kNoParameter}, {"b", "LPR", kNoParameter}, {"b", "HAND", kNoParameter}};
  EXPECT_THAT(lines_together(lines), ElementsAre("2 tools, LPR: the shape has no parameter for it",
                                                 "b, HAND: the shape has no parameter for it"));
}

TEST(Losses, ManyFieldsAreCountedAndOneMoreIsNamed) {
  std::vector<LossReport::Line> lines;
  for (int n = 0; n < 7; ++n) lines.push_back({"a", "f" + std::to_string(n), kNoPlace});
  EXPECT_THAT(lines_together(lines),
              ElementsAre("a, f0, f1, f2, f3, f4, f5, f6: of another format, no place for it"));
  lines.push_back({"a", "f7", kNoPlace});
  EXPECT_THAT(lines_together(lines),
              ElementsAre("a, f0, f1, f2, f3, f4, f5 and 2 more: of another format, no place for it"));
}

}  // namespace
}  // namespace capstan::tooling
