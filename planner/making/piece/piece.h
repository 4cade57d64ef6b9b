#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/making/draft/bans.h"
#include "planner/making/piece/neighbours.h"
#include "planner/model/features/shape.h"
#include "planner/model/plan/plan.h"

namespace capstan::piece {

using model::AnyRef;
using model::Ref;

/// A shape as it is drawn: its feature, and its number among those of a pattern or compound.
using Drawn = std::pair<AnyRef, int>;

/// The shapes of all features, workpiece coordinates.
struct Shapes {
  std::vector<model::FeatureShape> all;
  Neighbours near_all, near_whole;          ///< of `all` and of `whole`; of another size: not known
  std::vector<model::FeatureShape> whole;   ///< each once: elements and bosses count with what holds them
  std::vector<model::FeatureShape> faces;   ///< planar faces that are made: cut before the rest
  std::set<std::pair<Drawn, Drawn>> twins;  ///< shapes that are one removal, drawn twice; both ways
};

/// The features in the raw piece that they are cut from. Refers to what the caller keeps.
struct Piece {
  const model::Plan& plan;  ///< nouns, raw piece, mesh
  const Shapes& shapes;
  double grown_mm = 0.0;  ///< how far the raw piece was grown over the finished part, mm; 0: not
};

/// The box of the finished part, workpiece coordinates: its own, else the file's raw piece where a larger one
/// is cut. Raw material beyond it belongs to no feature.
[[nodiscard]] geometry::Box3 part_box(const Piece& piece);

/// The shapes of a feature in this raw piece: a hole right through reaches the underside.
[[nodiscard]] Result<std::vector<model::FeatureShape>> shapes_in_piece(const Piece& piece, AnyRef feature);

/// Whether two shapes ask for the same steps and cutters: members of a pattern.
[[nodiscard]] bool alike(const model::FeatureShape& a, const model::FeatureShape& b);

}  // namespace capstan::piece
