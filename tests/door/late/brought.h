#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "planner/controls/linuxcnc/linuxcnc.h"
#include "tests/support/corpus.h"
#include "tests/support/scratch.h"
#include "tests/support/shop.h"

/// Plans as they come to a machine, and the tool tables there.
namespace capstan::late {

inline const std::string kPlate = testing::source_dir() + "/examples/plate_bound.p21";
inline const std::string kMagazine = testing::source_dir() + "/tests/door/late/magazine.tbl";
inline const std::string kOneTool = testing::source_dir() + "/tests/door/late/one_tool.tbl";

inline pipeline::Inputs shop(const std::string& tools, const std::string& machine = {}) {
  Job job;
  auto in = pipeline::load_shop({.machine = machine, .tools = tools, .rules = {}, .material = {}}, job);
  EXPECT_TRUE(in) << (in ? "" : to_text(in.error()));
  return in ? *std::move(in) : pipeline::Inputs{};
}

/// A shop whose tool table has this text.
inline pipeline::Inputs shop_of(const std::string& table, const std::string& machine = {}) {
  const std::string path = capstan::testing::scratch_file("late_table.tbl");
  std::ofstream(path) << table;
  return shop(path, machine);
}

inline double machining_s(const model::Plan& plan) {
  double out = 0.0;
  for (const auto& s : plan.steps) out += s.cutting_s + s.rapid_s;
  return out;
}

/// Number of a plan's tool of this class and so many mm; 0: it has none.
inline int tool_number(const model::Plan& plan, model::CutterClass cutter_class, double diameter_mm) {
  for (const model::Cutter& c : plan.cutters)
    if (c.cutter_class == cutter_class && c.cutting_diameter_mm == diameter_mm) return c.pocket;
  return 0;
}

/// The 8 mm end mill of the bracket's plan, which finishes its slot.
inline int eight_mill(const model::Plan& bracket) {
  const int out = tool_number(bracket, model::CutterClass::kEndmill, 8.0);
  EXPECT_NE(out, 0);
  return out;
}

/// The plan of the plate, its tools and feeds open.
inline model::Plan plate() {
  Job job;
  auto plan = pipeline::read_plan(testing::slurp(kPlate), kPlate, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? *std::move(plan) : model::Plan{};
}

/// A plan with all its paths, as it comes to a machine, and the tool table that it was made for.
struct Brought {
  model::Plan plan;
  std::string table;
  double machining_s = 0.0;
};
/// How many tools its table has.
inline int tools(const Brought& b) {
  return static_cast<int>(std::count(b.table.begin(), b.table.end(), '\n'));
}
inline Brought brought(const std::string& part, pipeline::Format format) {
  Job job;
  pipeline::Inputs in = shop({});
  auto read = pipeline::read_plan(testing::slurp(part), part, job);
  EXPECT_TRUE(read) << to_text(read.error());
  auto planned = read ? pipeline::bind(*std::move(read), in, {}, job) : Result<model::Plan>();
  EXPECT_TRUE(planned) << to_text(planned.error());
  auto text = pipeline::write_plan(*planned, format, job);
  EXPECT_TRUE(text);
  auto again = pipeline::read_plan(*text, part, job);
  EXPECT_TRUE(again) << to_text(again.error());
  return {*std::move(again), controls::linuxcnc::write_tool_table(*planned), machining_s(*planned)};
}

inline std::string without(const std::string& table, int tool) {
  std::string out;
  std::istringstream lines(table);
  for (std::string one; std::getline(lines, one);)
    if (!one.starts_with("T" + std::to_string(tool) + " ")) out += one + "\n";
  return out;
}

/// The table with another length (`key` "Z") or diameter ("D") of one tool, by so many mm.
inline std::string with(std::string table, int tool, const std::string& key, double by_mm) {
  const auto at = table.find(key + "+", table.find("T" + std::to_string(tool) + " ")) + 2;
  const auto end = table.find(' ', at);
  return table.replace(at, end - at, std::to_string(std::stod(table.substr(at, end - at)) + by_mm));
}

}  // namespace capstan::late
