#include "planner/model/features/setup_place.h"

#include <cmath>

#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"

namespace capstan::model {

Result<geometry::Placement> turn_of_setup(const Model& m, AnyRef setup) {
  const auto* s = m.get<Setup>(setup);
  if (s == nullptr) return geometry::Placement{};
  auto frame = placement_or_identity(m, s->its_origin);
  if (frame) frame->origin = {};
  return frame;
}

const WorkpieceSetup* piece_in_setup(const Model& m, AnyRef setup, const Workpiece* workpiece) {
  const auto* s = m.get<Setup>(setup);
  if (s == nullptr) return nullptr;
  const WorkpieceSetup* first = nullptr;
  for (const auto& item : s->its_workpiece_setup.items) {
    const auto* piece = m.get<WorkpieceSetup>(item);
    if (piece == nullptr) continue;
    if (workpiece != nullptr && m.get<Workpiece>(piece->its_workpiece) == workpiece) return piece;
    if (first == nullptr) first = piece;
  }
  return first;
}

Result<std::optional<geometry::Placement>> workpiece_in_program(const Model& m, AnyRef setup,
                                                                const Workpiece* workpiece) {
  const auto turn = turn_of_setup(m, setup);
  if (!turn) return fail(turn.error());
  const WorkpieceSetup* piece = piece_in_setup(m, setup, workpiece);
  if (piece == nullptr) return std::optional<geometry::Placement>{};
  const auto inside = placement_or_identity(m, piece->its_origin);
  if (!inside) return fail(inside.error());
  // What is not turned keeps its numbers to the last bit.
  if (*turn == geometry::Placement{}) return std::optional<geometry::Placement>(*inside);
  return std::optional<geometry::Placement>(compose(*turn, *inside));
}

double lean_rad(const geometry::Placement& in_program) {
  return std::atan2(std::hypot(in_program.z.x, in_program.z.y), in_program.z.z);
}

std::string leaning_attributes(const Model& m, AnyRef setup, const Workpiece* workpiece) {
  std::string out;
  const auto add = [&](const Result<geometry::Placement>& frame, const char* attribute) {
    if (!frame || lean_rad(*frame) <= kUprightRad) return;
    out += (out.empty() ? "" : " and ") + std::string(attribute);
  };
  add(turn_of_setup(m, setup), "SETUP.its_origin");
  if (const WorkpieceSetup* piece = piece_in_setup(m, setup, workpiece))
    add(placement_or_identity(m, piece->its_origin), "WORKPIECE_SETUP.its_origin");
  return out;
}

}  // namespace capstan::model
