#include <algorithm>
#include <numbers>

#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/tool.h"
#include "planner/model/nouns/workpiece.h"
#include "planner/model/plan/requirement.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/library/nouns/tool_kind.h"

namespace capstan::tooling {
namespace {

using model::AnyRef;
using model::Cutter;
using model::CutterClass;
using model::MachiningTool;
using model::Model;
using model::Ref;

/// Input of a body: a cutter, or the part of one that a requirement fixes.
struct Body {
  CutterClass cutter_class = CutterClass::kEndmill;
  double lead_angle_rad = 0.0, thickness_mm = 0.0, taper_angle_rad = 0.0;
};

/// The noun of the class, with what that noun alone says. A class that the standard has no noun for is a
/// user-defined tool with the class's words.
Ref<model::MillingToolBody> body_of(Model& m, const Body& b) {
  const model::CutterClassRow& row = model::row_of(b.cutter_class);
  const AnyRef body = m.add_object(row.body == model::TypeId::kNone ? model::TypeId::kEndmill : row.body);
  if (auto* t = m.get<model::TSlotMill>(body); t != nullptr && b.thickness_mm > 0.0)
    t->cutting_thickness = b.thickness_mm;
  if (auto* d = m.get<model::DovetailMill>(body); d != nullptr && b.lead_angle_rad > 0.0)
    d->included_angle = 2.0 * b.lead_angle_rad;
  if (auto* e = m.get<model::TaperedEndmill>(body)) e->taper_angle = b.taper_angle_rad;
  if (auto* s = m.get<model::SideMill>(body); s != nullptr && b.thickness_mm > 0.0)
    s->cutter_width = b.thickness_mm;
  if (auto* u = m.get<model::UserDefinedTool>(body)) u->identifier = std::string(row.words);
  return Ref<model::MillingToolBody>(body);
}

/// Zero means unknown here, and is written as absent.
model::Real known(double v) { return v > 0.0 ? model::Real(v) : std::nullopt; }

/// A place on the tool's axis: origin at the tip, z towards the spindle.
Ref<model::Axis2Placement3d> on_axis(Model& m, double z_mm) {
  model::CartesianPoint at;
  at.name = "";
  at.coordinates = {{0.0, 0.0, z_mm}, true};
  model::Axis2Placement3d p;
  p.name = "";
  p.location = m.add(at);
  return m.add(p);
}

/// Where it sits, what it is, where it is described, and where it is measured from and to.
Ref<model::ToolUsage> usage_of(Model& m, const Cutter& c) {
  const auto usage = m.add<model::ToolUsage>();
  model::ToolUsage u;
  u.its_id = c.id;
  if (c.pocket > 0) u.its_position = std::to_string(c.pocket);
  if (!c.carousel.empty()) u.its_carousel = c.carousel;
  if (!c.product_id.empty()) {
    model::Workpiece product;
    product.its_id = c.product_id;
    u.its_product = m.add(product);
  }
  u.its_library_reference = c.library_reference.empty() ? c.id : c.library_reference;
  if (!c.library_source.empty()) u.its_library_source = c.library_source;
  if (c.functional_length_mm > 0.0) {
    u.gage_placement = on_axis(m, c.functional_length_mm);
    u.tool_end_placement = on_axis(m, 0.0);
  }
  u.description = c.description.empty() ? c.id : c.description;
  m.at<model::ToolUsage>(usage) = u;
  return usage;
}

Ref<MachiningTool> probe_of(Model& m, const Cutter& c) {
  model::TouchProbe probe;
  probe.its_id = c.id;
  probe.its_usage = usage_of(m, c);
  probe.ball_radius = known(0.5 * c.cutting_diameter_mm);
  probe.stylus_diameter = known(c.neck_diameter_mm);
  probe.overall_assembly_length = known(c.functional_length_mm);
  return m.add(probe);
}

/// Sets attributes that only some kinds of body have.
void fill_body(Model& m, model::AnyRef body, const Cutter& c) {
  const auto threaded = [&](auto* b) {
    if (b == nullptr || !(c.thread_pitch_mm > 0.0)) return;
    b->thread_size = c.thread_size_mm > 0.0 ? c.thread_size_mm : c.cutting_diameter_mm;
    b->thread_pitch = c.thread_pitch_mm;
    if (!c.thread_form.empty()) b->thread_form_type = c.thread_form;
  };
  threaded(m.get<model::Tap>(body));
  threaded(m.get<model::ThreadMill>(body));
  const auto leaning = [&](auto* b) {
    if (b != nullptr && c.lead_angle_rad > 0.0)
      b->tool_cutting_edge_angle = 0.5 * std::numbers::pi - c.lead_angle_rad;
  };
  leaning(m.get<model::Facemill>(body));
  leaning(m.get<model::Endmill>(body));
  if (auto* tap = m.get<model::Tap>(body)) tap->taper_thread_count = known(c.lead_threads);
  if (auto* reamer = m.get<model::Reamer>(body)) reamer->taper_length = known(c.lead_length_mm);
  if (auto* sink = m.get<model::Countersink>(body)) sink->minimum_cutting_diameter = known(c.tip_diameter_mm);
}

/// What the edges are made of; unset where that is only assumed: a file that states it would settle it.
Ref<model::Material> material_of(Model& m, const Cutter& c) {
  if (material_is_assumed(c)) return {};
  const auto material = m.add<model::Material>();
  auto& mat = m.at<model::Material>(material);
  mat.standard_identifier = c.substrate == model::Substrate::kCarbide ? "ISO 513" : "ISO 4957";
  mat.material_identifier = c.substrate == model::Substrate::kCarbide ? "CARBIDE" : "HSS";
  mat.material_property.given = true;
  return material;
}

}  // namespace

Ref<MachiningTool> nouns_from_cutter(Model& m, const Cutter& c) {
  if (c.cutter_class == CutterClass::kTouchProbe) return probe_of(m, c);
  const auto dimension = m.add<model::MillingToolDimension>();
  auto& d = m.at<model::MillingToolDimension>(dimension);
  d.diameter = c.cutting_diameter_mm;
  d.cutting_edge_length = known(c.maximum_depth_of_cut_mm);
  d.edge_radius = known(c.corner_radius_mm);
  d.tool_top_angle = known(0.5 * c.point_angle_rad);
  const auto body_ref = body_of(
      m, {c.cutter_class, c.lead_angle_rad,
          c.cutting_width_mm > 0.0 ? c.cutting_width_mm : c.maximum_depth_of_cut_mm, c.taper_angle_rad});
  auto& body = m.at<model::MillingToolBody>(body_ref);
  body.dimension = dimension;
  if (c.teeth > 0) body.number_of_teeth = c.teeth;
  body.hand_of_cut = c.hand;
  body.coolant_through_tool = c.coolant_through;
  fill_body(m, body_ref, c);

  const auto material = material_of(m, c);
  const auto edge = m.add<model::CuttingComponent>();
  auto& e = m.at<model::CuttingComponent>(edge);
  e.tool_offset_length = c.functional_length_mm;
  e.its_material = material;
  e.expected_tool_life = known(c.life_min * kSecondsPerMinute);

  const auto usage = usage_of(m, c);
  const auto tool = m.add<model::MillingCuttingTool>();
  auto& t = m.at<model::MillingCuttingTool>(tool);
  t.its_id = c.id;
  t.its_usage = usage;
  t.its_tool_body = body_ref;
  t.its_cutting_edge.push_back(edge);
  t.overall_assembly_length = known(c.functional_length_mm);
  return tool;
}

Ref<MachiningTool> tool_noun(Model& m, const Cutter& c) {
  for (const AnyRef r : m.all(model::TypeId::kMillingCuttingTool)) {
    if (m.origin(r).instance == 0 && m.get<MachiningTool>(r)->its_id == c.id) return Ref<MachiningTool>(r);
  }
  return nouns_from_cutter(m, c);
}

Ref<MachiningTool> nouns_from_requirement(Model& m, const model::ToolRequirement& r) {
  const auto dimension = m.add<model::MillingToolDimension>();
  auto& d = m.at<model::MillingToolDimension>(dimension);
  d.diameter = r.diameter_exact_mm > 0.0 ? r.diameter_exact_mm
               : r.diameter_max_mm > 0.0 ? r.diameter_max_mm
                                         : r.diameter_min_mm;
  d.cutting_edge_length = known(std::max(r.depth_of_cut_mm, r.reach_mm));
  d.tool_top_angle = known(0.5 * r.point_angle_rad);
  d.edge_radius = known(r.corner_radius_exact_mm);
  if (!d.edge_radius && r.corner_radius_limited) d.edge_radius = r.corner_radius_max_mm;
  const auto body = body_of(m, {r.classes.empty() ? CutterClass::kEndmill : r.classes.front(), 0.0, 0.0});
  m.at<model::MillingToolBody>(body).dimension = dimension;
  if (r.left_hand) m.at<model::MillingToolBody>(body).hand_of_cut = model::Hand::kLeft;
  const auto tool = m.add<model::MillingCuttingTool>();
  auto& t = m.at<model::MillingCuttingTool>(tool);
  t.its_id = r.words.empty() ? words_of(r) : r.words;
  t.its_tool_body = body;
  t.its_cutting_edge.given = true;
  return tool;
}

}  // namespace capstan::tooling
