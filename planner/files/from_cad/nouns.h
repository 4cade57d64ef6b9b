#pragma once

#include <string>
#include <vector>

#include "planner/ground/geometry/placement.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::from_cad {

using geometry::Vec2;
using geometry::Vec3;
using model::AnyRef;
using model::Ref;

/// A piece of a plane boundary: a straight line, or an arc.
struct Piece {
  Vec2 from, to;
  Vec2 centre;
  double radius_mm = 0.0;  ///< 0: straight
  double sweep_rad = 0.0;  ///< arcs: positive counter-clockwise
  bool open = false;       ///< no wall stands there: the edge of the raw piece
  [[nodiscard]] bool arc() const { return radius_mm > 0.0; }
};

/// Makes the nouns that features are written with. Units  mm, rad; where an arc is trimmed by parameter, its
/// PARAMETER_VALUEs are degrees.
class Nouns {
 public:
  explicit Nouns(model::Model& m) : m_(m) {}
  Ref<model::CartesianPoint> point(Vec3 p);
  Ref<model::Direction> direction(Vec3 d);
  Ref<model::Axis2Placement3d> placement(const geometry::Placement& at);
  Ref<model::TolerancedLengthMeasure> length(double mm);
  /// The plane so far below the top of a feature.
  Ref<model::Plane> depth(double mm);
  /// A polyline; a composite curve where there are arcs. `closed`: back to where it began.
  Ref<model::BoundedCurve> curve(const std::vector<Piece>& pieces, bool closed);
  /// Rectangle, circle or general profile, whichever says the boundary shortest. Of a rectangle with equal
  /// round corners the radius goes to `corner_mm`.
  Ref<model::ClosedProfile> closed_profile(const std::vector<Piece>& pieces, double& corner_mm);
  Ref<model::OpenProfile> open_profile(const std::vector<Piece>& pieces);

 private:
  model::Model& m_;
};

}  // namespace capstan::from_cad
