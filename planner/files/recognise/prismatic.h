#pragma once

#include <optional>
#include <vector>

#include "planner/files/recognise/graph.h"

namespace capstan::recognise {

/// What a feature is recognised in: the body, its graph and its raw piece.
struct Context {
  const exchange::Brep& brep;
  const Graph& graph;
  const RawBox& raw;
};

/// Recognises walls along one direction, with a floor or without, as a pocket, a slot, a step, a chamfer or a
/// plane face. `patches` are those that concave edges and fillets tie together.
///
/// Leaves  nothing where no direction has all of them for walls, floors or blends between them.
[[nodiscard]] std::optional<Feature> prismatic(const Context& context,
                                               const std::vector<std::uint32_t>& patches);

/// The faces of some patches, ascending.
[[nodiscard]] std::vector<std::uint32_t> faces_of(const Graph& graph,
                                                  const std::vector<std::uint32_t>& patches);

/// How far some patches reach along a direction: lowest and highest corner, mm.
struct Extent {
  double lo = 0;
  double hi = 0;
  [[nodiscard]] double length() const { return hi - lo; }
};
[[nodiscard]] Extent extent_along(const Context& context, const std::vector<std::uint32_t>& patches,
                                  Direction3 along);

}  // namespace capstan::recognise
