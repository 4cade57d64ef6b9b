#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "planner/files/exchange/iso14649/deviations.h"
#include "planner/files/exchange/iso14649/units.h"
#include "tests/files/exchange/support.h"

namespace capstan::exchange {
namespace {

using model::Binder;
using model::TypeId;
using testing::codes;
using ::testing::Contains;
using testing::drilled_plate;
using ::testing::HasSubstr;
using testing::ledger_picture;
using testing::part21;
using testing::picture;
using testing::read_text;

// A plate of which the planner bound speed, feed and order.
model::Plan bound_plan() {
  Job job;
  auto plan = read_text(part21(drilled_plate()), job);
  EXPECT_TRUE(plan);
  auto& m = plan->model;
  const auto technology = m.all(TypeId::kMillingTechnology)[0];
  const auto operation = m.all(TypeId::kDrilling)[0];
  const auto step = m.all(TypeId::kMachiningWorkingstep)[0];
  m.at<model::MillingTechnology>(technology).feedrate = 1234.567;  // no double of m/s makes exactly this
  m.at<model::MillingTechnology>(technology).spindle = -1000.0;
  plan->ledger.bind(technology, "feedrate", Binder::kOptimiser,
                    {"limit.spindle_torque", "it's the torque", "derived"}, {{operation, "its_tool"}},
                    {{"1500 mm/min", "torque of 12 Nm exceeds 10 Nm"}});
  plan->ledger.bind(technology, "spindle", Binder::kRule, {"hole.drill", "drill it", "handbook, 12.3"});
  plan->ledger.bind(operation, "its_tool", Binder::kToolSelection, {"tool.fit", "10 mm drill", "catalogue"});
  plan->ledger.find(operation, "its_tool")->pinned = true;
  plan->ledger.bind(operation, "cutter", Binder::kToolSelection, {"tool.fit", "10 mm drill", "catalogue"});
  plan->ledger.reopen({step, "its_effect"});
  m.at<model::Executable>(step).persistent_id = "7b1c";
  m.at<model::Executable>(step).enabled = false;
  plan->machine.id = "generic_vmc";
  plan->machine.description = "a machine with \xC3\xA4";
  plan->material.id = "mild_steel";
  plan->material.iso_group = "P";
  plan->material.kc11_n_mm2 = 1780.0;
  plan->stock.box = {{0, 0, -30}, {100, 120, 0}};
  plan->stock.source = "--stock";
  model::Cutter c;
  c.id = "D10";
  c.cutter_class = model::CutterClass::kTwistDrill;
  c.cutting_diameter_mm = 10.0;
  c.teeth = 2;
  c.pocket = 3;
  plan->cutters.push_back(c);
  plan->provenance.push_back({"machine", "generic_vmc", "built-in default"});
  model::StepResult s;
  s.step = model::Ref<model::Executable>(step);
  s.cutter_id = "D10";
  s.feed_mm_min = 1234.567;
  plan->steps.push_back(s);
  return *plan;
}

// A program that keeps the header and numbers the instances anew must not put one tap's pitch on another.
TEST(Records, ValuesInTheHeaderAreNotTakenByRenumberedInstances) {
  auto plan = bound_plan();
  const auto add = [&](const char* id, double pitch) {
    const auto tap = plan.model.add<model::Tap>();
    plan.model.at<model::Tap>(tap).thread_pitch = pitch;
    const auto tool = plan.model.add<model::MillingCuttingTool>();
    plan.model.at<model::MillingCuttingTool>(tool).its_id = id;
    plan.model.at<model::MillingCuttingTool>(tool).its_tool_body = tap;
    plan.kept.push_back(tool);
  };
  add("M6", 1.0);
  add("M6 fine", 0.75);
  Job job;
  const auto written = write_iso14649(plan, job);
  ASSERT_TRUE(written);
  std::string text = written->bytes;
  // The tools change places: each number is now that of the other's tool, and of the other's body.
  const auto place = [&](const std::string& id) { return text.find("'" + id + "'", text.find("DATA;")); };
  const auto one = place("M6"), other = place("M6 fine");
  ASSERT_NE(one, std::string::npos);
  ASSERT_NE(other, std::string::npos);
  ASSERT_LT(one, other);
  text.replace(other, 9, "'M6'");
  text.replace(one, 4, "'M6 fine'");

  const auto kept = read_text(written->bytes, job);
  ASSERT_TRUE(kept);
  for (const auto tap : kept->model.all(TypeId::kTap))
    EXPECT_TRUE(kept->model.get<model::Tap>(tap)->thread_pitch.has_value());
  Job after;
  const auto again = read_text(text, after);
  ASSERT_TRUE(again);
  ASSERT_EQ(again->model.all(TypeId::kTap).size(), 2U);
  for (const auto tap : again->model.all(TypeId::kTap))
    EXPECT_FALSE(again->model.get<model::Tap>(tap)->thread_pitch.has_value());
  for (const auto tap : again->model.all(TypeId::kTap)) {
    const std::string number = std::to_string(again->model.origin(tap).instance);
    EXPECT_THAT(codes(after), Contains("warning EXC-EDITED #" + number));
  }
}

TEST(Records, WhoBoundWhatSurvivesTheFile) {
  const auto plan = bound_plan();
  Job job;
  const auto written = write_iso14649(plan, job);
  ASSERT_TRUE(written);
  const auto again = read_text(written->bytes, job);
  ASSERT_TRUE(again) << to_text(again.error());
  EXPECT_EQ(ledger_picture(plan), ledger_picture(*again));
  EXPECT_EQ(again->machine.id, "generic_vmc");
  EXPECT_EQ(again->machine.description, plan.machine.description);
  EXPECT_EQ(again->material, plan.material);
  EXPECT_EQ(again->cutters, plan.cutters);
  EXPECT_EQ(again->provenance, plan.provenance);
  EXPECT_EQ(again->stock.box, plan.stock.box);
  ASSERT_EQ(again->steps.size(), 1U);
  EXPECT_EQ(again->steps[0].feed_mm_min, 1234.567);
  const auto step = again->model.all(TypeId::kMachiningWorkingstep)[0];
  EXPECT_EQ(again->model.at<model::Executable>(step).persistent_id, "7b1c");
  EXPECT_EQ(again->model.at<model::Executable>(step).enabled, false);
  EXPECT_TRUE(again->ledger.is_open(step, "its_effect"));
  const auto twice = write_iso14649(*again, job);
  ASSERT_TRUE(twice);
  EXPECT_EQ(written->bytes, twice->bytes);
}

TEST(Records, WhatCondemnsAPlanSurvivesEitherFile) {
  model::Plan plan = bound_plan();
  plan.steps[0].exceeded = {{"spindle_torque", 1.1125, 0.4775, "Nm", geometry::Vec3{12.5, 30.0, -3.0}},
                            {"peak_force", 7.0, 5.0, "N", std::nullopt}};
  plan.unplanned.push_back({plan.model.all(TypeId::kRoundHole)[0], "no drill", {"TAPPED", "it's CSK"}});
  Job job;
  for (const bool ap238 : {false, true}) {
    const auto written = ap238 ? write_ap238(plan, job) : write_iso14649(plan, job);
    ASSERT_TRUE(written) << to_text(written.error());
    const auto again = read_text(written->bytes, job);
    ASSERT_TRUE(again) << to_text(again.error());
    ASSERT_EQ(again->steps.size(), 1U) << ap238;
    EXPECT_EQ(again->steps[0].exceeded, plan.steps[0].exceeded) << ap238;
    ASSERT_EQ(again->unplanned.size(), 1U) << ap238;
    EXPECT_EQ(again->unplanned[0].needed_by, plan.unplanned[0].needed_by) << ap238;
  }
}

TEST(Records, EditedValueIsGivenAgain) {
  const auto plan = bound_plan();
  Job job;
  auto bytes = write_iso14649(plan, job)->bytes;
  // Somebody changes the drill's spindle speed from 1000 1/min to 960.
  const auto at = bytes.find(",-16.666666666666668,");
  ASSERT_NE(at, std::string::npos) << bytes;
  bytes.replace(at, 21, ",-16.,");
  Job second;
  const auto again = read_text(bytes, second);
  ASSERT_TRUE(again);
  const auto technology = again->model.all(TypeId::kMillingTechnology)[0];
  const auto* typed = again->ledger.find(technology, "spindle");
  ASSERT_NE(typed, nullptr);
  EXPECT_EQ(typed->binder, model::Binder::kGiven);
  EXPECT_EQ(typed->state, model::DecisionState::kBound);
  ASSERT_NE(again->ledger.find(technology, "feedrate"), nullptr);  // untouched, still the optimiser's
  EXPECT_THAT(testing::lines(second),
              Contains(HasSubstr("#45 MILLING_TECHNOLOGY.spindle was edited since it was bound by rule")));
}

TEST(Records, RecordsOfWhatIsGoneAreDropped) {
  Job job;
  const auto plan = read_text(part21(drilled_plate(), "!CAPSTAN_IDENTITY('#999','x');\n"), job);
  ASSERT_TRUE(plan);
  EXPECT_THAT(codes(job), Contains("note EXC-RECORD"));
}

TEST(Kept, VendorInstanceStaysConnectedThroughWritingAndNewNumbers) {
  Job job;
  auto plan = read_text(part21(drilled_plate({{26, "VENDOR_BOTTOM(#81,('it''s',#64),.X.,$,T(1.50))"}}) +
                               "#800=TURNING_WORKINGSTEP('t',#62,(#26,#999));\n"),
                        job);
  ASSERT_TRUE(plan);
  ASSERT_EQ(plan->kept.size(), 1U);
  const auto hole = plan->model.all(TypeId::kRoundHole)[0];
  EXPECT_TRUE(
      plan->model.holds<model::KeptInstance>(plan->model.at<model::RoundHole>(hole).bottom_condition));
  // The hole's placement gets another number: what refers to it must follow.
  const auto placement = plan->model.at<model::RoundHole>(hole).feature_placement;
  plan->model.set_origin(placement, {});
  const auto written = write_iso14649(*plan, job);
  ASSERT_TRUE(written);
  EXPECT_THAT(written->bytes, HasSubstr("#26=VENDOR_BOTTOM(#1000,('it''s',#64),.X.,$,T(1.50));"));
  EXPECT_THAT(written->bytes, HasSubstr("#800=TURNING_WORKINGSTEP('t',#62,(#26,#999));"));
  EXPECT_THAT(written->bytes, HasSubstr("#1000=AXIS2_PLACEMENT_3D("));
}

TEST(Kept, ComplexInstanceIsWrittenAsItWas) {
  Job job;
  const auto plan = read_text(
      part21(drilled_plate() + "#500=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"), job);
  ASSERT_TRUE(plan);
  const auto written = write_iso14649(*plan, job);
  ASSERT_TRUE(written);
  EXPECT_THAT(written->bytes, HasSubstr("#500=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));"));
}

// ISO 14649-111 has neither; AP238 has, and a plan of such a file is written in either form.
TEST(ToolBody, ThatOnlyAp238HasComesBackFromIso14649) {
  for (const auto& [keyword, type] : {std::pair("DRILLING_CUTTING_TOOL", TypeId::kGeneralDrill),
                                      std::pair("SPOTDRILL", TypeId::kSpotdrill)}) {
    SCOPED_TRACE(keyword);
    Job job, again;
    const auto plan =
        read_text(part21(drilled_plate({{31, std::string(keyword) + "(#32,2,.RIGHT.,.F.,$)"}})), job);
    ASSERT_TRUE(plan) << to_text(plan.error());
    ASSERT_EQ(plan->model.all(type).size(), 1U);
    const auto back = read_text(write_iso14649(*plan, job)->bytes, again);
    ASSERT_TRUE(back) << to_text(back.error());
    EXPECT_EQ(picture(*back), picture(*plan));
    for (const auto& line : codes(again)) EXPECT_EQ(line.find("EXC-KEPT"), std::string::npos) << line;
  }
}

TEST(Dialect, DraftFileIsWrittenAtThePublishedLevel) {
  Job job;
  const auto plan = read_text(part21(drilled_plate({{32, "TOOL_DIMENSION(10.,59.,$,45.,$,$,$)"},
                                                    {46, "CUTTING_COMPONENT(90.,$,$,$)"},
                                                    {62, "ELEMENTARY_SURFACE('SEC',#73)"}})),
                              job);
  ASSERT_TRUE(plan);
  EXPECT_THAT(codes(job), ::testing::ElementsAre("note EXC-DIALECT"));
  const auto written = write_iso14649(*plan, job);
  ASSERT_TRUE(written);
  EXPECT_THAT(written->bytes, HasSubstr("#32=MILLING_TOOL_DIMENSION(10.,59.,$,45.,$,$,$);"));
  EXPECT_THAT(written->bytes, HasSubstr("#46=CUTTING_COMPONENT(90.,$,$,$,$);"));
  EXPECT_THAT(written->bytes, HasSubstr("#62=PLANE('SEC',#73);"));
}

TEST(Losses, WhatIso14649CannotHoldIsSaid) {
  Job job;
  auto plan = bound_plan();
  auto& m = plan.model;
  model::ToolUsage usage;
  usage.its_id = "T3";
  const auto tool = m.all(TypeId::kMillingCuttingTool)[0];
  m.at<model::MachiningTool>(tool).its_usage = m.add(std::move(usage));
  const auto written = write_iso14649(plan, job);
  ASSERT_TRUE(written);
  EXPECT_THAT(
      written->losses,
      Contains("the .p21 form cannot store tool numbers (MILLING_CUTTING_TOOL.its_usage, in its header "
               "for Capstan alone); write .stpnc or .json"));
  EXPECT_THAT(written->losses, Contains(HasSubstr("enabled, in its header for Capstan alone")));
  EXPECT_THAT(written->bytes.substr(written->bytes.find("\nDATA;")), ::testing::Not(HasSubstr("TOOL_USAGE")));
  const auto back = read_bytes(written->bytes, "test.stp", ReadOptions{}, job);
  ASSERT_TRUE(back) << to_text(back.error());
  const auto usages = back->model.all(TypeId::kToolUsage);
  ASSERT_EQ(usages.size(), 1U);
  EXPECT_EQ(back->model.at<model::ToolUsage>(usages[0]).its_id, "T3");
  const auto again = back->model.all(TypeId::kMillingCuttingTool)[0];
  EXPECT_EQ(model::AnyRef(back->model.at<model::MachiningTool>(again).its_usage), usages[0]);
}

TEST(Units, FileNumberReadsBackToWhatWasWritten) {
  std::mt19937_64 random(20240713);
  std::uniform_real_distribution<double> exponent(-6.0, 6.0);
  for (int i = 0; i < 100000; ++i) {
    const double file = std::round(std::pow(10.0, exponent(random)) * 1e6) / 1e6;  // as files have them
    for (const auto unit :
         {model::Unit::kSpeed, model::Unit::kRotSpeed, model::Unit::kAngle, model::Unit::kLength}) {
      EXPECT_EQ(to_file(from_file(file, unit), unit), file) << file;
    }
    const double model = std::round(std::pow(10.0, exponent(random)) * 1e4) / 1e4;  // as planners choose them
    for (const auto unit : {model::Unit::kSpeed, model::Unit::kRotSpeed}) {
      EXPECT_EQ(from_file(to_file(model, unit), unit), model) << model;
    }
  }
}

// Random models: every kind of ISO 14649, every attribute set or not, references that fit.
TEST(RoundTrip, GeneratedModelsAreTheSameAfterBeingWrittenAndRead) {
  std::mt19937 random(4711);
  const auto pick = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  for (int round = 0; round < 20; ++round) {
    model::Plan plan;
    plan.file_name = "test.stp";
    auto& m = plan.model;
    std::vector<model::AnyRef> made;
    const auto target = [&](const model::Attribute& a) {
      std::vector<model::AnyRef> fit;
      for (const auto r : made) {
        for (const TypeId t : a.targets) {
          if (model::is_a(r.type, t)) fit.push_back(r);
        }
      }
      return fit.empty() ? model::AnyRef{} : fit[pick(fit.size())];
    };
    const auto real = [&] {
      return std::round(std::uniform_real_distribution<double>(0.01, 0.99)(random) * 1e4) / 1e4;
    };
    std::uint64_t n = 0;
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t t = 1; t < model::kTypeCount; ++t) {
        const auto type = static_cast<TypeId>(t);
        const auto& row = model::noun_type(type);
        // Workplans and projects are left out: a random order of steps may contain itself as a whole.
        const bool written = row.in_iso14649 || model::is_a(type, TypeId::kMillingToolBody);
        if (row.abstract || !written || type == TypeId::kKeptInstance || type == TypeId::kProject ||
            type == TypeId::kMillingTechnology || type == TypeId::kMillingToolDimension) {
          continue;
        }
        const auto at = m.add_object(type);
        m.set_origin(at, {++n, 0});
        for (const auto& a : row.attributes) {
          if (!a.in_iso14649 || (!a.required && pick(2) == 0)) continue;
          void* slot = a.at(m.object(at));
          switch (a.storage) {
            case model::Storage::kReal:
              *static_cast<model::Real*>(slot) =
                  a.unit == model::Unit::kAngle ? from_file(std::round(real() * 80.0) + 5.0, a.unit) : real();
              break;
            case model::Storage::kInteger:
              *static_cast<model::Integer*>(slot) = static_cast<std::int64_t>(1 + pick(5));
              break;
            case model::Storage::kBoolean:
              *static_cast<model::Boolean*>(slot) = pick(2) == 0;
              break;
            case model::Storage::kText:
              *static_cast<model::Text*>(slot) = std::string("t'\\\xC3\xA4") + std::to_string(pick(100));
              break;
            case model::Storage::kEnum:
              static_cast<model::AnyEnum*>(slot)->code = static_cast<std::int8_t>(pick(a.enumerators.size()));
              break;
            case model::Storage::kRef:
              *static_cast<model::AnyRef*>(slot) = target(a);
              break;
            case model::Storage::kRefList: {
              auto& list = *static_cast<model::AnyRefList*>(slot);
              list.given = true;
              for (std::size_t i = pick(4); i > 0; --i) {
                if (const auto r = target(a); r.set()) list.items.push_back(r);
              }
              break;
            }
            case model::Storage::kRealList: {
              auto& list = *static_cast<model::RealList*>(slot);
              list.given = true;
              list.items = {real(), real(), real()};
              break;
            }
            case model::Storage::kTextList: {
              auto& list = *static_cast<model::TextList*>(slot);
              list.given = true;
              list.items = {"a", ""};
              break;
            }
            default:
              break;  // selects and tables have tests of their own
          }
        }
        made.push_back(at);
      }
    }
    plan.kept = made;
    Job job;
    const auto written = write_iso14649(plan, job);
    ASSERT_TRUE(written);
    const auto again = read_text(written->bytes, job);
    ASSERT_TRUE(again) << to_text(again.error());
    const auto a = picture(plan), b = picture(*again);
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [key, text] : a) ASSERT_EQ(text, b.at(key)) << key << " in round " << round;
    EXPECT_EQ(write_iso14649(*again, job)->bytes, written->bytes);
  }
}

}  // namespace
}  // namespace capstan::exchange
