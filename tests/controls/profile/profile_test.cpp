#include "planner/controls/profile/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "planner/controls/controls.h"
#include "planner/ground/base/nearest_names.h"
#include "tests/support/corpus.h"

namespace capstan::controls {
namespace {

using ::testing::HasSubstr;

Result<Profile> read(const std::string& text) {
  Job job;
  return read_profile(text, "own.yaml", job);
}

TEST(Profile, EveryIdOfTheTableIsRead) {
  const auto ids = profile_ids();
  EXPECT_GE(ids.size(), 4U);
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
  for (const std::string& id : ids) {
    Job job;
    const auto p = load_profile(id, job);
    ASSERT_TRUE(p) << to_text(p.error());
    EXPECT_EQ(p->id, id);
    EXPECT_GT(p->can.look_ahead_moves, 0U) << id;
  }
}

TEST(Profile, OfAControlThatHasProgramsIsThatOfItsRow) {
  Job job;
  for (const Dialect* d : dialects()) {
    const auto p = load_profile(std::string(d->id), job);
    ASSERT_TRUE(p);
    EXPECT_EQ(p->can.largest_tool_number, d->conformance.largest_tool_number);
  }
}

TEST(Profile, OfAShopIsReadFromItsFile) {
  const testing::ScratchFolder folder;
  const std::string path = folder.file("old_mill.yaml");
  std::ofstream(path)
      << "id: old_mill\nname: Old mill\nsource: \"measured 2026-11\"\nhelices: no\naxes: 2\n"
         "block_time_s: 0.02\nlook_ahead_moves: {value: 1, source: \"its manual, page 12\"}\n";
  Job job;
  const auto p = load_profile(path, job);
  ASSERT_TRUE(p) << to_text(p.error());
  EXPECT_FALSE(p->can.helices);
  EXPECT_TRUE(p->can.arcs);
  EXPECT_EQ(p->can.axes, 2);
  EXPECT_EQ(p->can.block_time_s, 0.02);
  EXPECT_EQ(p->can.look_ahead_moves, 1U);
}

TEST(Profile, SaysWithFileAndLineWhatIsWrong) {
  const std::string head = "id: a\nname: A\nsource: \"s\"\n";
  const std::pair<std::string, const char*> wrong[] = {
      {head + "axis: 3\n", "axis"},
      {head + "axes: 12\n", "axes is 12"},
      {head + "axes: 2.5\n", "axes"},
      {head + "arcs: perhaps\n", "arcs"},
      {head + "block_time_s: -1\n", "block_time_s is -1"},
      {head + "look_ahead_moves: many\n", "look_ahead_moves"},
      {head + "axes: 3\naxes: 4\n", "axes"},
      {"id: a\nname: A\naxes: 3\n", "nothing says where the figure is from"},
      {"id: a\n", "name"},
      {"- a list\n", ""},
      {"\xff\xfe", ""},
      {"", ""},
  };
  for (const auto& [text, what] : wrong) {
    const auto p = read(text);
    ASSERT_FALSE(p) << text;
    EXPECT_EQ(p.error().file, "own.yaml") << text;
    EXPECT_THAT(to_text(p.error()), HasSubstr(what)) << text;
  }
}

TEST(Profile, AnIdThatNobodyKnowsIsRefusedWithTheNearest) {
  Job job;
  const auto p = load_profile("linuxnc", job);
  ASSERT_FALSE(p);
  EXPECT_EQ(p.error().code, kUnknownName);
  EXPECT_THAT(to_text(p.error()), HasSubstr("linuxcnc"));
  EXPECT_FALSE(load_profile("no/such/file.yaml", job));
}

}  // namespace
}  // namespace capstan::controls
