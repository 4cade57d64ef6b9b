#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "planner/files/recognise/recognise.h"

namespace capstan::recognise {

/// Faces of one carrier that touch each other: one face as its designer saw it.
struct Patch {
  exchange::Carrier carrier = exchange::Carrier::kOther;
  Direction3 axis;    ///< plane: the outward normal; others: as in exchange::Face
  Point3 point;       ///< as in exchange::Face
  double offset = 0;  ///< mm: plane, along its outward normal from the origin
  double radius = 0;
  double minor_radius = 0;
  double half_angle = 0;
  bool outward = true;               ///< as in exchange::Face
  double area = 0;                   ///< mm2
  std::vector<std::uint32_t> faces;  ///< ascending
  std::vector<std::uint32_t> joins;  ///< into Graph::joins
  int side = -1;  ///< side of the raw piece that it lies on: 2 * axis, + 1 at its upper end
};

/// All edges of one convexity along which two patches meet.
struct Join {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  exchange::Convexity convexity = exchange::Convexity::kOpen;
  std::vector<std::uint32_t> edges;  ///< into Brep::edges

  [[nodiscard]] std::uint32_t other(std::uint32_t patch) const { return patch == a ? b : a; }
};

/// The attributed adjacency graph of a body.
struct Graph {
  std::vector<Patch> patches;
  std::vector<Join> joins;
};

/// The graph of a body. Patches stand in the order of their lowest face.
[[nodiscard]] Graph make_graph(const exchange::Brep& brep, const exchange::Body& body);

/// The box, along directions of plane faces, whose sides have most of the body's area on them. Marks the
/// patches that lie on its sides.
[[nodiscard]] RawBox make_raw_box(const exchange::Brep& brep, const exchange::Body& body, Graph& graph);

/// Whether two patches are parts of one surface, on the same side of it.
[[nodiscard]] bool same_surface(const Patch& a, const Patch& b);

/// Whether two directions are the same, the same or opposite, or at right angles, within kSameAngleRad.
[[nodiscard]] bool same_direction(Direction3 a, Direction3 b);
[[nodiscard]] bool parallel(Direction3 a, Direction3 b);
[[nodiscard]] bool perpendicular(Direction3 a, Direction3 b);

/// Groups of numbers that belong together, by union and find.
class Groups {
 public:
  explicit Groups(std::size_t count);
  void join(std::uint32_t a, std::uint32_t b);
  [[nodiscard]] std::uint32_t root(std::uint32_t a) const;  ///< the lowest of its group
  /// The numbers for which `counts` says so, by their groups: both from the lowest.
  template <class Counts>
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> members(const Counts& counts) const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_root;
    for (std::uint32_t a = 0; a < parent_.size(); ++a) {
      if (counts(a)) by_root[root(a)].push_back(a);
    }
    std::vector<std::vector<std::uint32_t>> out;
    out.reserve(by_root.size());
    for (auto& [lowest, all] : by_root) out.push_back(std::move(all));
    return out;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace capstan::recognise
