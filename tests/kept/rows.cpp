#include "tests/kept/rows.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/files/json/json.h"
#include "planner/ground/base/file.h"
#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "planner/physics/engagement/engagement.h"
#include "tests/kept/case_pieces.h"
#include "tests/kept/wavy.h"

// Each piece runs in a process of its own: what a process keeps for its next call makes no row faster. Plans
// and checks are made by the command; the kernels of sections and of the drop-cutter, JSON, and the case base
// by this program (--piece).

namespace capstan::kept {
namespace {

void wanted(bool ok, const char* what) {
  if (!ok) throw std::runtime_error(what);
}

/// Zigzag passes of a 10 mm end mill 4 mm apart and 2 mm deep, at 27 degrees to the cells of 0.1 mm.
void sections() {
  model::Cutter c;
  c.cutter_class = model::CutterClass::kEndmill;
  c.cutting_diameter_mm = 10.0;
  c.maximum_depth_of_cut_mm = 20.0;
  constexpr double kSkew = 27.0 * std::numbers::pi / 180.0;
  const auto at = [&](double s, double left, double z) {
    return geometry::Vec3{20.0 + s * std::cos(kSkew) - left * std::sin(kSkew),
                          8.0 + s * std::sin(kSkew) + left * std::cos(kSkew), z};
  };
  model::CutterPath p;
  p.start(at(0.0, 0.0, 5.0));
  p.line(at(0.0, 0.0, -2.0), model::MoveRole::kPlunge);
  for (int k = 0; k < 8; ++k) {
    p.line(at(k % 2 == 0 ? 60.0 : 0.0, 4.0 * k, -2.0), model::MoveRole::kCut);
    p.line(at(k % 2 == 0 ? 60.0 : 0.0, 4.0 * (k + 1), -2.0), model::MoveRole::kLink);
  }
  for (int k = 0; k < 4; ++k) {
    auto map = stock::from_box({{0, 0, -10}, {100, 80, 0}}, 0.1);
    const auto m = engagement::measure(p, c, map, {.step_mm = 0.25});
    wanted(m && m->removed_mm3 > 0.0, "the sections are wrong");
  }
}

/// A ball of 6 mm dropped on the surface at places 0.5 mm apart, row by row.
void drops() {
  constexpr int kPlaces = 200;
  const toolpath::freeform::DropCutter cutter(capstan::testing::wavy(100));
  std::vector<geometry::Vec2> points;
  for (int j = 0; j < kPlaces; ++j) {
    for (int i = 0; i < kPlaces; ++i)
      points.push_back({100.0 * (j % 2 == 0 ? i : kPlaces - 1 - i) / kPlaces, 100.0 * j / kPlaces});
  }
  const Job job;
  const auto z = cutter.drop(toolpath::freeform::Toroid{0.0, 3.0}, points, 0.0, job);
  wanted(z.size() == points.size() && z.front() > -6.0, "the drops are wrong");
}

void json_both_ways(const std::string& file) {
  const auto text = read_file(file);
  if (!text) throw std::runtime_error(text.error().message);
  Job job;
  const auto plan = json::read_json(*text, "plan.json", job);
  wanted(plan.has_value() && json::write_json(*plan) == *text, "the plan's JSON is not what it was");
}

}  // namespace

void piece(const std::string& name, const std::string& file) {
  if (name == "sections") return sections();
  if (name == "drop-cutter") return drops();
  if (name == "json") return json_both_ways(file);
  if (case_piece(name, file)) return;
  throw std::runtime_error("there is no piece of work " + name);
}

std::vector<Row> rows(const std::string& capstan, const std::string& own, const std::string& examples,
                      const std::string& scratch, bool smoke) {
  const auto command = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), capstan);
    return arguments;
  };
  const std::string pocket = examples + "/reference_pocket";
  const std::string plan = scratch + "/bracket.json", program = scratch + "/bracket.ngc";
  const std::vector<std::string> whole = {"plan", examples + "/bracket.p21", "-o", plan, "-o", program};
  (void)taken_by(command(whole));  // what the check and JSON read is there before
  std::vector<Row> out;
  // Shop, rules and tools, and a part of one pocket that is left open.
  out.push_back(
      {"start-up", command({"plan", pocket + ".p21", "--bind", "none", "-o", scratch + "/open.json"})});
  if (!smoke) out.push_back({"plan-bracket", command(whole)});
  out.push_back(
      {"plan-reference-pocket",
       command({"plan", pocket + ".p21", "--tools", pocket + "_tools.yaml", "--machine",
                pocket + "_machine.yaml", "-o", scratch + "/pocket.json", "-o", scratch + "/pocket.ngc"})});
  out.push_back({"check-bracket", command({"check", plan, program})});
  for (const char* name : {"sections", "drop-cutter", "json"})
    out.push_back({name, {own, "--piece", name, plan}});
  const std::string base = scratch + "/cases.db";
  (void)taken_by(std::vector<std::string>{own, "--piece", "cases-fill", base});
  for (const char* name : {"cases-open", "cases-add"}) out.push_back({name, {own, "--piece", name, base}});
  if (!smoke) {
    for (const char* name : {"cases-question", "cases-look-up", "cases-import"})
      out.push_back({name, {own, "--piece", name, base}});
  }
  if (!smoke)
    out.push_back(
        {"plan-surface", command({"plan", examples + "/surface.stl", "--material", "EN AW-6061", "-o",
                                  scratch + "/surface.json", "-o", scratch + "/surface.ngc"})});
  return out;
}

}  // namespace capstan::kept
