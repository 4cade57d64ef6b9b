#pragma once

#include <optional>

#include "planner/files/exchange/brep/brep.h"
#include "planner/files/exchange/brep/helper/senses.h"

class TopoDS_Edge;
class TopoDS_Face;

namespace capstan::exchange {

/// Sets the carrier of a face: kind, placement, sizes and senses. The face has a surface.
void set_carrier(const TopoDS_Face& shape, Face& face);

/// Sets the curve of an edge: kind, ends, placement, sizes and length.
void set_curve(const TopoDS_Edge& shape, Edge& edge);

/// The side of a face at a part (0..1) of the way along an edge, which is walked forward or not; nothing
/// where surface or curve have no direction.
[[nodiscard]] std::optional<Side> side_at(const TopoDS_Edge& edge, bool forward, const TopoDS_Face& face,
                                          double part);

}  // namespace capstan::exchange
