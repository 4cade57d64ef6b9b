#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/files/from_cad/areas.h"

namespace capstan::from_cad {

/// A piece of a hole along its axis: a cylinder, or a cone.
struct Bore {
  double top_mm = 0.0, bottom_mm = 0.0;                ///< along z of the hole's frame
  double top_radius_mm = 0.0, bottom_radius_mm = 0.0;  ///< equal: a cylinder
  [[nodiscard]] bool cone() const;
  [[nodiscard]] double height_mm() const;
};

enum class HoleEnd : std::uint8_t { kThrough, kFlat, kRounded, kConical, kSpherical };

/// A hole that is made from one side: bores from the mouth inwards, none wider than the one above it.
struct Hole {
  geometry::Placement frame;  ///< at the mouth, z out of the material
  std::vector<Bore> bores;    ///< heights from the mouth, 0 and below
  HoleEnd end = HoleEnd::kThrough;
  double tip_angle_rad = 0.0;  ///< conical: the full angle
  double end_radius_mm = 0.0;  ///< spherical: of the ball; rounded: of the fillet
  double lowest_mm = 0.0;      ///< spherical: the lowest place
  std::vector<std::uint32_t> faces;
  std::shared_ptr<const Hole> far;  ///< the cone at its far end, made from there
};

/// The hole that a feature of recognition is. Nothing, and `why` says it, for one that no tool reaches from
/// one side, or with a form that is not written yet.
[[nodiscard]] std::optional<Hole> hole_of(const Part& part, const recognise::Feature& feature,
                                          std::string& why);

/// Lets a hole begin where what lies above its mouth is cleared by rooms, else at the next room above it,
/// else at the raw piece's surface.
void raise(const Part& part, const std::vector<Room>& rooms, Hole& hole);

/// Gives a blind end to holes that go through into a cavity which no room and no hole makes, with the part
/// behind it: the planner cuts a through hole that ends in nothing down to the underside of the raw piece.
void end(const Part& part, const std::vector<Room>& rooms, std::vector<Hole>& holes);

/// round_hole, or counterbore_hole or countersunk_hole with its elements.
[[nodiscard]] AnyRef noun_of(const Hole& hole, model::Model& m, Ref<model::Workpiece> piece,
                             const std::string& number);

}  // namespace capstan::from_cad
