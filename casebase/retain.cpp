#include "casebase/casebase.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/operation.h"

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

/// Text for `source`: without control characters.
std::string printable(std::string_view text) {
  std::string out(text.substr(0, 400));
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
  if (shape.diameter.given) {
    s.tolerance_mm = shape.diameter.width();
  } else if (shape.width.given) {
    s.tolerance_mm = shape.width.width();
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
  return question_of(model::noun_type(operation).keyword, material_group_of(material), tool_class_of(cutter),
                     machine.id, sizes);
}

Result<Case> case_of(const model::Plan& plan, const model::StepResult& step) {
  const model::MachiningWorkingstep* ws = workingstep_of(plan, step);
  const std::string name = model::step_id(plan, step);
  if (ws == nullptr || !ws->its_feature.set()) return no_case("it machines no feature", name);
  const auto shapes = model::shapes_of(plan.model, ws->its_feature);
  if (!shapes) return no_case(shapes.error().message, name);
  if (shapes->empty()) return no_case("its feature has no shape", name);
  const Sizes sizes = sizes_of(shapes->front());
  for (const model::FeatureShape& shape : *shapes) {
    if (sizes_of(shape) != sizes) return no_case("its feature has parts of different sizes", name);
  }
  return case_of(plan, step, sizes);
}

Result<Case> case_of(const model::Plan& plan, const model::StepResult& step, const Sizes& asked) {
  const model::MachiningWorkingstep* ws = workingstep_of(plan, step);
  const std::string name = model::step_id(plan, step);
  if (ws == nullptr || !ws->its_operation.set()) return no_case("it is no machining step", name);
  const model::Cutter* cutter = model::find_cutter(plan, step.cutter_id);
  if (cutter == nullptr) return no_case("its cutter is not in the plan", name);

  Case c;
  c.asked = question_of(ws->its_operation.type, plan.material, *cutter, plan.machine, asked);
  c.cutting_diameter_mm = cutter->cutting_diameter_mm;
  c.teeth = cutter->teeth;
  c.vc_m_min = step.vc_m_min;
  c.fz_mm = step.fz_mm;
  c.ap_mm = step.axial_depth_mm;
  c.ae_mm = step.radial_depth_mm;
  c.coolant = step.flood || step.mist;
  c.cycle_s = step.cutting_s + step.rapid_s;
  c.peak_force_n = step.loads.peak_force_n;
  c.verdict = "unknown";
  c.provenance = "simulated";
  c.source = "plan " + printable(plan.file_name) + " step " + printable(name);
  if (const auto wrong = fault_of(c)) return no_case(*wrong, name);
  c.id = id_of(c);
  return c;
}

}  // namespace capstan::casebase
