#include "planner/controls/gcode/header.h"

#include <algorithm>
#include <string>

#include "planner/controls/gcode/text.h"
#include "planner/model/nouns/workpiece.h"
#include "planner/model/plan/assumed_tool_material.h"
#include "planner/model/plan/corner_rest.h"
#include "planner/model/plan/resources/shop_texts.h"
#include "planner/physics/motion/time.h"

namespace capstan::controls::gcode {
namespace {

using model::Cutter;

void write_tools(const model::Plan& plan, const std::vector<const Cutter*>& cutters, Program& out) {
  for (const Cutter* c : cutters) {
    const std::string t = std::to_string(c->pocket);
    out.marker("CAPSTAN TOOL T" + t + " H" + t + " length=" + out.number(model::length_offset_mm(*c)) +
               " diameter=" + out.number(c->cutting_diameter_mm) + " id=\"" + marker_text(c->id) + "\" " +
               std::string(model::to_text(c->cutter_class)));
  }
  for (const Cutter* c : cutters) {
    for (const model::SisterTool& s : c->sisters) {
      if (model::find_cutter(plan, s.id) == nullptr) continue;
      out.comment("T" + std::to_string(c->pocket) + ": a sister of T" + std::to_string(s.pocket) +
                  ", whose edges would not last for all of its steps");
    }
  }
  for (const Cutter* c : cutters) {
    const auto assumed = model::assumed_material_of(plan, c->id);
    if (!assumed) continue;
    out.comment("T" + std::to_string(c->pocket) + ": what its edges are made of is not stated; " +
                std::string(model::to_text(assumed->substrate)) +
                (assumed->settled ? " by " + assumed->why
                                  : std::string(" is assumed: look at the tool before this program runs")));
  }
  for (const Cutter* c : cutters) {
    if (const std::string fault = model::offset_fault(*c); !fault.empty()) {
      out.comment("NOT MEASURED: " + fault + "; measure the tool before this program runs");
    } else if (c->table_line && c->table_line->against_reference) {
      out.comment("T" + std::to_string(c->pocket) +
                  ": its length offset counts from a reference; its length is not known, " +
                  out.number(c->functional_length_mm) + " mm is assumed");
    }
  }
}

// What stays in inside corners, for whoever takes the piece on from here.
void write_corner_rests(const model::Plan& plan, Program& out) {
  for (const model::CornerRest& r : model::corner_rests(plan))
    out.comment("REST MATERIAL: a radius of " + out.number(r.radius_mm) + " mm stays in the corners of \"" +
                marker_text(r.feature) + "\" in place of " + out.number(r.stated_mm) + " mm");
}

// What the check found, for whoever loads the program in spite of it.
void write_warnings(const model::Plan& plan, const std::vector<model::Condemnation>& condemned,
                    Program& out) {
  if (condemned.empty()) return;
  const std::size_t n = condemned.size();
  out.comment("CONDEMNED: the check refuses this program for " +
              (n == 1 ? "the reason below" : "the " + std::to_string(n) + " reasons below") +
              "; it was asked for all the same, and stops before each condemned step");
  for (const auto& c : condemned) out.comment("CONDEMNED: " + model::text_of(plan, c));
}

}  // namespace

std::vector<const Cutter*> by_tool_number(const model::Plan& plan) {
  std::vector<const Cutter*> out;
  for (const Cutter& c : plan.cutters) out.push_back(&c);
  std::sort(out.begin(), out.end(), [](const Cutter* a, const Cutter* b) { return a->pocket < b->pocket; });
  return out;
}

void write_header(const model::Plan& plan, const std::vector<model::Condemnation>& condemned, Program& out) {
  out.comment("CAPSTAN PROGRAM version=1");
  const auto* project = plan.model.get<model::Project>(plan.project);
  if (project != nullptr && project->its_id) out.comment("part: " + *project->its_id);
  if (!plan.file_name.empty()) out.comment("file: " + plan.file_name);
  out.comment("machine: " + plan.machine.id);
  out.comment("material: " + plan.material.id);
  if (const auto t = motion::time_of(plan); t && t->total_s() > 0.0)
    out.comment("time: " + motion::text_of(*t));
  if (!plan.stock.box.empty()) {
    const geometry::Vec3 s = plan.stock.box.size();
    out.comment("stock: " + out.number(s.x) + " x " + out.number(s.y) + " x " + out.number(s.z) + " mm");
  }
  for (std::size_t i = 0; i < plan.setups.size(); ++i) {
    out.marker("CAPSTAN SETUP n=" + std::to_string(i + 1) + " offset=" + plan.setups[i].work_offset +
               " security=" + out.number(plan.setups[i].security_z_mm));
  }
  write_tools(plan, by_tool_number(plan), out);
  write_corner_rests(plan, out);
  write_warnings(plan, condemned, out);
}

const model::Cutter* next_tool(const model::Plan& plan, std::size_t step) {
  const int now = model::find_cutter(plan, plan.steps[step].cutter_id)->pocket;
  for (std::size_t i = step + 1; i < plan.steps.size(); ++i) {
    const model::Cutter* then = model::find_cutter(plan, plan.steps[i].cutter_id);
    if (then->pocket != now) return then;
  }
  return nullptr;
}

Status write_texts(const model::Plan& plan, std::string_view what, Program& out) {
  for (const std::string& text : model::shop_texts(plan, what)) {
    // A plan that somebody wrote may hold any.
    if (const std::string wrong = model::comment_fault(text); !wrong.empty())
      return fail({.code = "OUT-TEXT",
                   .message = "the " + std::string(what) + " '" + text + "' can be no comment: " + wrong,
                   .hint = "change it among the shop's texts, and plan again"});
    out.comment(text);
  }
  return {};
}

}  // namespace capstan::controls::gcode
