#include "casebase/planned.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "casebase/record/held.h"
#include "casebase/record/sha256.h"
#include "planner/ground/base/text.h"
#include "planner/model/features/quality.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/operation.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/resources/setup_position.h"
#include "planner/model/plan/resources/specific_force.h"

namespace capstan::casebase {
namespace {

tl::unexpected<Diagnostic> no_case(std::string why, std::string path) {
  return fail(Diagnostic{
      .code = "CASE-STEP", .message = "the step makes no case: " + std::move(why), .path = std::move(path)});
}

/// A name as a keyword: what a keyword may not hold becomes '_'.
std::string keyword(std::string_view name) {
  std::string out(name.substr(0, 80));
  for (char& c : out) {
    const bool fine = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      std::string_view("_./+-").find(c) != std::string_view::npos;
    if (!fine) c = '_';
  }
  return out;
}

/// Text for `source`: UTF-8 without control characters.
std::string printable(std::string_view text) {
  std::string out = utf8_text(text, 400);
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return out;
}

const model::MachiningWorkingstep* workingstep_of(const model::Plan& plan, const model::StepResult& step) {
  return plan.model.get<model::MachiningWorkingstep>(step.step);
}

}  // namespace

std::string tool_class_of(const model::Cutter& cutter) {
  return std::string(to_text(cutter.substrate)) + '/' + std::string(to_text(cutter.cutter_class));
}

std::string material_group_of(const model::WorkMaterial& material) {
  return keyword(material.iso_group + '/' + material.id);
}

Sizes sizes_of(const model::FeatureShape& shape) {
  Sizes s;
  s.diameter_mm = shape.diameter.nominal_mm;
  s.depth_mm = shape.depth_mm;
  s.width_mm = shape.width.nominal_mm;
  if (shape.kind == model::ShapeKind::kThread) s.diameter_mm = shape.thread_major_mm;
  if (shape.kind == model::ShapeKind::kChamfer) s.width_mm = shape.chamfer_width_mm;
  if (shape.kind == model::ShapeKind::kEdgeRound) s.width_mm = shape.round_radius_mm;
  for (const model::Toleranced* size : {&shape.diameter, &shape.width}) {
    if (!size->given) continue;
    s.tolerance_mm = size->width();
    s.middle_over_mm = 0.5 * (size->lower_mm + size->upper_mm);
    break;
  }
  return s;
}

Question question_of(std::string_view operation, std::string_view material_group, std::string_view tool_class,
                     std::string_view machine_id, const Sizes& sizes) {
  return {.operation = keyword(operation),
          .material_group = keyword(material_group),
          .tool_class = keyword(tool_class),
          .machine_class = keyword(machine_id),
          .diameter_mm = sizes.diameter_mm,
          .depth_mm = sizes.depth_mm,
          .width_mm = sizes.width_mm,
          .tolerance_mm = sizes.tolerance_mm};
}

Question question_of(model::TypeId operation, const model::WorkMaterial& material,
                     const model::Cutter& cutter, const model::Machine& machine, const Sizes& sizes) {
  Question q = question_of(model::noun_type(operation).keyword, material_group_of(material),
                           tool_class_of(cutter), machine.id, sizes);
  q.cutter_diameter_mm = cutter.cutting_diameter_mm;
  q.teeth = cutter.teeth;
  q.stick_out_mm = cutter.stick_out_mm;
  q.hardness_hb = material.hardness_hb;
  return q;
}

Question question_of(const model::Plan& plan, const OfStep& step, const model::Cutter& cutter,
                     const Sizes& sizes) {
  Question q = question_of(step.operation, plan.material, cutter, plan.machine, sizes);
  q.coolant = step.coolant;
  if (!step.feature.set()) return q;
  const model::Ref<model::ManufacturingFeature> feature(step.feature);
  q.feature = keyword(model::noun_type(step.feature.type).keyword);
  q.asked_ra_um = std::max(0.0, model::quality_of(plan.model, feature).ra_um.value_or(0.0));
  return q;
}

Coolant coolant_of(const model::StepResult& step) {
  return step.through ? Coolant::kThrough
         : step.flood ? Coolant::kFlood
         : step.mist  ? Coolant::kMist
                      : Coolant::kDry;
}

namespace {

bool cuts(const model::CutterPath& path, std::size_t i) {
  return path.kind[i] != model::MoveKind::kRapid && path.kind[i] != model::MoveKind::kDwell &&
         path.role[i] != model::MoveRole::kLink && path.role[i] != model::MoveRole::kApproach &&
         path.role[i] != model::MoveRole::kRetract;
}

/// The shape that a step cuts, of those of its feature: the one that the workingstep is named after, as
/// planning names it; else the one whose bottom is nearest to the lowest point of the cut. Null: nobody can
/// tell.
const model::FeatureShape* cut_by(const model::Plan& plan, const model::StepResult& step,
                                  const std::string& name, const std::vector<model::FeatureShape>& shapes) {
  const Sizes first = sizes_of(shapes.front());
  if (std::all_of(shapes.begin(), shapes.end(), [&](const auto& s) { return sizes_of(s) == first; }))
    return &shapes.front();
  for (const model::FeatureShape& shape : shapes) {
    if (!shape.name.empty() && name.starts_with(shape.name + " ")) return &shape;
  }
  if (!step.path || step.setup >= plan.setups.size()) return nullptr;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < step.path->size(); ++i) {
    if (cuts(*step.path, i)) lowest = std::min(lowest, step.path->z[i]);
  }
  if (!std::isfinite(lowest)) return nullptr;
  const geometry::Placement piece = model::placed_in(plan, step.setup);
  const model::FeatureShape* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const model::FeatureShape& shape : shapes) {
    const geometry::Vec3 bottom = piece.to_parent(shape.frame.to_parent({0.0, 0.0, -shape.depth_mm}));
    const double off = std::abs(bottom.z - lowest);
    if (off < least) {
      least = off;
      best = &shape;
    }
  }
  return best;
}

/// Length, blocks and arcs of the cutting moves.
void take_path(const model::CutterPath& path, Bound& b) {
  double arcs = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!cuts(path, i)) continue;
    const double length = model::move_length(path, i);
    b.path_length_mm += length;
    ++b.path_blocks;
    if (model::is_arc(path.kind[i])) arcs += length;
  }
  if (b.path_blocks == 0 || !(b.path_length_mm > 0.0)) return;
  b.mean_block_mm = b.path_length_mm / b.path_blocks;
  b.arc_share = std::min(1.0, arcs / b.path_length_mm);
}

/// The feed per tooth that a log of the schedule at 100 % would show: the feed that is held longest over the
/// speed that is, rapids apart. 0: there is no schedule, or no such feed.
double scheduled_fz_mm(const model::StepResult& step, int teeth) {
  if (!step.path || !step.schedule) return 0.0;
  const model::CutterPath& path = *step.path;
  const model::FeedSchedule& schedule = *step.schedule;
  if (schedule.feed_mm_min.size() != path.size() || schedule.spindle_rpm.size() != path.size()) return 0.0;
  Held feed, speed;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.kind[i] == model::MoveKind::kRapid || path.kind[i] == model::MoveKind::kDwell) continue;
    const double fed = schedule.feed_mm_min[i], rpm = std::abs(schedule.spindle_rpm[i]);
    if (!(fed > 0.0) || !(rpm > 0.0)) continue;
    const double seconds = 60.0 * model::move_length(path, i) / fed;
    if (!(seconds > 0.0)) continue;
    feed.add(fed, seconds);
    speed.add(rpm, seconds);
  }
  return held_fz_mm(feed.longest().value, speed.longest().value, teeth);
}

/// Whether the step's path was computed here, which aims at the middle of the zone; one that the file gave
/// aims where it says.
bool has_computed_path(const model::Plan& plan, model::AnyRef operation) {
  const model::Decision* path = plan.ledger.find(operation, "its_toolpath");
  return path != nullptr && path->binder != model::Binder::kGiven;
}

/// Area of the chip: mean of the samples in the material, and peak.
void take_sections(const model::SectionSeries& sections, Bound& b) {
  double sum = 0.0;
  std::size_t n = 0;
  for (const double area : sections.csa_mm2) {
    if (!(area > 0.0)) continue;
    sum += area;
    ++n;
    b.peak_area_mm2 = std::max(b.peak_area_mm2, area);
  }
  if (n != 0) b.mean_area_mm2 = sum / static_cast<double>(n);
}

/// Arc of contact and mean thickness of the chip of a mill, by the geometry of the chord: cos(phi) =
/// 1 - 2 ae / D, hm = fz (1 - cos(phi)) / phi. A thinner chip by a lead angle or a round tip is not counted.
void take_contact(double diameter_mm, Bound& b) {
  if (!(b.ae_mm > 0.0) || !(diameter_mm > 0.0)) return;
  const double cosine = 1.0 - 2.0 * std::min(1.0, b.ae_mm / diameter_mm);
  b.mean_contact_rad = std::acos(cosine);
  b.mean_chip_mm = b.fz_mm * (1.0 - cosine) / b.mean_contact_rad;
}

void take_allowances(const model::Plan& plan, model::AnyRef operation, Bound& b) {
  if (const auto* side = plan.model.get<model::SideMilling>(operation))
    b.allowance_side_mm = std::max(0.0, side->allowance_side.value_or(0.0));
  if (const auto* both = plan.model.get<model::BottomAndSideMilling>(operation)) {
    b.allowance_side_mm = std::max(0.0, both->allowance_side.value_or(0.0));
    b.allowance_bottom_mm = std::max(0.0, both->allowance_bottom.value_or(0.0));
  }
  if (const auto* plane = plan.model.get<model::PlaneMilling>(operation))
    b.allowance_bottom_mm = std::max(0.0, plane->allowance_bottom.value_or(0.0));
}

/// A number as it is the same in every form of a file: to nine digits.
std::string digits(double v) { return fmt::format("{:.8e}", v + 0.0); }

}  // namespace

std::string strategy_of(const model::Plan& plan, model::AnyRef operation) {
  const auto word = [](const auto* op) {
    return op != nullptr && op->its_machining_strategy.set()
               ? keyword(model::noun_type(model::AnyRef(op->its_machining_strategy).type).keyword)
               : std::string();
  };
  std::string out = word(plan.model.get<model::Two5dMillingOperation>(operation));
  if (out.empty()) out = word(plan.model.get<model::FreeformOperation>(operation));
  if (out.empty()) out = word(plan.model.get<model::DrillingTypeOperation>(operation));
  return out;
}

std::string plan_hash_of(const model::Plan& plan) {
  std::string text = "capstan plan 1\n" + plan.material.id + '\n' + plan.machine.id + '\n';
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const model::StepResult& s = plan.steps[i];
    const model::MachiningWorkingstep* ws = workingstep_of(plan, s);
    const model::Cutter* cutter = model::find_cutter(plan, s.cutter_id);
    if (ws == nullptr || cutter == nullptr) continue;
    text += ids[i] + '\n' + std::string(model::noun_type(ws->its_operation.type).keyword) + ' ' +
            tool_class_of(*cutter) + ' ' + std::to_string(cutter->teeth);
    for (const double v :
         {cutter->cutting_diameter_mm, s.vc_m_min, s.fz_mm, s.axial_depth_mm, s.radial_depth_mm})
      text += ' ' + digits(v);
    text += '\n';
  }
  return sha256(text).substr(0, 32);
}

namespace {

Result<Case> made(const model::Plan& plan, const model::StepResult& step, const std::string& hash,
                  const Sizes& asked) {
  const model::MachiningWorkingstep* ws = workingstep_of(plan, step);
  const std::string name = model::step_id(plan, step);
  if (ws == nullptr || !ws->its_operation.set()) return no_case("it is no machining step", name);
  const model::Cutter* cutter = model::find_cutter(plan, step.cutter_id);
  if (cutter == nullptr) return no_case("its cutter is not in the plan", name);

  Case c;
  c.origin = Origin::kSimulated;
  c.asked = question_of(plan, {ws->its_operation.type, ws->its_feature, coolant_of(step)}, *cutter, asked);
  c.bound.vc_m_min = step.vc_m_min;
  c.bound.fz_mm = step.fz_mm;
  c.bound.ap_mm = step.axial_depth_mm;
  c.bound.ae_mm = step.radial_depth_mm;
  c.bound.corner_radius_mm = cutter->corner_radius_mm;
  if (has_computed_path(plan, ws->its_operation))
    c.bound.aimed_over_mm = Figure{asked.middle_over_mm, 0.0, Origin::kSimulated};
  c.bound.strategy = strategy_of(plan, ws->its_operation);
  take_allowances(plan, ws->its_operation, c.bound);
  take_contact(cutter->cutting_diameter_mm, c.bound);
  if (step.path) take_path(*step.path, c.bound);
  if (step.sections) take_sections(*step.sections, c.bound);
  c.predicted = {
      .time_s = step.cutting_s + step.rapid_s,
      .peak_force_n = step.loads.peak_force_n,
      .torque_nm = step.loads.torque_nm,
      .power_w = step.loads.power_w,
      .deflection_mm = step.loads.deflection_mm,
      .tool_life_min = step.loads.tool_life_min,
      .force_margin = step.loads.force_margin,
      .specific_force_n_mm2 = model::is_a(ws->its_operation.type, model::TypeId::kDrillingTypeOperation)
                                  ? 0.0
                                  : model::specific_force_n_mm2(plan.material, *cutter, c.bound.mean_chip_mm),
      .held_fz_mm = scheduled_fz_mm(step, cutter->teeth)};
  const auto simulated = [](double v) {
    return v > 0.0 ? std::optional(Figure{v, 0.0, Origin::kSimulated}) : std::nullopt;
  };
  c.observed.time_s = simulated(c.predicted.time_s);
  c.observed.peak_force_n = simulated(c.predicted.peak_force_n);
  c.observed.torque_nm = simulated(c.predicted.torque_nm);
  c.observed.power_w = simulated(c.predicted.power_w);
  c.from.plan_hash = hash;
  c.from.workingstep = printable(name);
  c.from.source = "plan " + printable(plan.file_name) + " step " + printable(name);
  if (const auto wrong = fault_of(c)) return no_case(*wrong, name);
  c.id = id_of(c);
  return c;
}

Result<Case> made(const model::Plan& plan, const model::StepResult& step, const std::string& hash) {
  const model::MachiningWorkingstep* ws = workingstep_of(plan, step);
  const std::string name = model::step_id(plan, step);
  if (ws == nullptr || !ws->its_feature.set()) return no_case("it machines no feature", name);
  const auto shapes = model::shapes_of(plan.model, ws->its_feature);
  if (!shapes) return no_case(shapes.error().message, name);
  if (shapes->empty()) return no_case("its feature has no shape", name);
  const model::FeatureShape* shape = cut_by(plan, step, name, *shapes);
  if (shape == nullptr) return no_case("nobody can tell which part of its feature it cuts", name);
  return made(plan, step, hash, sizes_of(*shape));
}

}  // namespace

Result<Case> case_of(const model::Plan& plan, const model::StepResult& step) {
  return made(plan, step, plan_hash_of(plan));
}

Result<Case> case_of(const model::Plan& plan, const model::StepResult& step, const Sizes& asked) {
  return made(plan, step, plan_hash_of(plan), asked);
}

std::vector<Case> cases_of(const model::Plan& plan, Job& job) {
  const std::string hash = plan_hash_of(plan);
  std::vector<Case> out;
  for (const model::StepResult& step : plan.steps) {
    Result<Case> c = made(plan, step, hash);
    if (c) {
      out.push_back(*std::move(c));
      continue;
    }
    Diagnostic d = c.error();
    d.severity = Severity::kNote;
    job.report(std::move(d));
  }
  return out;
}

}  // namespace capstan::casebase
