#pragma once

#include <functional>

#include "planner/files/exchange/conformance/check.h"
#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/job.h"
#include "tests/files/exchange/ap238/support.h"

// Tools, workpieces and what goes with them, one attribute at a time.

namespace capstan::exchange::ap238 {

/// What the schema checker says against a file.
inline std::vector<std::string> faults(const std::string& bytes) {
  Job reading, checking;
  const auto file = p21::parse(bytes, "written.stpnc", {}, reading);
  EXPECT_TRUE(file.has_value());
  std::vector<std::string> out;
  if (!file) return out;
  check_schema(*file, checking);
  for (const auto& d : checking.diagnostics()) {
    if (d.severity != Severity::kError) continue;  // what is open is said as a warning
    out.push_back(to_text(d));
  }
  return out;
}

inline std::string length_of(const std::string& name, const std::string& value = "2.5") {
  return "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(" + value +
         "),#)REPRESENTATION_ITEM('" + name + "'));";
}

inline std::string angle_of(const std::string& name, const std::string& value = "0.5") {
  return "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(" + value +
         "),#)PLANE_ANGLE_MEASURE_WITH_UNIT()REPRESENTATION_ITEM('" + name + "'));";
}

inline std::string time_of(const std::string& name, const std::string& value) {
  return "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(TIME_MEASURE(" + value +
         "),#)REPRESENTATION_ITEM('" + name + "')TIME_MEASURE_WITH_UNIT());";
}

inline std::string word_of(const std::string& name, const std::string& text) {
  return "DESCRIPTIVE_REPRESENTATION_ITEM('" + name + "','" + text + "');";
}

inline std::string count_of(const std::string& name, const std::string& value) {
  return "MEASURE_REPRESENTATION_ITEM('" + name + "',COUNT_MEASURE(" + value + "),#);";
}

inline std::string number_of(const std::string& name, const std::string& value) {
  return "MEASURE_REPRESENTATION_ITEM('" + name + "',NUMERIC_MEASURE(" + value + "),#);";
}

inline model::Ref<model::CartesianPoint> point(model::Model& m, double x, double y, double z) {
  model::CartesianPoint p;
  p.coordinates = {.items = {x, y, z}, .given = true};
  return m.add(std::move(p));
}

inline model::Ref<model::Axis2Placement3d> placement(model::Model& m, double x, double y, double z) {
  model::Axis2Placement3d a;
  a.location = point(m, x, y, z);
  return m.add(std::move(a));
}

/// One thing a plan may have, and the instances that must stand for it.
struct Case {
  std::string what;
  std::function<void(Bench&)> give;
  std::vector<std::string> instances;
};

/// Writes, looks for the instances, compares with the schema, reads back.
inline void check(const Case& c) {
  SCOPED_TRACE(c.what);
  Bench bench;
  c.give(bench);
  const Written out = written(bench.plan);
  EXPECT_EQ(out.losses, std::vector<std::string>{});
  const auto lines = shapes(out.bytes);
  for (const auto& wanted : c.instances) {
    EXPECT_NE(std::find(lines.begin(), lines.end(), wanted), lines.end()) << "not written: " << wanted << "\n"
                                                                          << out.bytes;
  }
  EXPECT_EQ(faults(out.bytes), std::vector<std::string>{}) << out.bytes;
  std::vector<std::string> said;
  const model::Plan back = read_text(out.bytes, &said);
  for (const auto& s : said) {
    EXPECT_EQ(s.find("EXC-KEPT"), std::string::npos) << s << "\n" << out.bytes;
    EXPECT_EQ(s.find("EXC-UNREAD"), std::string::npos) << s << "\n" << out.bytes;
  }
  EXPECT_EQ(testing::ModelDifference(bench.plan, back, {.item_names = false, .left_out = {}}).text(), "")
      << out.bytes;
}

template <class Give>
Case workpiece_case(const std::string& what, Give give, std::vector<std::string> instances) {
  return {what,
          [=](Bench& b) {
            b.step(model::OptionalStop{});
            give(b.plan.model, b.plan.model.at<model::Workpiece>(b.workpiece));
          },
          std::move(instances)};
}

inline model::Ref<model::DateAndTime> moment(model::Model& m) {
  model::CalendarDate date;
  date.year_component = 2024;
  date.month_component = 2;
  date.day_component = 29;
  model::CoordinatedUniversalTimeOffset zone;
  zone.hour_offset = 5;
  zone.minute_offset = 30;
  zone.sense = model::AheadOrBehind::kAhead;
  model::LocalTime time;
  time.hour_component = 23;
  time.minute_component = 59;
  time.second_component = 7.5;
  time.zone = m.add(std::move(zone));
  model::DateAndTime out;
  out.date_component = m.add(std::move(date));
  out.time_component = m.add(std::move(time));
  return m.add(std::move(out));
}

inline model::Ref<model::Person> person(model::Model& m) {
  model::Person p;
  p.id = "4711";
  p.last_name = "Noether";
  p.first_name = "Emmy";
  p.middle_names = {.items = {"Amalie"}, .given = true};
  p.prefix_titles = {.items = {"Prof.", "Dr."}, .given = true};
  p.suffix_titles = {.items = {"ForMem"}, .given = true};
  return m.add(std::move(p));
}

inline model::Ref<model::Organization> organization(model::Model& m) {
  model::Organization o;
  o.its_id = "ORG";
  o.name = "Works";
  o.description = "where it is made";
  return m.add(std::move(o));
}

inline model::Ref<model::PersonAndOrganization> member(model::Model& m) {
  model::PersonAndOrganization p;
  p.its_person = person(m);
  p.its_organization = organization(m);
  return m.add(std::move(p));
}

}  // namespace capstan::exchange::ap238
