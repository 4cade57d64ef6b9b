// Closed slots with round ends as cycle 253 of Heidenhain's control, which states no distance from pass to
// pass and goes in back and forth.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "planner/controls/gcode/moves/pocket_cycles.h"
#include "planner/controls/heidenhain/heidenhain.h"
#include "planner/controls/siemens/siemens.h"
#include "planner/proof/verify/program/readers.h"
#include "tests/door/service/pockets/pocket_parts.h"

namespace capstan::service {
namespace {

using namespace pocket_parts;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct Other {
  const char *from, *to, *code;
};

/// The text from the slot's definition on.
std::size_t slot_in(const std::string& text) {
  const std::size_t at = text.find("CYCL DEF 253 SLOT MILLING ~");
  EXPECT_NE(at, std::string::npos) << text;
  return at == std::string::npos ? 0 : at;
}

/// The first parameter of that name behind the definition, as it is written: "Q202=+2.7".
std::string q(const std::string& text, const std::string& name) {
  const std::size_t begin = text.find("\n  " + name + "=", slot_in(text)) + 3;
  return text.substr(begin, text.find(' ', begin) - begin);
}

/// The slot's figure alone as another.
std::string slot_with(const std::string& text, const std::string& own, const std::string& other) {
  const std::size_t at = slot_in(text);
  return text.substr(0, at) + with(text.substr(at), own, other);
}

/// The slot's cycle as the writer has it.
controls::gcode::PocketCycle cycle_of(const model::Plan& plan) {
  for (std::size_t n = 0; n < plan.steps.size(); ++n) {
    const auto c = controls::gcode::pocket_of(plan, n).cycle;
    if (c && c->slot) return *c;
  }
  ADD_FAILURE() << "no slot is a cycle";
  return {};
}

// 30 + 14 long, along Y, 8 deep, its middle at (103, 40).
TEST(SlotCycles, OfHeidenhainAreReadBackWithinWhatThePlanProves) {
  const model::Plan& plan = planned("heidenhain", closed_slot());
  const std::string text = program_of(plan), from = text.substr(slot_in(text));
  for (const char* line : {"Q215=+1 ;", "Q218=+44 ;SLOT LENGTH", "Q219=+14 ;SLOT WIDTH", "Q374=+90 ;",
                           "Q367=+0 ;", "Q201=-8.8 ;", "Q203=+0.8 ;", "Q204=+19.2 ;", "Q366=+1 ;"})
    EXPECT_THAT(from, HasSubstr(line));
  for (const char* other : {"Q220=", "Q224=", "Q370="})
    EXPECT_THAT(from.substr(0, from.find("CYCL CALL")), Not(HasSubstr(other)));
  EXPECT_THAT(text, HasSubstr("L X+103 Y+40 R0 FMAX\n"));
  EXPECT_THAT(text,
              HasSubstr("; the way in is the control's: prove it in the control's simulation before the "
                        "first cut\n"));
  EXPECT_THAT(against(text, plan, true), IsEmpty());
}

TEST(SlotCycles, OfHeidenhainAreFoundWhereAParameterIsAnother) {
  const model::Plan& plan = planned("heidenhain", closed_slot());
  const std::string text = program_of(plan);
  const std::string side = q(text, "Q368"), floor = q(text, "Q369"), level = q(text, "Q202"),
                    mill = q(text, "Q207"), plunge = q(text, "Q206"), climb = q(text, "Q351"),
                    other = climb == "Q351=+1" ? "Q351=-1" : "Q351=+1";
  for (const Other& o : std::vector<Other>{{"Q218=+44 ;", "Q218=+44.01 ;", "CHK-POCKET-CYCLE"},
                                           {"Q218=+44 ;", "Q218=+43.9 ;", "CHK-POCKET-CYCLE"},
                                           {"Q218=+44 ;", "Q218=+10 ;", "CHK-CYCLE"},
                                           {"Q218=+44 ;", "Q218=+14 ;", "CHK-CYCLE"},
                                           {"Q219=+14 ;", "Q219=+14.01 ;", "CHK-POCKET-CYCLE"},
                                           {"Q219=+14 ;", "Q219=+9 ;", "CHK-CYCLE"},
                                           {"Q219=+14 ;", "Q219=+24 ;", "CHK-POCKET-CYCLE"},
                                           {"Q374=+90 ;", "Q374=+90.1 ;", "CHK-POCKET-CYCLE"},
                                           {"Q374=+90 ;", "Q374=+0 ;", "CHK-POCKET-CYCLE"},
                                           {"Q374=", "Q224=", "CHK-UNVERIFIABLE"},
                                           {"Q367=+0 ;", "Q367=+1 ;", "CHK-UNVERIFIABLE"},
                                           {"Q215=+1 ;", "Q215=+0 ;", "CHK-UNVERIFIABLE"},
                                           {"Q366=+1 ;", "Q366=+0 ;", "CHK-UNVERIFIABLE"},
                                           {climb.c_str(), other.c_str(), "CHK-POCKET-CYCLE"},
                                           {"Q201=-8.8 ;", "Q201=-8.81 ;", "CHK-POCKET-CYCLE"},
                                           {"Q203=+0.8 ;", "Q203=+0.7 ;", "CHK-POCKET-CYCLE"},
                                           {"Q200=+0.2 ;", "Q200=+2 ;", "CHK-POCKET-CYCLE"},
                                           {"Q204=+19.2 ;", "Q204=+9.2 ;", "CHK-POCKET-CYCLE"},
                                           {side.c_str(), "Q368=+0.1", "CHK-POCKET-CYCLE"},
                                           {floor.c_str(), "Q369=+0", "CHK-POCKET-CYCLE"},
                                           {level.c_str(), "Q202=+8", "CHK-POCKET-CYCLE"},
                                           {mill.c_str(), "Q207=9000", "CHK-CYCLE-FEED"},
                                           {plunge.c_str(), "Q206=2500", "CHK-CYCLE-FEED"}})
    EXPECT_THAT(against(slot_with(text, o.from, o.to), plan), Contains(HasSubstr(o.code)))
        << o.to << " in place of " << o.from;
  // 1 and 2 mean the same.
  EXPECT_THAT(against(slot_with(text, "Q366=+1 ;", "Q366=+2 ;"), plan, true), IsEmpty());
  // Called beside its middle it is another slot.
  EXPECT_THAT(against(with(text, "L X+103 Y+40 R0 FMAX", "L X+103.01 Y+40 R0 FMAX"), plan),
              Contains(HasSubstr("CHK-")));
  // As steep as the table says.
  const std::size_t angle = text.find("; ANGLE of T2");
  ASSERT_NE(angle, std::string::npos);
  const std::string told = text.substr(angle, text.find('\n', angle) - angle);
  EXPECT_THAT(against(with(text, told, "; ANGLE of T2 in the tool table: 30 degrees at most"), plan),
              Contains(HasSubstr("goes in at a slope of ")));
}

// 253 states no distance between passes. Those along both walls are between.width - 10 - 2 x what is left
// apart: in a slot that is wider than the flat front reaches, or hardly longer than wide, it is no cycle for
// it.
TEST(SlotCycles, OfHeidenhainAreRectanglesWhereWhatLiesBetweenTheWallsMightStay) {
  controls::gcode::PocketCycle c = cycle_of(planned("heidenhain", closed_slot()));
  const auto text = [&] { return controls::heidenhain::kPockets.text(c).value_or("none"); };
  EXPECT_THAT(text(), HasSubstr("CYCL DEF 253"));
  c.width_mm = 10.0 + 2.0 * c.side_mm + c.flat_mm - 0.01;
  EXPECT_THAT(text(), HasSubstr("CYCL DEF 253"));
  c.width_mm += 0.02;
  EXPECT_THAT(text(), HasSubstr("CYCL DEF 251"));
  c.width_mm = 14.0;
  c.length_mm = 18.9;
  EXPECT_THAT(text(), HasSubstr("CYCL DEF 251"));
  c.length_mm = 44.0;
  c.slot = false;
  EXPECT_THAT(text(), HasSubstr("CYCL DEF 251"));
}

// A mill as wide as the slot has no room for a helix: POCKET3 and 251 have none of it, 253 goes back and
// forth.
TEST(SlotCycles, AsNarrowAsTheMillHaveNoHelixAndAreFor253Alone) {
  controls::gcode::PocketCycle c = cycle_of(planned("heidenhain", closed_slot()));
  c.helix_mm = c.turn_mm = 0.0;
  EXPECT_THAT(controls::heidenhain::kPockets.text(c).value_or("none"), HasSubstr("CYCL DEF 253"));
  EXPECT_FALSE(controls::siemens::kPockets.text(c));
  EXPECT_TRUE(std::isfinite(controls::gcode::estimated_s(c)));
  c.slot = false;
  EXPECT_FALSE(controls::heidenhain::kPockets.text(c));
}

// The path that is swept: down back and forth along the middle, no steeper than ANGLE, and at each level up
// to both walls: 22 - 5 and 7 - 5 mm less what is left.
TEST(SlotCycles, AreFollowedBackAndForthUpToTheirWalls) {
  const model::Plan& plan = planned("heidenhain", closed_slot());
  const controls::gcode::PocketCycle c = cycle_of(plan);
  const verify::Program p = verify::reader_of("heidenhain")->program(program_of(plan), plan.machine);
  int slot = -1;
  for (std::size_t i = 0; i < p.pockets.size(); ++i) {
    if (p.pockets[i].own_rings) slot = static_cast<int>(i);
  }
  ASSERT_GE(slot, 0);
  double along = 0.0, across = 0.0, lowest = 1e9, steepest = 0.0;
  for (const verify::Block& b : p.blocks) {
    if (b.pocket != slot || b.kind != verify::Block::Kind::kMove || b.move == model::MoveKind::kRapid)
      continue;
    along = std::max(along, std::abs(b.to.y - 40.0));
    across = std::max(across, std::abs(b.to.x - 103.0));
    lowest = std::min(lowest, b.to.z);
    const double run = std::hypot(b.to.x - b.from.x, b.to.y - b.from.y);
    if (b.to.z < b.from.z - 1e-9) steepest = std::max(steepest, (b.from.z - b.to.z) / run);
  }
  EXPECT_NEAR(along, 17.0 - c.side_mm, 1e-6);
  EXPECT_NEAR(across, 2.0 - c.side_mm, 1e-6);
  EXPECT_NEAR(lowest, -8.0 + c.bottom_mm, 1e-6);
  EXPECT_GT(steepest, 0.0);
  EXPECT_LE(steepest, c.slope + 1e-6);
}

}  // namespace
}  // namespace capstan::service
