#pragma once

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "planner/files/exchange/brep/brep.h"
#include "planner/files/from_cad/solid/shadow.h"
#include "planner/files/recognise/recognise.h"

namespace capstan::from_cad {

using exchange::Brep;

/// Heights below this difference are one level. Twice what recognition takes for the same plane.
inline constexpr double kLevelMm = 2.0 * recognise::kSameLengthMm;

/// What a tool along one direction clears down to one height: nothing of the part stands above.
struct Cleared {
  geometry::Region raw;                 ///< of the raw piece above the height
  std::vector<geometry::Region> rooms;  ///< separate areas, each with what stands in it as holes
};

/// One solid in its raw piece, workpiece frame, mm.
class Part {
 public:
  Part(const Brep& brep, std::size_t body, const geometry::Box3& raw);

  [[nodiscard]] const Brep& brep() const { return brep_; }
  [[nodiscard]] const exchange::Body& body() const { return brep_.bodies[body_]; }
  [[nodiscard]] const geometry::Box3& raw() const { return raw_; }
  [[nodiscard]] const geometry::Mesh& mesh() const { return mesh_; }

  /// A frame with its z along a direction, at the origin of the workpiece.
  [[nodiscard]] static geometry::Placement frame_along(Vec3 access);
  /// The lowest and the highest place of the raw piece along z of a frame.
  [[nodiscard]] std::pair<double, double> raw_span(const geometry::Placement& frame) const;
  /// The same of some faces.
  [[nodiscard]] std::pair<double, double> span(const geometry::Placement& frame,
                                               const std::vector<std::uint32_t>& faces) const;
  /// What is cleared down to a height. `but`: faces that are not looked at, fillets at its floor.
  [[nodiscard]] const Cleared& cleared(const geometry::Placement& frame, double z_mm,
                                       const std::vector<std::uint32_t>& but) const;
  /// Circles that cylinders along z of a frame lie on.
  [[nodiscard]] std::vector<RoundWall> round_walls(const geometry::Placement& frame) const;

  /// Plane faces that stand upright along z of a frame.
  [[nodiscard]] std::vector<FlatWall> flat_walls(const geometry::Placement& frame) const;

  /// A place of a face: the middle of a triangle of it, with its area and its normal.
  struct Spot {
    Vec3 at, normal;
    double area_mm2 = 0.0;
  };
  [[nodiscard]] std::vector<Spot> spots(std::uint32_t face) const;

 private:
  const Brep& brep_;
  std::size_t body_;
  geometry::Box3 raw_;
  geometry::Mesh mesh_, raw_mesh_;
  std::vector<std::uint32_t> face_of_;  ///< per triangle of mesh_
  struct Key {
    Vec3 access;
    double z = 0.0;
    std::vector<std::uint32_t> but;
  };
  mutable std::deque<std::pair<Key, Cleared>> known_;
};

/// A plane normal of a face, out of the material.
[[nodiscard]] Vec3 normal_of(const exchange::Face& face);

/// All areas as one region.
[[nodiscard]] geometry::Region all_of(const Cleared& cleared);

/// The area in which a point lies; -1: in none. A point on a boundary counts as inside.
[[nodiscard]] int room_at(const Cleared& cleared, Vec2 p);

}  // namespace capstan::from_cad
