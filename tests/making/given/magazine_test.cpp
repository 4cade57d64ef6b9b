#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "planner/making/given/magazine.h"
#include "tooling/library/library.h"

namespace capstan::given {
namespace {

using model::Cutter;

Cutter planned() {
  Cutter c;
  c.id = "END MILL 10";
  c.cutter_class = model::CutterClass::kEndmill;
  c.substrate = model::Substrate::kCarbide;
  c.cutting_diameter_mm = 10.0;
  c.teeth = 3;
  c.centre_cutting = true;
  c.maximum_depth_of_cut_mm = 22.0;
  c.usable_length_mm = 30.0;
  c.stick_out_mm = 32.0;
  c.functional_length_mm = 102.0;
  c.shank_diameter_mm = 10.0;
  c.maximum_ramp_angle_rad = 0.1;
  return c;
}

Cutter in_pocket_1(Cutter c) {
  c.id = "crib 7";
  c.loaded = true;
  c.pocket = 1;
  return c;
}

TEST(LoadedTool, OfTheSameSizesIsThePlannedOne) {
  EXPECT_NE(loaded_like({in_pocket_1(planned())}, planned()), nullptr);
}

TEST(LoadedTool, ThatDoesLessThanThePlannedOneIsAnother) {
  const std::vector<std::pair<const char*, std::function<void(Cutter&)>>> faults = {
      {"substrate", [](Cutter& c) { c.substrate = model::Substrate::kHss; }},
      {"teeth", [](Cutter& c) { c.teeth = 1; }},
      {"centre", [](Cutter& c) { c.centre_cutting = false; }},
      {"flutes", [](Cutter& c) { c.maximum_depth_of_cut_mm = 3.0; }},
      {"reach", [](Cutter& c) { c.usable_length_mm = 10.0; }},
      {"stick-out", [](Cutter& c) { c.stick_out_mm = 60.0; }},
      {"shank", [](Cutter& c) { c.shank_diameter_mm = 20.0; }},
      {"ramp", [](Cutter& c) { c.maximum_ramp_angle_rad = 0.02; }},
      {"speed", [](Cutter& c) { c.maximum_speed_rpm = 300.0; }},
      {"life", [](Cutter& c) { c.life_min = 15.0, c.life_used_min = 99.0; }},
  };
  for (const auto& [name, worsen] : faults) {
    Cutter loaded = in_pocket_1(planned());
    worsen(loaded);
    EXPECT_EQ(loaded_like({loaded}, planned()), nullptr) << name;
    // What its library does not say, but a default, holds nothing against it.
    if (std::string_view(name) == "teeth") {
      loaded.sources.emplace_back("teeth", "as generic");
      EXPECT_NE(loaded_like({loaded}, planned()), nullptr);
    }
  }
}

TEST(LoadedTool, OfCarbideIsThePlannedOneWhereThePlanOnlyAssumesHss) {
  Cutter assumed = planned();
  assumed.substrate = model::Substrate::kHss;
  EXPECT_EQ(loaded_like({in_pocket_1(planned())}, assumed), nullptr);
  assumed.sources.emplace_back("substrate", "default: the slower of what it may be");
  EXPECT_NE(loaded_like({in_pocket_1(planned())}, assumed), nullptr);
}
TEST(LoadedTool, OfSeveralAlikeIsTheOneOfItsNameThenOfItsNumber) {
  Cutter first = in_pocket_1(planned()), own = in_pocket_1(planned()), third = in_pocket_1(planned());
  first.id = "another";
  own.id = planned().id;
  own.pocket = 2;
  third.id = "a third";
  third.pocket = 3;
  const auto number = [&](const std::vector<Cutter>& magazine, const Cutter& wanted) {
    const Cutter* found = loaded_like(magazine, wanted);
    return found != nullptr ? found->pocket : 0;
  };
  EXPECT_EQ(number({first, own, third}, planned()), 2);
  Cutter renamed = planned();
  renamed.id = "nobody's";
  renamed.pocket = 3;
  EXPECT_EQ(number({first, own, third}, renamed), 3);
  renamed.pocket = 7;
  EXPECT_EQ(number({first, own, third}, renamed), 1);
}

/// As a line of a tool table with this comment is read.
Cutter of_table(const std::string& comment) {
  Job job;
  auto read = tooling::read_tool_table("T1 P1 Z+102 D+10 ;" + comment + "\n", "shop.tbl", job);
  Cutter out = read.value().front();
  if (!out.table_line) out.table_line = model::ToolTableLine{};
  return out;
}

TEST(LoadedTool, OfAToolTableIsHeldAgainstWhatItsCommentStates) {
  for (const char* same :
       {"end mill", "10 mm end mill", "carbide end mill, 3 flutes", "VHM Schaftfr\xC3\xA4ser Z3",
        "HM schaftfr\xC3\xA4ser dreischneidig", "end mill 3fl", "end mill, three flutes"})
    EXPECT_NE(loaded_like({of_table(same)}, planned()), nullptr) << same;
  for (const char* other :
       {"HSS end mill 2 flutes", "HSS end mill", "HSS-Co8 Schaftfr\xC3\xA4ser Z3",
        "carbide end mill 2 flutes", "high speed steel end mill", "Schaftfr\xC3\xA4ser HSSE",
        "Schaftfr\xC3\xA4ser zweischneidig", "Schaftfr\xC3\xA4ser 4 Schneiden", "end mill, 2fl",
        "end mill two flute", "end mill Z=4"})
    EXPECT_EQ(loaded_like({of_table(other)}, planned()), nullptr) << other;
}

TEST(LoadedTool, OfAToolTableIsKnownByItsSizesWhereItsCommentSaysNoMore) {
  Cutter loaded = in_pocket_1(planned());
  loaded.table_line = model::ToolTableLine{};
  loaded.stick_out_mm = 60.0;
  EXPECT_NE(loaded_like({loaded}, planned()), nullptr);
}

TEST(StatingMaterial, IsTheLoadedToolOfThatSizeThatStatesWhatItIsMadeOf) {
  Cutter wanted = planned();
  const auto loaded = [](model::Substrate s, int pocket, const char* source) {
    Cutter c = in_pocket_1(planned());
    c.substrate = s;
    c.pocket = pocket;
    c.sources = {{"substrate", source}};
    return c;
  };
  const Cutter hss = loaded(model::Substrate::kHss, 1, "stated"),
               carbide = loaded(model::Substrate::kCarbide, 2, "stated");
  EXPECT_EQ(stating_material({}, wanted), nullptr);
  EXPECT_EQ(stating_material({loaded(model::Substrate::kHss, 1, "default: the slower one")}, wanted),
            nullptr);
  const std::vector<Cutter> one{hss};
  EXPECT_EQ(stating_material(one, wanted), &one[0]);
  // Two of a size that differ tell nothing, unless one of them has the wanted one's name.
  std::vector<Cutter> two{hss, carbide};
  EXPECT_EQ(stating_material(two, wanted), nullptr);
  two[1].id = wanted.id;
  EXPECT_EQ(stating_material(two, wanted), &two[1]);
  wanted.cutting_diameter_mm = 12.0;
  EXPECT_EQ(stating_material(two, wanted), nullptr);
}

TEST(LoadedTool, HasSistersThatEqualItUnderOtherNumbers) {
  std::vector<Cutter> magazine;
  for (const int number : {9, 1, 4, 6}) {
    magazine.push_back(in_pocket_1(planned()));
    magazine.back().pocket = number;
  }
  magazine[2].cutting_diameter_mm = 9.9;  // T4 is worn
  magazine[3].loaded = false;             // T6 is on the shelf
  Cutter wanted = planned();
  wanted.pocket = 1;
  const auto sisters = sisters_of(magazine, wanted);
  ASSERT_EQ(sisters.size(), 1U);
  EXPECT_EQ(sisters[0]->pocket, 9);
  wanted.pocket = 3;
  ASSERT_EQ(sisters_of(magazine, wanted).size(), 2U);
  EXPECT_EQ(sisters_of(magazine, wanted)[0]->pocket, 1);
}

TEST(LoadedTool, ThatIsOutOfUseIsToldWithItsNumberAndWhy) {
  Cutter broken = in_pocket_1(planned());
  const std::vector<OutOfUse> gone = {{broken, "is broken"}};
  EXPECT_EQ(out_of_use(gone, planned()), "is T1, which is broken");
  Cutter other = planned();
  other.cutting_diameter_mm = 6.0;
  EXPECT_EQ(out_of_use(gone, other), std::nullopt);
  other.pocket = 1;
  EXPECT_EQ(out_of_use(gone, other), std::nullopt);
  // Wear that was told changed its size.
  other.cutting_diameter_mm = 10.1;
  EXPECT_EQ(out_of_use(gone, other), "is T1, which is broken");
}

}  // namespace
}  // namespace capstan::given
