#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/memo/remembered.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/volumes/nouns.h"

namespace capstan::verify {

using geometry::Box3;
using geometry::Placement;
using geometry::Vec3;

namespace {

constexpr double kDefaultToleranceMm = 0.02;  // default, unsourced

Box3 box_of_noun(const model::Model& m, model::AnyRef shape) {
  if (const auto* b = m.get<model::Block>(shape)) {
    const auto frame = volumes::frame_or_same(m, b->position);
    if (!frame || !b->x || !b->y || !b->z) return {};
    Box3 local;
    local.add({0.0, 0.0, 0.0});
    local.add({*b->x, *b->y, *b->z});
    return placed(local, *frame);
  }
  return {};
}

Box3 box_of_features(const PartShapes& part) {
  Box3 out;
  for (const auto& e : part.entries) {
    for (const auto& s : e.shapes) {
      if (s.area.empty() || s.kind == model::ShapeKind::kStep || s.kind == model::ShapeKind::kOutside)
        continue;
      const auto b = geometry::bounds(s.area);
      Box3 local;
      local.add({b.lo.x, b.lo.y, 0.0});
      local.add({b.hi.x, b.hi.y, -s.depth_mm()});
      const Box3 there = placed(local, s.frame());
      out.add(there.lo);
      out.add(there.hi);
    }
  }
  return out;
}

}  // namespace

const model::Workpiece* workpiece_of(const model::Plan& plan) {
  if (const auto* project = plan.model.get<model::Project>(plan.project)) {
    for (const auto& w : project->its_workpieces.items) {
      if (const auto* piece = plan.model.get<model::Workpiece>(w)) return piece;
    }
  }
  const auto all = plan.model.all(model::TypeId::kWorkpiece);
  return all.empty() ? nullptr : plan.model.get<model::Workpiece>(all.front());
}

std::optional<double> general_tolerance_of(const model::Workpiece& piece) {
  const auto& t = piece.global_tolerance;
  return t && *t > 0.0 && *t <= kLargestGeneralMm ? std::optional<double>(*t) : std::nullopt;
}

Box3 placed(const Box3& box, const Placement& at) {
  Box3 out;
  for (const double x : {box.lo.x, box.hi.x}) {
    for (const double y : {box.lo.y, box.hi.y}) {
      for (const double z : {box.lo.z, box.hi.z}) out.add(at.to_parent({x, y, z}));
    }
  }
  return out;
}

std::optional<Placement> turn_of(const model::Model& m, const model::Setup& setup) {
  auto frame = volumes::frame_or_same(m, setup.its_origin);
  if (frame) frame->origin = {};
  return frame;
}

const model::WorkpieceSetup* piece_of(const model::Plan& plan, const model::Setup& setup) {
  const auto* made = workpiece_of(plan);
  const model::WorkpieceSetup* first = nullptr;
  for (const auto& item : setup.its_workpiece_setup.items) {
    const auto* ws = plan.model.get<model::WorkpieceSetup>(item);
    if (ws == nullptr) continue;
    if (made != nullptr && plan.model.get<model::Workpiece>(ws->its_workpiece) == made) return ws;
    if (first == nullptr) first = ws;
  }
  return first;
}

// A work offset shifts and does not turn: a program's axes are the machine's, so that a set-up whose axes are
// turned on the machine has its workpiece turned in the program.
Placement workpiece_in(const model::Plan& plan, std::size_t setup) {
  if (setup >= plan.setups.size()) return {};
  const auto* s = plan.model.get<model::Setup>(plan.setups[setup].setup);
  if (s == nullptr) return {};
  const Placement turn = turn_of(plan.model, *s).value_or(Placement{});
  const auto* ws = piece_of(plan, *s);
  const Placement inside =
      ws == nullptr ? Placement{} : volumes::frame_or_same(plan.model, ws->its_origin).value_or(Placement{});
  return turn == Placement{} ? inside : compose(turn, inside);
}

const PartShapes::Entry* PartShapes::find(model::AnyRef feature) const {
  for (const Entry& e : entries) {
    if (e.feature == feature) return &e;
  }
  return nullptr;
}

PartShapes shapes_of_part(const model::Plan& plan) {
  PartShapes out;
  std::set<model::AnyRef> pieces = volumes::parts_of_others(plan.model);
  const volumes::Source source = volumes::source_of(plan.model, plan.stock.box);
  for (const auto& s : plan.steps) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
    if (ws != nullptr) pieces.erase(ws->its_feature);
  }
  for (const auto f : plan.model.all_below(model::TypeId::kManufacturingFeature)) {
    PartShapes::Entry e{f, {}, {}, pieces.contains(f)};
    const volumes::Reading own = volumes::read(source, f);
    e.shapes = volumes::forms_of(source, f, own);
    e.fault = own.unread;
    out.entries.push_back(std::move(e));
  }
  out.tolerance_mm = kDefaultToleranceMm;
  const model::Workpiece* piece = workpiece_of(plan);
  if (const auto stated = piece != nullptr ? general_tolerance_of(*piece) : std::nullopt) {
    out.tolerance_mm = std::clamp(*stated, kFinestJudgedMm, kWidestJudgedMm);
  }
  // Raw material beyond the part may be cut freely: what belongs to the part is its own bounding box, where
  // the raw piece is another one.
  out.part = plan.stock.box;
  const bool grown = plan.stock.source.find("--stock") != std::string::npos;
  Box3 own = piece != nullptr ? box_of_noun(plan.model, piece->its_bounding_geometry) : Box3{};
  if (own.empty() && grown && !plan.target_mesh) own = box_of_features(out);
  if (!own.empty()) {
    out.part.lo = {std::max(own.lo.x, out.part.lo.x), std::max(own.lo.y, out.part.lo.y),
                   std::max(own.lo.z, out.part.lo.z)};
    out.part.hi = {std::min(own.hi.x, out.part.hi.x), std::min(own.hi.y, out.part.hi.y),
                   std::min(own.hi.z, out.part.hi.z)};
    if (out.part.empty()) out.part = plan.stock.box;
  }
  return out;
}

ReadPart read_part(const model::Plan& plan, bool keyed) {
  ReadPart out{shapes_of_part(plan), {}};
  poll();
  if (keyed)
    out.known_by =
        memo::key_of(memo::Stage::kSweep, plan.machine, plan.material, plan.target_mesh, out.shapes);
  return out;
}

}  // namespace capstan::verify
