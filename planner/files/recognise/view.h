#pragma once

#include <vector>

#include "planner/files/recognise/rings.h"

namespace capstan::recognise {

/// The patches of a group, seen along a direction that a tool could come from.
struct View {
  Direction3 access;
  double slope = 0;             ///< rad, of the walls against `access`
  std::vector<Surface> floors;  ///< planes that look along `access`
  std::vector<Surface> walls;   ///< planes along it
  std::vector<Surface> bends;   ///< cylinders along it: rounded corners, rounded ends, round islands
  std::vector<Surface> blends;  ///< what is left: fillets between wall and floor
  int islands = 0;              ///< closed rings of walls and bends with the material inside; not among those
  bool closed = false;          ///< walls and bends run all round
};

/// The views that see all of a group, the best first: along an axis of the raw piece; with one floor, then
/// with none, then with several at different depths; then the shallower. Empty where no direction does.
[[nodiscard]] std::vector<View> views(const Context& context, const std::vector<std::uint32_t>& patches);

/// Takes the islands out of the walls of a view, and tells whether the others run all round.
void tell_rings(const Context& context, View& view);

/// A group in parts of one floor each, where its best view has floors at several depths: every wall goes to
/// the floor that it stands on for the longest way, or to that of a fillet between them. One part where there
/// is one floor.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> floors_apart(const Context& context,
                                                                   const std::vector<std::uint32_t>& patches);

/// Whether a direction is along an axis of the raw piece.
[[nodiscard]] bool along_raw(const RawBox& raw, Direction3 d);

}  // namespace capstan::recognise
