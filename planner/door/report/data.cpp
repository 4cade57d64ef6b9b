// The plan as the page's scripts read it: what is shown, and nothing that they would have to know of cutting.
// Coordinates are whole micrometres, the resolution of every control's program or finer, so that a path takes
// few bytes.
#include "planner/door/report/data.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "planner/door/report/loads_along.h"
#include "planner/door/report/part.h"
#include "planner/door/report/tool_use.h"
#include "planner/ground/vocabulary/cutter_class.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/feature.h"
#include "planner/model/plan/cutter/generic_holder.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/resources/setup_position.h"
#include "planner/physics/motion/time.h"

namespace capstan::report {
namespace {

using Json = nlohmann::ordered_json;

/// To so many significant digits: as many as a chart shows, and few bytes.
double short_of(double v, int digits = 4) {
  if (!std::isfinite(v) || v == 0.0) return 0.0;
  std::array<char, 40> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), v, std::chars_format::general, digits).ptr;
  double out = 0.0;
  std::from_chars(text.data(), end, out);
  return out;
}
Json shorts(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double v : values) out.push_back(short_of(v));
  return out;
}
std::int64_t um(double mm) { return std::llround(1000.0 * mm); }
Json ums(const std::vector<double>& mm) {
  Json out = Json::array();
  for (const double v : mm) out.push_back(um(v));
  return out;
}
Json point(geometry::Vec3 p) { return Json::array({p.x, p.y, p.z}); }
Json box_of(const geometry::Box3& b) { return Json::array({point(b.lo), point(b.hi)}); }

Json finding_of(const Line& line) {
  const model::Finding& f = line.finding;
  return {{"severity", to_text(f.severity)},
          {"code", f.code},
          {"text", f.message},
          {"step", f.step},
          {"place", f.move},
          {"file", line.file},
          {"program", line.program}};
}

Json setup_of(const model::Plan& plan, std::size_t n) {
  const model::SetupResult& s = plan.setups[n];
  const geometry::Placement piece = model::placed_in(plan, n);
  Json solids = Json::array();
  for (const model::FixtureSolid& f : s.holding.solids) {
    Json outline = Json::array();
    for (const geometry::Vec2 p : f.outline) outline.push_back({p.x, p.y});
    solids.push_back({{"id", f.id},
                      {"kind", f.kind},
                      {"outline", outline},
                      {"bottom", f.bottom_mm},
                      {"top", f.top_mm},
                      {"presses", f.presses}});
  }
  return {{"offset", s.work_offset},
          {"security", s.security_z_mm},
          {"up", model::axis_text(piece, {0.0, 0.0, 1.0})},
          {"right", model::axis_text(piece, {1.0, 0.0, 0.0})},
          {"zero", model::zero_text(plan.stock.box, piece, 3)},
          {"turn", n == 0 ? std::string() : model::turn_text(model::placed_in(plan, n - 1), piece)},
          {"piece", {point(piece.origin), point(piece.x), point(piece.y), point(piece.z)}},
          {"holding",
           {{"id", s.holding.id},
            {"text", s.holding.description},
            {"pickup_text", s.holding.pickup_text},
            {"force", s.holding.holding_force_n},
            {"solids", solids}}}};
}

/// Heights of the cutting outline above the tip at some radii from 0 to the largest.
Json outline_of(const model::Cutter& c) {
  constexpr int kPieces = 24;
  const geometry::CutterProfile profile = model::profile_of(c);
  Json out = Json::array();
  for (int i = 0; i <= kPieces; ++i) {
    const double r = profile.radius_mm * i / kPieces;
    const double z = profile.height(r * (1.0 - 1e-9));
    out.push_back({short_of(r, 6), std::isfinite(z) ? short_of(z, 6) : 0.0});
  }
  return out;
}

Json tool_of(const model::Plan& plan, const model::Cutter& c) {
  const ToolUse use = use_of(plan, c);
  Json holder = Json::array();
  for (const model::HolderSegment& h : c.holder)
    holder.push_back({h.height_mm, h.lower_diameter_mm, h.upper_diameter_mm});
  return {{"id", c.id},
          {"number", c.pocket},
          {"class", model::words_of(c.cutter_class)},
          {"material", model::to_text(c.substrate)},
          {"text", c.description},
          {"diameter", c.cutting_diameter_mm},
          {"corner", c.corner_radius_mm},
          {"teeth", c.teeth},
          {"flutes", c.maximum_depth_of_cut_mm},
          {"out", c.stick_out_mm},
          {"length", c.functional_length_mm},
          {"shank", c.shank_diameter_mm},
          {"holder_id", model::stated_holder(c)},
          {"holder", holder},
          {"holder_diameter", c.holder_diameter_mm},
          {"outline", outline_of(c)},
          {"least_z", use.least_z_mm ? Json(short_of(*use.least_z_mm, 7)) : Json()},
          {"used_min", short_of(use.used_min)},
          {"life_min", short_of(use.life_min)},
          {"life_used_min", short_of(use.used_before_min)}};
}

Json path_of(const model::StepResult& step) {
  if (step.path == nullptr) return {};
  const model::CutterPath& p = *step.path;
  const model::FeedSchedule schedule = motion::schedule_of(step);
  Json kind = Json::array(), feed = Json::array();
  for (std::size_t i = 0; i < p.size(); ++i) {
    kind.push_back(static_cast<int>(p.kind[i]));
    feed.push_back(i < schedule.feed_mm_min.size() ? short_of(schedule.feed_mm_min[i], 5) : 0.0);
  }
  return {{"x", ums(p.x)},   {"y", ums(p.y)}, {"z", ums(p.z)}, {"cx", ums(p.cx)},
          {"cy", ums(p.cy)}, {"kind", kind},  {"feed", feed}};
}

Json loads_of(const LoadsAlong& l) {
  return {{"move", l.move},
          {"at", shorts(l.at_mm)},
          {"margin", short_of(l.margin)},
          {"columns",
           {{"feed", shorts(l.feed_mm_min)},
            {"depth", shorts(l.depth_mm)},
            {"width", shorts(l.width_mm)},
            {"force", shorts(l.force_n)},
            {"torque", shorts(l.torque_nm)},
            {"power", shorts(l.power_w)},
            {"deflection", shorts(l.deflection_mm)}}},
          {"limits",
           {{"feed", shorts(l.feed_limit_mm_min)},
            {"force", short_of(l.force_limit_n)},
            {"torque", shorts(l.torque_limit_nm)},
            {"power", shorts(l.power_limit_w)},
            {"deflection", short_of(l.deflection_limit_mm)}}}};
}

Json step_of(const model::Plan& plan, std::size_t n, const std::string& id, const motion::StepShare& share,
             const About& about) {
  const model::StepResult& s = plan.steps[n];
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
  std::string feature, operation;
  if (ws != nullptr) {
    if (const auto* f = plan.model.get<model::ManufacturingFeature>(ws->its_feature))
      feature = f->its_id.value_or("");
    if (ws->its_operation.set()) operation = model::noun_type(ws->its_operation.type).keyword;
  }
  Json held = Json::array();
  for (const model::LimitAlongPath& h : s.held_by)
    held.push_back({{"name", h.name}, {"share", short_of(h.share, 3)}});
  const model::Cutter* cutter = model::find_cutter(plan, s.cutter_id);
  return {{"id", id},
          {"feature", feature},
          {"operation", operation},
          {"setup", s.setup},
          {"tool", cutter == nullptr ? Json() : Json(cutter - plan.cutters.data())},
          {"ap", short_of(s.axial_depth_mm)},
          {"ae", short_of(s.radial_depth_mm)},
          {"vc", short_of(s.vc_m_min)},
          {"fz", short_of(s.fz_mm)},
          {"rpm", short_of(s.spindle_rpm, 6)},
          {"feed", short_of(s.feed_mm_min, 6)},
          {"coolant", coolant_text(s)},
          {"cutting_s", short_of(s.cutting_s, 6)},
          {"rapid_s", short_of(s.rapid_s, 6)},
          {"tool_change_s", short_of(share.tool_change_s, 6)},
          {"link_s", short_of(share.link_s, 6)},
          {"spindle_s", short_of(share.spindle_s, 6)},
          {"held_by", held},
          {"path", path_of(s)},
          {"loads", loads_of(loads_along(plan, s))},
          {"explained", n < about.explained_steps.size() ? about.explained_steps[n] : std::string()}};
}

Json time_of(const Result<motion::PlanTime>& t) {
  if (!t) return {};
  return {{"text", motion::text_of(*t)},
          {"total_s", short_of(t->total_s(), 7)},
          {"steps_s", short_of(t->at_feed_s() + t->rapid_s, 7)},
          {"tool_change_s", short_of(t->tool_change_s, 7)},
          {"tool_changes", t->tool_changes},
          {"link_s", short_of(t->link_s, 7)},
          {"spindle_s", short_of(t->spin_up_s, 7)}};
}

Json unplanned_of(const model::Plan& plan) {
  Json out = Json::array();
  for (const model::Unplanned& u : plan.unplanned) {
    const auto* f = plan.model.get<model::ManufacturingFeature>(u.feature);
    out.push_back({{"feature", f == nullptr ? std::string() : f->its_id.value_or("")},
                   {"reason", u.reason},
                   {"needed_by", u.needed_by}});
  }
  return out;
}

Json lines_of(std::string_view text) {
  Json out = Json::array();
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    out.push_back(std::string(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

Json features_of(const model::Plan& plan) {
  Json out = Json::array();
  for (const FeatureSolids& f : feature_solids(plan)) {
    Json solids = Json::array();
    for (const FeatureSolids::Prism& p : f.prisms) {
      Json outline = Json::array();
      for (const geometry::Vec3 v : p.outline)
        outline.push_back({short_of(v.x, 6), short_of(v.y, 6), short_of(v.z, 6)});
      solids.push_back({{"outline", outline}, {"down", point(p.down)}});
    }
    out.push_back({{"id", f.id}, {"solids", solids}});
  }
  return out;
}

/// Runs of equal heights, [how many, micrometres], ...: most of a part is level.
Json runs_of(const std::vector<float>& mm) {
  Json out = Json::array();
  for (std::size_t from = 0, to = 0; from < mm.size(); from = to) {
    for (to = from; to < mm.size() && um(mm[to]) == um(mm[from]);) ++to;
    out.push_back(to - from);
    out.push_back(um(mm[from]));
  }
  return out;
}
Json heights_of(const PartHeights& part) {
  return {{"nx", part.nx},
          {"ny", part.ny},
          {"top", runs_of(part.top)},
          {"bottom", runs_of(part.bottom)},
          {"beside", part.beside}};
}

Json whole(const model::Plan& plan, const About& about) {
  Json setups = Json::array(), tools = Json::array(), steps = Json::array(), findings = Json::array();
  Json marks = Json::array(), inputs = Json::array(), told = Json::array();
  for (std::size_t n = 0; n < plan.setups.size(); ++n) setups.push_back(setup_of(plan, n));
  for (const model::Cutter& c : plan.cutters) tools.push_back(tool_of(plan, c));
  const std::vector<std::string> ids = model::step_ids(plan);
  const auto time = motion::time_of(plan);
  for (std::size_t n = 0; n < plan.steps.size(); ++n)
    steps.push_back(step_of(plan, n, ids[n], time ? time->steps.at(n) : motion::StepShare{}, about));
  for (const Line& l : about.findings) findings.push_back(finding_of(l));
  for (const Diagnostic& d : about.told)
    told.push_back({{"severity", to_text(d.severity)},
                    {"code", d.code},
                    {"text", d.message},
                    {"place", d.path},
                    {"hint", d.hint}});
  for (const auto& [name, value] : about.marks) marks.push_back({name, value});
  const auto input = [&](const std::string& what, const std::string& value, const std::string& source) {
    const auto hash = std::find_if(about.hashes.begin(), about.hashes.end(),
                                   [&](const auto& h) { return h.first == what; });
    inputs.push_back({{"what", what},
                      {"value", value},
                      {"source", source},
                      {"sha256", hash == about.hashes.end() ? std::string() : hash->second}});
  };
  input(kPart, plan.file_name, "named by the caller");
  for (const model::Provenance& p : plan.provenance) input(p.what, p.value, p.source);
  return {{"file", plan.file_name},
          {"machine", plan.machine.id},
          {"material", plan.material.id},
          {"stock",
           {{"box", box_of(plan.stock.box)},
            {"source", plan.stock.source},
            {"radius", plan.stock.cylinder_radius_mm ? Json(*plan.stock.cylinder_radius_mm) : Json()}}},
          {"marks", marks},
          {"inputs", inputs},
          {"time", time_of(time)},
          {"condemned", about.condemned},
          {"findings", findings},
          {"told", told},
          {"unplanned", unplanned_of(plan)},
          {"features", features_of(plan)},
          {"part", heights_of(part_heights(plan))},
          {"setups", setups},
          {"tools", tools},
          {"steps", steps},
          {"explained", about.explained},
          {"program", {{"name", about.program_name}, {"lines", lines_of(about.program)}}}};
}

}  // namespace

std::string data_of(const model::Plan& plan, const About& about) {
  // What is no UTF-8 in a name is shown as U+FFFD: the page is UTF-8.
  const std::string text = whole(plan, about).dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) out += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return out;
}

}  // namespace capstan::report
