#include "tests/validation/freecad/foreign_path.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "planner/proof/verify/program/linuxcnc/reader.h"

namespace capstan::validation {
namespace {

/// Shorter ways than this are none, mm: half the last digit of the programs.
constexpr double kNoWayMm = 5e-4;

model::MoveRole role_of(const verify::Block& b, double top_z_mm) {
  const double dz = b.to.z - b.from.z;
  const bool aside = is_arc(b.move) || std::hypot(b.to.x - b.from.x, b.to.y - b.from.y) > kNoWayMm;
  if (std::min(b.from.z, b.to.z) >= top_z_mm - kNoWayMm) return model::MoveRole::kApproach;
  if (dz < -kNoWayMm) return aside ? model::MoveRole::kRamp : model::MoveRole::kPlunge;
  if (dz > kNoWayMm && !aside) return model::MoveRole::kRetract;
  return model::MoveRole::kCut;
}

}  // namespace

Result<model::CutterPath> path_of_program(std::string_view text, double top_z_mm) {
  const verify::Program program = verify::linuxcnc::read_program(text);
  for (const auto& f : program.faults) {
    // Tools, offsets and the spindle are the plan's to say.
    if (f.undecided) return fail("VAL-PROGRAM", "line " + std::to_string(f.line) + ": " + f.message);
  }
  model::CutterPath out;
  for (const verify::Block& b : program.blocks) {
    if (b.kind != verify::Block::Kind::kMove) continue;
    // Where a program begins is not known until all its axes are named.
    if (!b.known_to[0] || !b.known_to[1] || !b.known_to[2]) continue;
    if (out.size() == 0) {
      out.start(b.to);
      continue;
    }
    if (b.move == model::MoveKind::kRapid) {
      out.rapid(b.to);
    } else if (is_arc(b.move)) {
      out.arc(b.to, b.centre, b.move == model::MoveKind::kArcCw, role_of(b, top_z_mm));
    } else {
      out.line(b.to, role_of(b, top_z_mm));
    }
  }
  if (out.size() < 2) return fail("VAL-PROGRAM", "the program moves nothing");
  return out;
}

model::CutterPath in_pieces(const model::CutterPath& path, double most_mm) {
  model::CutterPath out;
  if (path.size() == 0) return out;
  out.start(path.point(0));
  for (std::size_t i = 1; i < path.size(); ++i) {
    const model::MoveKind kind = path.kind[i];
    if (kind == model::MoveKind::kDwell) {
      out.dwell();
    } else if (kind == model::MoveKind::kRapid) {
      out.rapid(path.point(i), path.role[i]);
    } else {
      const int n = std::max(1, static_cast<int>(std::ceil(model::move_length(path, i) / most_mm)));
      for (int k = 1; k <= n; ++k) {
        const geometry::Vec3 to = k == n ? path.point(i) : point_on_move(path, i, double(k) / n);
        if (is_arc(kind))
          out.arc(to, {path.cx[i], path.cy[i]}, kind == model::MoveKind::kArcCw, path.role[i]);
        else
          out.line(to, path.role[i]);
      }
    }
  }
  return out;
}

Result<model::Plan> with_path(const model::Plan& plan, std::size_t at, model::CutterPath path,
                              const pipeline::Inputs& inputs, Job& job) {
  model::Plan changed = plan;
  model::Model& m = changed.model;
  const auto* step = m.get<model::MachiningWorkingstep>(changed.steps.at(at).step);
  auto* op = step == nullptr ? nullptr : m.get<model::MachiningOperation>(step->its_operation);
  auto* technology = op == nullptr ? nullptr : m.get<model::MillingTechnology>(op->its_technology);
  if (technology == nullptr) return fail("VAL-PLAN", "step " + std::to_string(at) + " mills nothing");
  const model::AnyRef operation = step->its_operation, values = op->its_technology;
  technology->feedrate.reset();
  technology->feedrate_per_tooth.reset();
  const model::Reason why{"comparison", "another planner's path", "tests/validation/freecad"};
  for (const char* open : {"feedrate", "feedrate_per_tooth"}) {
    if (changed.ledger.find(values, open) != nullptr) changed.ledger.reopen({values, open});
  }
  for (const char* kept : {"spindle", "cutspeed"}) {
    if (changed.ledger.find(values, kept) != nullptr)
      changed.ledger.bind(values, kept, model::Binder::kGiven, why);
  }
  model::CutterLocationTrajectory t;
  t.its_priority = true;
  t.its_type = model::ToolpathType::kTrajectoryPath;
  t.path = std::make_shared<const model::CutterPath>(std::move(path));
  model::ToolpathList list;
  list.its_list.push_back(m.add(std::move(t)));
  const auto made = m.add(std::move(list));
  m.get<model::MachiningOperation>(operation)->its_toolpath = made;
  changed.ledger.bind(operation, "its_toolpath", model::Binder::kGiven, why);
  changed.steps.clear();
  return pipeline::bind(std::move(changed), inputs, {}, job);
}

}  // namespace capstan::validation
