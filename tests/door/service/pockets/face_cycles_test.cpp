// Faces as CYCLE71, whose path is the control's: what the text states bounds it, nothing may stand around it,
// and the check finds a text that states anything else.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/controls/gcode/moves/face_cycles.h"
#include "planner/controls/suitability.h"
#include "planner/proof/verify/program/readers.h"
#include "tests/door/service/pockets/pocket_parts.h"

namespace capstan::service {
namespace {

using namespace pocket_parts;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// The part's plan for Siemens in a vise, with cycles for pockets and faces; `limit`: of the tools.
const model::Plan& held(const std::string& part, const std::string& limit = "",
                        const std::string& workholding = "vise_125") {
  static std::map<std::string, model::Plan> plans;
  const std::string key = part + limit + workholding;
  if (!plans.contains(key)) {
    Request request;
    EXPECT_TRUE(set(request, "control", "siemens"));
    EXPECT_TRUE(set(request, "workholding", workholding));
    EXPECT_TRUE(limit.empty() || set(request, "limit", limit));
    Job job;
    const auto out = plan(request, {.name = "bracket.p21", .bytes = part}, job);
    EXPECT_TRUE(out) << (out ? "" : to_text(out.error().what));
    if (!out) return plans[key];
    plans[key] = out->plan;
    plans[key].machine.control_options = model::ControlOptions{{{"cycles", "pocket"}}};
  }
  return plans[key];
}

std::string why_not(const model::Plan& plan) {
  for (std::size_t n = 0; n < plan.steps.size(); ++n) {
    const auto face = controls::gcode::face_of(plan, n);
    if (face.cycle) return "a cycle";
    if (!face.why_not.empty()) return face.why_not;
  }
  return "no face";
}

/// The plan with a clamp of this height in that square of 10 mm.
model::Plan with_clamp(model::Plan plan, double x, double y, double top) {
  model::FixtureSolid clamp{
      .id = "clamp 9", .kind = "clamp", .outline = {}, .bottom_mm = -20.0, .top_mm = top};
  clamp.outline = {{x, y}, {x + 10.0, y}, {x + 10.0, y + 10.0}, {x, y + 10.0}};
  plan.setups[0].holding.solids.push_back(clamp);
  return plan;
}

// The bracket's top: 120 x 80, 1 mm of raw piece on it, its cutter 100 wide, which one stroke suffices. The
// rectangle is as wide as the cutter, 10 over the edges at Y 0 and 80.
TEST(FaceCycles, AreReadBackWithinWhatThePlanProves) {
  const model::Plan& plan = held(bracket());
  const std::string text = program_of(plan), call = call_in(text, "CYCLE71(");
  EXPECT_THAT(call, StartsWith("CYCLE71(20,1,5,0,0,-10,120,100,0,"));
  EXPECT_EQ(parameter(call, 10), "80");
  EXPECT_EQ(parameter(call, 12), "0");
  EXPECT_EQ(parameter(call, 14), "31");
  EXPECT_EQ(parameter(call, 15), "0");
  EXPECT_THAT(text,
              HasSubstr("\n;it counts with the radius that the control's tool list has for T1: 50 mm\n"));
  EXPECT_THAT(text, HasSubstr("\n;nothing may stand from X-"));
  EXPECT_THAT(text, HasSubstr(" s as planned, which tool life counts\n"));
  EXPECT_THAT(against(text, plan, true), IsEmpty());
}

// A mill of 20 mm takes several strokes, each within 80 % of its flat front.
TEST(FaceCycles, OfNarrowMillsHaveStrokesNoWiderThanTheirFront) {
  const model::Plan& plan = held(bracket(), "TOP*/tool.diameter<=20");
  const std::string text = program_of(plan), call = call_in(text, "CYCLE71(");
  const auto tool = controls::gcode::face_of(plan, 0).cycle;
  ASSERT_TRUE(tool);
  ASSERT_LE(tool->cutter_mm, 20.0);
  EXPECT_LE(tool->over_mm, 0.8 * tool->cutter_mm + 1e-9);
  EXPECT_THAT(against(text, plan, true), IsEmpty());
  const verify::Program p = verify::reader_of("siemens")->program(text, plan.machine);
  ASSERT_EQ(p.faces.size(), 1U);
  double lo = 1e9, hi = -1e9, low = 1e9;
  int strokes = 0;
  for (const verify::Block& b : p.blocks) {
    if (b.face < 0 || b.kind != verify::Block::Kind::kMove || b.move == model::MoveKind::kRapid) continue;
    low = std::min(low, b.to.z);
    EXPECT_GE(b.to.z, -1e-9);
    const bool stroke = std::abs(tool->along_y ? b.to.y - b.from.y : b.to.x - b.from.x) > 50.0;
    if (!stroke) continue;
    ++strokes;
    lo = std::min(lo, tool->along_y ? b.to.x : b.to.y);
    hi = std::max(hi, tool->along_y ? b.to.x : b.to.y);
  }
  // Both edges are milled over.
  const double wide = tool->along_y ? 120.0 : 80.0, radius = 0.5 * tool->cutter_mm;
  EXPECT_LT(lo - radius, 0.0);
  EXPECT_GT(hi + radius, wide);
  EXPECT_GE(strokes, static_cast<int>(std::floor(wide / tool->cutter_mm)));
  EXPECT_NEAR(low, 0.0, 1e-9);
}

struct Fault {
  std::size_t parameter;
  const char *value, *code;
};

TEST(FaceCycles, AreFoundWhereAParameterIsAnother) {
  const model::Plan& plan = held(bracket());
  const std::string text = program_of(plan), call = call_in(text, "CYCLE71(");
  for (const Fault& f : std::vector<Fault>{
           {0, "15", "CHK-FACE-CYCLE"},    {0, "0.5", "CHK-CYCLE"},        {1, "0.9", "CHK-FACE-CYCLE"},
           {1, "2", "CHK-FACE-CYCLE"},     {2, "1", "CHK-FACE-CYCLE"},     {2, "", "CHK-CYCLE"},
           {3, "-0.01", "CHK-FACE-CYCLE"}, {3, "0.1", "CHK-FACE-CYCLE"},   {3, "1.5", "CHK-CYCLE"},
           {4, "0.1", "CHK-FACE-CYCLE"},   {5, "0.1", "CHK-FACE-CYCLE"},   {6, "119.9", "CHK-FACE-CYCLE"},
           {6, "-120", "CHK-FACE-CYCLE"},  {7, "99", "CHK-CYCLE"},         {7, "-100", "CHK-FACE-CYCLE"},
           {8, "10", "CHK-UNVERIFIABLE"},  {9, "2", "CHK-FACE-CYCLE"},     {9, "0", "CHK-CYCLE"},
           {10, "101", "CHK-FACE-CYCLE"},  {10, "-8", "CHK-CYCLE"},        {11, "0.5", "CHK-FACE-CYCLE"},
           {11, "0", "CHK-FACE-CYCLE"},    {12, "0.1", "CHK-FACE-CYCLE"},  {13, "9000", "CHK-CYCLE-FEED"},
           {13, "0", "CHK-CYCLE"},         {14, "11", "CHK-UNVERIFIABLE"}, {14, "32", "CHK-UNVERIFIABLE"},
           {15, "-1", "CHK-CYCLE"},        {3, "R1", "CHK-UNVERIFIABLE"}}) {
    const std::string spoilt = with(text, call, with_parameter(call, f.parameter, f.value));
    EXPECT_THAT(against(spoilt, plan), Contains(HasSubstr(f.code)))
        << f.parameter << " as " << f.value << " in place of " << parameter(call, f.parameter);
  }
  EXPECT_THAT(against(with(text, call, call + "\n" + call), plan), Not(IsEmpty()));
  EXPECT_THAT(against(with(text, call, call + "\nG1 X50 Z-13"), plan), Not(IsEmpty()));
  EXPECT_THAT(against(with(text, call, "S9000\n" + call), plan), Not(IsEmpty()));
  EXPECT_THAT(against(with(text, call, "M9\n" + call), plan), Not(IsEmpty()));
  EXPECT_THAT(against(with(text, call, "MCALL " + call), plan), Contains(HasSubstr("CHK-UNVERIFIABLE")));
  EXPECT_THAT(against(with(text, call + "\n", ""), plan), Not(IsEmpty()));
}

// The cutter and its holder may come anywhere within two widths of the cutter of the face: what stands there
// is told by writer and check alike, whether the plan's own path meets it or not.
TEST(FaceCycles, AreMovesWhereAClampStandsBesideTheFaceAsHighAsItsFloor) {
  const model::Plan& plan = held(bracket());
  const std::string text = program_of(plan);
  const auto free = controls::gcode::face_of(plan, 0).cycle;
  ASSERT_TRUE(free);
  for (const auto& [x, y] : {std::pair{40.0, -40.0}, std::pair{40.0, free->free_hi.y - 1.0},
                             std::pair{free->free_lo.x - 9.0, 40.0}}) {
    const model::Plan clamped = with_clamp(plan, x, y, 3.0);
    EXPECT_THAT(why_not(clamped), HasSubstr("clamp 9 stands beside it")) << x << " " << y;
    EXPECT_THAT(program_of(clamped), HasSubstr(";no cycle of the control for this face: clamp 9 stands"));
    EXPECT_THAT(program_of(clamped), Not(HasSubstr("CYCLE71(")));
    EXPECT_THAT(against(text, clamped), Contains(HasSubstr("CHK-FACE-CYCLE"))) << x << " " << y;
  }
  // Farther away, or lower, it is in no way.
  EXPECT_EQ(why_not(with_clamp(plan, 40.0, free->free_hi.y + 1.0, 3.0)), "a cycle");
  EXPECT_EQ(why_not(with_clamp(plan, 40.0, -40.0, -15.0)), "a cycle");
}

TEST(FaceCycles, AreMovesWhereNobodyHasSaidWhatHoldsThePieceOrItReachesBeyondTheFace) {
  const model::Plan& plan = held(bracket());
  model::Plan loose = plan;
  loose.setups[0].holding = {};
  EXPECT_THAT(why_not(loose), HasSubstr("nobody has said what holds the piece"));
  EXPECT_THAT(against(program_of(plan), loose), Contains(HasSubstr("nobody has said what holds the piece")));
  model::Plan larger = plan;
  larger.stock.box.hi.x += 4.0;
  EXPECT_THAT(why_not(larger), HasSubstr("the raw piece reaches beyond it"));
  EXPECT_THAT(against(program_of(plan), larger), Contains(HasSubstr("CHK-FACE-CYCLE")));
  model::Plan unloaded = plan;
  unloaded.steps[0].loads.peak_force_n = 0.0;
  EXPECT_THAT(why_not(unloaded), HasSubstr("no feed keeps"));
  EXPECT_THAT(against(program_of(plan), unloaded), Contains(HasSubstr("states no largest force")));
}

// The note says once per face what the table must have, or why it stays moves; a control without such a cycle
// says that.
TEST(FaceCycles, AreToldByNotes) {
  const auto notes = [](const model::Plan& plan, const char* control) {
    std::vector<std::string> out;
    for (const auto& f : controls::suitability(plan, controls::find_dialect(control)->conformance)) {
      if (f.code == "FIT-FACE-CYCLE") out.push_back(f.message);
    }
    return out;
  };
  EXPECT_THAT(notes(held(bracket()), "siemens"), ::testing::ElementsAre(HasSubstr("R of T1 50 mm")));
  EXPECT_THAT(notes(planned("fanuc", bracket()), "fanuc"), Contains(HasSubstr("stays moves: ")));
  EXPECT_THAT(notes(planned("siemens", bracket()), "siemens"),
              ::testing::ElementsAre(HasSubstr("nobody has said what holds the piece")));
}

}  // namespace
}  // namespace capstan::service
