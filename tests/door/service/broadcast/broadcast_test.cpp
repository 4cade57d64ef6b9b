#include "planner/door/service/broadcast/broadcast.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/model/nouns/all.h"
#include "tests/support/empty_plan.h"

namespace capstan::service {
namespace {

using namespace ::testing;
using Kind = ControlEvent::Kind;
using Json = nlohmann::json;

/// A plan of two workingsteps, A and B, in one workplan.
struct Cut {
  model::Plan plan = testing::empty_plan();
  model::Ref<model::Workplan> workplan;
  model::AnyRef a, b;

  Cut() {
    model::CutterPath path;
    path.start({0, 0, 0});
    path.line({10, 0, 0}, model::MoveRole::kCut);
    a = testing::add_step(plan, "A", "em18", path).step;
    b = testing::add_step(plan, "B", "tap_m6", path).step;
    workplan = plan.model.add<model::Workplan>({});
    auto& w = plan.model.at<model::Workplan>(workplan);
    w.its_id = "MAIN";
    w.its_elements.push_back(model::Ref<model::Executable>(a));
    w.its_elements.push_back(model::Ref<model::Executable>(b));
  }
  model::Executable& step(model::AnyRef at) { return plan.model.at<model::Executable>(at); }
  model::Ref<model::BroadcastContent> content(model::BroadcastContent c) { return plan.model.add(c); }
  template <class T>
  void within(model::AnyRef at, T broadcast) {
    step(at).its_broadcasts.push_back(model::Ref<model::Broadcast>(plan.model.add(broadcast)));
  }
};

model::BroadcastContent saying(const char* message) {
  model::BroadcastContent c;
  c.its_id = message;
  c.message = message;
  return c;
}
model::BroadcastContent measuring(std::vector<std::string> names) {
  model::BroadcastContent c;
  c.its_id = "c";
  c.cbm_measurements.given = true;
  c.cbm_measurements.items = std::move(names);
  return c;
}

std::vector<std::string> told(Broadcasts& all, Kind kind, const std::string& step, ControlEvent event = {}) {
  event.kind = kind;
  event.workingstep = step;
  const auto lines = all.tell(event);
  EXPECT_TRUE(lines) << to_text(lines.error());
  std::vector<std::string> out;
  if (lines)
    for (const auto& line : *lines) out.push_back(line.json);
  return out;
}
ControlEvent at(double x, double seconds = 0.0) {
  ControlEvent e;
  e.location_mm = geometry::Vec3{x, 0.0, 0.0};
  e.elapsed_s = seconds;
  return e;
}

TEST(Broadcasts, StartAndEndOfEachExecutableInTheOrderOfTheRun) {
  Cut r;
  r.plan.model.at<model::Workplan>(r.workplan).start_content = r.content(saying("plan begins"));
  r.plan.model.at<model::Workplan>(r.workplan).end_content = r.content(saying("plan ends"));
  r.step(r.a).start_content = r.content(saying("a begins"));
  r.step(r.a).end_content = r.content(saying("a ends"));
  r.step(r.b).start_content = r.content(saying("b begins"));
  Broadcasts all(r.plan);
  EXPECT_THAT(told(all, Kind::kStart, "A"), ElementsAre(HasSubstr("plan begins"), HasSubstr("a begins")));
  EXPECT_THAT(told(all, Kind::kEnd, "A"), ElementsAre(HasSubstr("a ends")));
  EXPECT_THAT(told(all, Kind::kStart, "B"), ElementsAre(HasSubstr("b begins")));
  EXPECT_THAT(told(all, Kind::kEnd, "B"), IsEmpty());
  const auto over = all.finish({});
  ASSERT_EQ(over.size(), 1U);
  EXPECT_THAT(over[0].json, HasSubstr("plan ends"));
}

TEST(Broadcasts, AContentThatAsksForNothingIsATimeStamp) {
  Cut r;
  r.step(r.a).start_content = r.content({});
  Broadcasts all(r.plan);
  ControlEvent e;
  e.time = "2026-11-25T12:00:00Z";
  e.measured = {{"spindle speed", "3000"}};
  EXPECT_THAT(told(all, Kind::kStart, "A", e), ElementsAre(R"({"time":"2026-11-25T12:00:00Z"})"));
}

TEST(Broadcasts, HaveTheNamedMeasurementsAndContextsAndNoOthers) {
  Cut r;
  auto c = measuring({"spindle speed", "axis"});
  c.program_contexts.given = true;
  c.program_contexts.items = {"workingstep", "tool", "workplans", "phase"};
  c.sequence = true;
  r.step(r.a).start_content = r.content(c);
  Broadcasts all(r.plan);
  ControlEvent e;
  e.time = "now";
  e.measured = {{"spindle speed", "2950.5"}, {"feedrate", "600"}};
  const auto lines = told(all, Kind::kStart, "A", e);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0],
            R"({"content":"c","measured":{"spindle speed":2950.5,"axis":null},"context":{"workingstep":"A",)"
            R"("tool":"T1 em18","workplans":["MAIN"],"phase":null},"sequence":1})");
}

TEST(Broadcasts, OnlyIfChangedIsSentOnlyIfWhatIsMeasuredChanged) {
  Cut r;
  auto c = measuring({"spindle speed"});
  c.only_if_changed = true;
  c.time = true;
  c.sequence = true;
  model::BroadcastTime every;
  every.broadcast_interval = 1.0;
  every.time_content = r.content(c);
  r.within(r.a, every);
  Broadcasts all(r.plan);
  told(all, Kind::kStart, "A", at(0, 0));
  const auto after = [&](double seconds, const char* speed) {
    ControlEvent e = at(0, seconds);
    e.measured = {{"spindle speed", speed}};
    e.time = std::to_string(seconds);
    return told(all, Kind::kAt, "A", e).size();
  };
  EXPECT_EQ(after(1, "3000"), 1U);
  EXPECT_EQ(after(2, "3000"), 0U);
  EXPECT_EQ(after(3, "2990"), 1U);
  EXPECT_EQ(after(4, "3000"), 1U);
}

TEST(Broadcasts, APointIsToldOnceWhenTheToolPassesIt) {
  Cut r;
  model::CartesianPoint p;
  p.coordinates.given = true;
  p.coordinates.items = {5.0, 0.005, 0.0};  // 5 um beside the way, which the control may round by 10
  model::BroadcastPoint point;
  point.broadcast_points.push_back(r.plan.model.add(p));
  point.point_content = r.content(saying("here"));
  r.within(r.a, point);
  Broadcasts all(r.plan);
  told(all, Kind::kStart, "A", at(0));
  EXPECT_THAT(told(all, Kind::kAt, "A", at(4)), IsEmpty());
  EXPECT_THAT(told(all, Kind::kAt, "A", at(6)), ElementsAre(HasSubstr("here")));  // between two samples
  EXPECT_THAT(told(all, Kind::kAt, "A", at(4)), IsEmpty());
  told(all, Kind::kEnd, "A");
  told(all, Kind::kStart, "A", at(5));  // run again
  EXPECT_THAT(told(all, Kind::kAt, "A", at(5)), ElementsAre(HasSubstr("here")));
}

TEST(Broadcasts, DistanceTimeAndCountComeRoundAgain) {
  Cut r;
  model::BroadcastDistance distance;
  distance.broadcast_distance = 2.0;
  distance.distance_content = r.content(saying("way"));
  model::BroadcastTime time;
  time.broadcast_interval = 0.5;
  time.time_content = r.content(saying("time"));
  model::BroadcastCount count;
  count.broadcast_count = 3;
  count.count_content = r.content(saying("count"));
  r.within(r.a, distance);
  r.within(r.b, time);
  r.within(r.b, count);
  Broadcasts all(r.plan);
  told(all, Kind::kStart, "A", at(0));
  std::size_t lines = 0;
  for (int i = 1; i <= 100; ++i) lines += told(all, Kind::kAt, "A", at(0.1 * i)).size();
  EXPECT_EQ(lines, 5U);  // 10 mm
  told(all, Kind::kStart, "B", at(0, 0));
  std::string said;
  for (int i = 1; i <= 6; ++i)
    for (const auto& line : told(all, Kind::kAt, "B", at(0, 0.25 * i)))
      said += Json::parse(line)["message"].get<std::string>()[0];
  EXPECT_EQ(said, "tcttc");  // times at events 2, 4 and 6, counts at 3 and 6
}

TEST(Broadcasts, OfAnOperationAreThoseOfItsWorkingstep) {
  Cut r;
  model::Broadcast b;
  b.start_content = r.content(saying("operation"));
  model::BottomAndSideRoughMilling mill;
  mill.its_broadcasts.push_back(r.plan.model.add(b));
  r.plan.model.at<model::MachiningWorkingstep>(r.a).its_operation = r.plan.model.add(mill);
  Broadcasts all(r.plan);
  EXPECT_THAT(told(all, Kind::kStart, "A"), ElementsAre(HasSubstr("operation")));
}

TEST(Broadcasts, SayWhichLineWaitsForAReply) {
  Cut r;
  auto c = saying("ready?");
  c.wait_for_reply = true;
  r.step(r.a).start_content = r.content(c);
  Broadcasts all(r.plan);
  ControlEvent e;
  e.kind = Kind::kStart;
  e.workingstep = "A";
  const auto lines = all.tell(e);
  ASSERT_TRUE(lines && lines->size() == 1);
  EXPECT_TRUE((*lines)[0].waits);
  EXPECT_EQ(Json::parse((*lines)[0].json)["reply_to"], 1);
}

TEST(Broadcasts, OfAPlanWithoutAnyAreTheDefaultsOrNone) {
  Cut r;
  Broadcasts none(r.plan);
  EXPECT_FALSE(none.any());
  EXPECT_THAT(told(none, Kind::kStart, "A"), IsEmpty());
  Broadcasts some(r.plan, DefaultContent{.start = true, .end = false, .measured = {"location"}});
  ControlEvent e;
  e.measured = {{"location", "[1,2,3]"}, {"axis", "1"}};
  const auto lines = told(some, Kind::kStart, "A", e);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(Json::parse(lines[0])["measured"], Json::parse(R"({"location":[1,2,3]})"));
  EXPECT_EQ(Json::parse(lines[0])["context"]["tool"], "T1 em18");
  EXPECT_THAT(told(some, Kind::kEnd, "A"), IsEmpty());
  // What a plan states goes before.
  r.step(r.a).end_content = r.content(saying("mine"));
  Broadcasts own(r.plan, DefaultContent{});
  EXPECT_THAT(told(own, Kind::kStart, "A"), IsEmpty());
}

TEST(Broadcasts, RefuseAStepThatIsNotThereOrHasNotBegun) {
  Cut r;
  Broadcasts all(r.plan);
  ControlEvent e;
  e.workingstep = "C";
  EXPECT_EQ(all.tell(e).error().code, "BROADCAST-STEP");
  e.workingstep = "A";
  EXPECT_EQ(all.tell(e).error().code, "BROADCAST-ORDER");
}

TEST(Broadcasts, GoOnWhereTheyWereAfterThePlanWasBoundFurther) {
  Cut r;
  auto c = measuring({"axis"});
  c.only_if_changed = true;
  c.sequence = true;
  r.step(r.a).start_content = r.content(c);
  r.step(r.a).end_content = r.step(r.a).start_content;
  r.step(r.b).start_content = r.step(r.a).start_content;
  Broadcasts first(r.plan);
  ControlEvent e;
  e.measured = {{"axis", "1"}};
  EXPECT_EQ(told(first, Kind::kStart, "A", e).size(), 1U);
  Broadcasts second(r.plan);
  second.take_over(first);
  EXPECT_THAT(told(second, Kind::kEnd, "A", e), IsEmpty());
  e.measured = {{"axis", "2"}};
  EXPECT_THAT(told(second, Kind::kStart, "B", e), ElementsAre(HasSubstr("\"sequence\":2")));
}

}  // namespace
}  // namespace capstan::service
