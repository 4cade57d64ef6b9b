#include "planner/making/given/placed_setups.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/making/draft/setup_nouns.h"
#include "planner/making/given/listed_steps.h"
#include "planner/making/step/path/job_of.h"
#include "planner/model/features/raw_piece.h"
#include "planner/model/features/resolve.h"
#include "planner/model/features/setup_place.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/placed_nouns.h"
#include "planner/model/plan/resources/setup_position.h"

namespace capstan::given {
namespace {

using draft::SetupDraft;
using draft::StepDraft;
using geometry::Placement;
using model::AnyRef;

std::string name_of(const model::Plan& plan, AnyRef setup) {
  const auto* s = plan.model.get<model::Setup>(setup);
  return "SETUP '" + (s == nullptr ? std::string() : s->its_id.value_or("")) + "'";
}

Diagnostic about(const model::Plan& plan, AnyRef noun, const char* code, Severity severity,
                 std::string message) {
  return {.code = code,
          .severity = severity,
          .message = std::move(message),
          .file = plan.file_name,
          .line = plan.model.origin(noun).line,
          .instance = plan.model.origin(noun).instance};
}

std::string degrees(double rad) { return trimmed(rad * 180.0 / std::numbers::pi, 4) + " degrees"; }

void tell_turn(const model::Plan& plan, const model::Setup& setup, const Placement& turn, Job& job) {
  if (turn == Placement{} || !setup.its_origin.set()) return;
  const auto at = model::placement(plan.model, setup.its_origin);
  if (!at) return;
  const auto text = [](geometry::Vec3 p) {
    return "X" + trimmed(p.x, 4) + " Y" + trimmed(p.y, 4) + " Z" + trimmed(p.z, 4);
  };
  job.report(about(plan, setup.its_origin, "PIP-SETUP-TURNED", Severity::kNote,
                   "SETUP '" + setup.its_id.value_or("") + "' is " + model::turn_text({}, turn) +
                       " on the machine (its_origin): its program has the machine's axes, and its zero at " +
                       "the set-up's origin, " + text(at->origin) + " of the machine"));
}

void tell_offset(const model::Plan& plan, AnyRef setup, const model::WorkpieceSetup& piece, Job& job) {
  if (!piece.its_offset.set()) return;
  Diagnostic d = about(plan, piece.its_offset, "PIP-SETUP-OFFSET", Severity::kWarning,
                       name_of(plan, setup) +
                           ": its WORKPIECE_SETUP has an its_offset, which the control is to add from its "
                           "variables; no program of Capstan does that, and the workpiece is planned where "
                           "its_origin puts it");
  d.hint = "put the offset into its_origin, or set the work offset at the machine by it";
  job.report(std::move(d));
}

/// Other workpieces of a set-up are not made by this plan: neither planned nor cleared by its moves.
void tell_other_pieces(const model::Plan& plan, AnyRef setup, const model::Workpiece* made, Job& job) {
  const model::Model& m = plan.model;
  const model::WorkpieceSetup* taken = model::piece_in_setup(m, setup, made);
  const auto name_of_piece = [&](const model::WorkpieceSetup& piece) {
    const auto* w = m.get<model::Workpiece>(piece.its_workpiece);
    return "'" + (w == nullptr ? std::string() : w->its_id.value_or("")) + "'";
  };
  std::string others;
  std::size_t n = 0;
  for (const auto& item : m.get<model::Setup>(setup)->its_workpiece_setup.items) {
    const auto* piece = m.get<model::WorkpieceSetup>(item);
    if (piece == nullptr || piece == taken) continue;
    others += (others.empty() ? "" : ", ") + name_of_piece(*piece);
    ++n;
  }
  if (n == 0) return;
  Diagnostic d = about(plan, setup, "PIP-WORKPIECES", Severity::kWarning,
                       name_of(plan, setup) + " holds " + std::to_string(n + 1) + " workpieces; only " +
                           name_of_piece(*taken) + " is planned and checked, and nothing is known of where " +
                           others + (n == 1 ? " stands" : " stand"));
  d.hint = "plan each workpiece as a project of its own, or keep the rapid moves clear of the others by hand";
  job.report(std::move(d));
}

/// A security plane as a height of the program; nothing where it is not level there.
std::optional<double> security_height(const Placement& turn, const Placement& plane) {
  const Placement there = compose(turn, plane);
  if (std::hypot(there.z.x, there.z.y) > model::kUprightRad) return std::nullopt;
  return there.origin.z;
}

/// Whether no axis of a frame is along the tool's.
bool askew(const Placement& in_program) {
  const geometry::Vec3 tool = in_program.direction_to_local({0.0, 0.0, 1.0});
  const auto off = [](double a, double b) { return std::hypot(a, b); };
  return std::min({off(tool.x, tool.y), off(tool.y, tool.z), off(tool.z, tool.x)}) > model::kUprightRad;
}

/// The frame of a step that leans against the tool's axis so that the step cannot be cut; nothing: it can.
std::optional<Placement> leaning_frame(const model::Plan& plan, const SetupDraft& setup,
                                       const StepDraft& step) {
  if (!step.shapes.empty()) {
    const model::FeatureShape& shape = step.shapes.front();
    if (shape.kind != model::ShapeKind::kFreeform && shape.kind != model::ShapeKind::kToolpath) {
      const Placement at = compose(setup.workpiece, shape.frame);
      const double lean = model::lean_rad(at);
      // A hole right through is cut from either side.
      const bool open = shape.through && lean >= std::numbers::pi - model::kUprightRad;
      return lean <= model::kUprightRad || open ? std::nullopt : std::optional(at);
    }
  }
  // A path over a surface may be seen from each side of the piece, but not from between.
  const bool between = step.feature.set() && step::has_given_path(plan, step) && askew(setup.workpiece);
  return between ? std::optional(setup.workpiece) : std::nullopt;
}

/// The security plane must lie above the raw piece and every feature; a given one that does not is raised.
void raise_security_plane(model::Plan& plan, SetupDraft& s, std::size_t index,
                          const std::vector<StepDraft>& steps, Job& job) {
  double top = s.stock.hi.z;
  for (const StepDraft& step : steps) {
    if (step.setup != index) continue;
    for (const auto& shape : step.shapes) {
      const auto frame = compose(s.workpiece, shape.frame);
      top = std::max(top, frame.origin.z);
    }
  }
  double least = 2.0;
  for (const auto& solid : s.holding.solids) {
    top = std::max(top, solid.top_mm);
    least = std::max(least, s.holding.clearance_mm);
  }
  // Rapids cross at this height: it must clear the material, with the margin that the checker asks too.
  if (s.security_z_mm >= top + least) return;
  const double raised = top + std::max(draft::kSecurityAboveMm, least);
  job.warn("PIP-SECPLANE", "the security plane at z = " + trimmed(s.security_z_mm, 3) +
                               " mm does not clear the material and the features up to z = " +
                               trimmed(top, 3) + " mm; raised to " + trimmed(raised, 3) + " mm");
  plan.ledger.bind(s.setup, "its_secplane", model::Binder::kRule,
                   {"setup.secplane.raised", "raised so that rapid moves clear raw piece and features",
                    "safety: a rapid clears the material"});
  s.security_z_mm = raised;
  model::Model& m = plan.model;
  // The plane is stated against the set-up's axes.
  const auto turn = model::turn_of_setup(m, s.setup);
  const bool level = !turn || model::lean_rad(*turn) <= model::kUprightRad;
  const Placement plane_at = level ? Placement{.origin = {0.0, 0.0, raised}}
                                   : compose(inverse(*turn), {.origin = {0.0, 0.0, raised}});
  const auto frame = model::add_placement_at(m, plane_at.origin);
  if (!level) m.get<model::Axis2Placement3d>(frame)->axis = model::add_direction(m, plane_at.z);
  model::Plane plane;
  plane.name = "SECURITY PLANE";
  plane.position = frame;
  const auto made = m.add(plane);
  if (auto* setup = m.get<model::Setup>(s.setup)) setup->its_secplane = made;
  for (const StepDraft& step : steps) {
    auto* ws = m.get<model::Workingstep>(step.step);
    if (step.setup == index && ws != nullptr) ws->its_secplane = made;
  }
}

}  // namespace

Status place_setup(const model::Plan& plan, SetupDraft& s, Job& job) {
  const model::Model& m = plan.model;
  const auto* setup = m.get<model::Setup>(s.setup);
  const model::Workpiece* made = model::workpiece_of(m, plan.project);
  const auto frame = model::workpiece_in_program(m, s.setup, made);
  if (!frame) return tl::unexpected(frame.error());
  if (*frame) s.workpiece = **frame;
  s.stock = transformed(plan.stock.box, s.workpiece);
  s.security_z_mm = s.stock.hi.z + draft::kSecurityAboveMm;
  if (!*frame) {
    job.warn("PIP-SETUP", "no set-up places the workpiece; its own coordinates are taken as the set-up's");
  }
  if (setup == nullptr) return {};
  const auto turn = model::turn_of_setup(m, s.setup);
  if (!turn) return tl::unexpected(turn.error());
  tell_turn(plan, *setup, *turn, job);
  if (const auto* piece = model::piece_in_setup(m, s.setup, made)) {
    tell_offset(plan, s.setup, *piece, job);
    tell_other_pieces(plan, s.setup, made, job);
  }
  if (const auto* plane = m.get<model::ElementarySurface>(setup->its_secplane)) {
    const auto at = model::placement(m, plane->position);
    if (!at) return tl::unexpected(at.error());
    if (const auto z = security_height(*turn, *at)) {
      s.security_z_mm = *z;
    } else {
      job.report(about(plan, setup->its_secplane, "PIP-SECPLANE", Severity::kWarning,
                       name_of(plan, s.setup) +
                           ": its_secplane is not square to the tool axis; rapid moves " +
                           "cross at z = " + trimmed(s.security_z_mm, 3) + " mm instead"));
    }
  }
  return {};
}

std::string leans_in_setup(const model::Plan& plan, const SetupDraft& setup, const StepDraft& step) {
  const auto frame = leaning_frame(plan, setup, step);
  if (!frame) return {};
  const double lean = model::lean_rad(*frame);
  const auto* f = plan.model.get<model::ManufacturingFeature>(step.feature);
  const std::string feature = f == nullptr ? "its toolpath" : "feature '" + f->its_id.value_or("") + "'";
  const std::string by =
      model::leaning_attributes(plan.model, setup.setup, model::workpiece_of(plan.model, plan.project));
  const std::string placed =
      by.empty() ? std::string() : ": " + by + " has the workpiece " + model::turn_text({}, setup.workpiece);
  return "the axis of " + feature + " leans " + degrees(lean) + " from the tool's in " +
         name_of(plan, setup.setup) + placed + "; a tool along Z cannot cut it so: " +
         (by.empty() ? "give the step a set-up in which that axis is up"
                     : "correct " + by + ", or give the step a set-up in which that axis is up");
}

void tell_leaning_setups(const model::Plan& plan, const std::vector<SetupDraft>& setups,
                         const std::vector<StepDraft>& steps, Job& job) {
  const auto made_here = [&](const SetupDraft& s) {
    const auto* d = plan.ledger.find(s.setup, "its_origin");
    return d != nullptr && d->binder == model::Binder::kRule;
  };
  const auto steps_in = [&](std::size_t i, bool cut) {
    return std::count_if(steps.begin(), steps.end(),
                         [&](const StepDraft& s) { return s.setup == i && (!cut || s.unreadable.empty()); });
  };
  std::string instead;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    if (made_here(setups[i]) && steps_in(i, true) > 0)
      instead += (instead.empty() ? "" : ", ") + name_of(plan, setups[i].setup);
  }
  if (instead.empty()) return;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    if (made_here(setups[i])) continue;
    const std::string by =
        model::leaning_attributes(plan.model, setups[i].setup, model::workpiece_of(plan.model, plan.project));
    if (by.empty() || model::lean_rad(setups[i].workpiece) <= model::kUprightRad) continue;
    const auto n = steps_in(i, true);
    Diagnostic d =
        about(plan, setups[i].setup, "PIP-SETUP-LEANS", Severity::kWarning,
              name_of(plan, setups[i].setup) + ": " + by + " has the workpiece " +
                  model::turn_text({}, setups[i].workpiece) + ", " +
                  degrees(model::lean_rad(setups[i].workpiece)) + " off the tool axis; " +
                  (n == 0 ? std::string("no feature can be cut so by a tool along Z") +
                                (steps_in(i, false) == 0 ? ", and it is not used" : "")
                          : "only " + std::to_string(n) + " of its steps can be cut so by a tool along Z") +
                  "; the piece is clamped anew for " + instead);
    d.hint = "clamp it as the program's set-up lines say; if the placement is not meant, correct " + by;
    job.report(std::move(d));
  }
}

Raised raise_security_planes(model::Plan plan, std::vector<SetupDraft> setups,
                             const std::vector<StepDraft>& steps, Job& job) {
  for (std::size_t i = 0; i < setups.size(); ++i) raise_security_plane(plan, setups[i], i, steps, job);
  return {std::move(plan), std::move(setups)};
}

}  // namespace capstan::given
