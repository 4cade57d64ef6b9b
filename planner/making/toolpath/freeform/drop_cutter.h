#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/profile.h"
#include "planner/ground/geometry/vec.h"

namespace capstan::toolpath::freeform {

/// A flat, ball or bull-nosed cutter: a disc of radius `disc_mm`, grown by a ball of radius `ball_mm`.
struct Toroid {
  double disc_mm = 0.0;
  double ball_mm = 0.0;
  [[nodiscard]] double radius() const { return disc_mm + ball_mm; }
};

/// The toroid a profile describes; nothing for cones and other outlines.
[[nodiscard]] std::optional<Toroid> toroid_of(const geometry::CutterProfile& profile);

/// What of a mill meets a surface: a toroid where it is one, which is quickest, else any convex outline.
class MillEnd {
 public:
  MillEnd() = default;
  MillEnd(const Toroid& t) : shape_(t) {}
  MillEnd(const geometry::ConvexOutline& o) : shape_(o) {}

  [[nodiscard]] double radius() const;
  /// Height above the tip at distance r from the axis; +inf outside.
  [[nodiscard]] double height(double r) const;
  /// How far from the axis a plane touches that rises outwards by `slope` > 0.
  [[nodiscard]] double touch_radius(double slope) const;
  /// The radius of the largest ball that, rolled inside, reaches all of it; 0 where it has a corner.
  [[nodiscard]] double ball_mm() const;
  /// Calls `f` with the toroid or the outline, grown all round by `by_mm`.
  template <class F>
  decltype(auto) grown(double by_mm, const F& f) const;

 private:
  std::variant<Toroid, geometry::ConvexOutline> shape_;
};

/// Nothing for a hollow outline.
[[nodiscard]] std::optional<MillEnd> mill_end_of(const geometry::CutterProfile& profile);

/// Lets a cutter down on a mesh, along z, until it touches: facets, edges and vertices in closed form (an
/// edge that is neither a ball's nor a flat cutter's by bisection to the last bits). The mesh may have holes,
/// folds, duplicates and triangles of any orientation; triangles of no area count with their edges.
///
/// Units  mm. Frame: the mesh's.
/// Needs  finite vertices and triangles that name existing vertices (else std::logic_error).
/// Source derived: tangency of a rotating convex outline with plane, line and point.
class DropCutter {
 public:
  static constexpr double kNoContact = -std::numeric_limits<double>::infinity();

  explicit DropCutter(const geometry::Mesh& mesh);

  /// Lowest height of the tip on the axis (x, y) at which a cutter, grown all round by `allowance_mm`, is
  /// clear of the mesh, so that the cutter keeps that distance; kNoContact beside the mesh.
  /// Needs  allowance >= 0.
  [[nodiscard]] double drop(const MillEnd& cutter, double x, double y, double allowance_mm = 0.0) const;

  /// As above; `hint` (0 at first) carries the last contact along, which saves time where points are near
  /// each other and changes nothing else.
  [[nodiscard]] double drop(const MillEnd& cutter, double x, double y, double allowance_mm,
                            std::uint32_t& hint) const;

  /// Whether drop(cutter, x, y, allowance_mm) <= z_mm, which is told sooner than the height.
  [[nodiscard]] bool is_clear(const MillEnd& cutter, geometry::Vec2 p, double z_mm, double allowance_mm,
                              std::uint32_t& hint) const;
  /// Whether it meets the mesh at all there.
  [[nodiscard]] bool meets(const MillEnd& cutter, geometry::Vec2 p, double allowance_mm,
                           std::uint32_t& hint) const;

  /// As above for many points; points near each other should follow each other (rows in turn, to and fro).
  /// Uses job.threads; the result does not depend on it.
  [[nodiscard]] std::vector<double> drop(const MillEnd& cutter, const std::vector<geometry::Vec2>& points,
                                         double allowance_mm, const Job& job) const;

  [[nodiscard]] const geometry::Box3& bounds() const { return bounds_; }
  [[nodiscard]] std::size_t triangles() const { return facets_.size(); }

 private:
  struct Facet {
    geometry::Vec2 a, b, c;     ///< counter-clockwise from above
    double z = 0.0, top = 0.0;  ///< height at a; highest corner
    geometry::Vec2 slope;       ///< dz/dx, dz/dy
    geometry::Vec2 lean;        ///< unit vector of the normal's horizontal part, or zero
    double nxy = 0.0, nz = 0.0;
  };
  struct Edge {
    geometry::Vec2 a, unit;
    double z = 0.0, length = 0.0, slope = 0.0;
  };
  struct Node {
    double xlo = 0.0, ylo = 0.0, xhi = 0.0, yhi = 0.0, top = 0.0;
    std::uint32_t left = 0, right = 0;  ///< children; equal: a leaf, and its number
  };
  /// A plane that nothing of a node stands above (NodePlane), and what of its slope is asked for again.
  struct Plane {
    geometry::Vec2 slope;
    double base = 0.0;
    double rise = -1.0;  ///< length of the slope; below 0: there is no plane
    double lift = 0.0;   ///< sqrt(1 + rise^2) - 1
  };
  struct Leaf {
    std::uint32_t facet0 = 0, facet1 = 0, edge0 = 0, edge1 = 0, vertex0 = 0, vertex1 = 0;
  };
  class Builder;

  template <class Outline>
  void leaf(const Leaf& l, const Outline& t, double x, double y, double& best) const;
  template <class Outline>
  [[nodiscard]] double bound(std::uint32_t node, const Outline& t, double x, double y, double best) const;
  template <class Outline>
  [[nodiscard]] double search(const Outline& t, double x, double y, std::uint32_t& hint,
                              double from_mm = kNoContact, double to_mm = -kNoContact) const;

  std::vector<Facet> facets_;
  std::vector<Edge> edges_;
  std::vector<geometry::Vec3> vertices_;
  std::vector<Node> nodes_;
  std::vector<Plane> planes_;  ///< of the nodes
  std::vector<Leaf> leaves_;
  geometry::Box3 bounds_;
};

}  // namespace capstan::toolpath::freeform
