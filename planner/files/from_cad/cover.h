#pragma once

#include <vector>

#include "planner/files/from_cad/part.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::from_cad {

/// What a feature as it is written would take out of the part.
struct Cut {
  AnyRef feature;
  double volume_mm3 = 0.0;
};

/// Features, as the planner reads them, that cut into the part.
///
/// Accuracy  a lattice of some 100,000 points in the raw piece; what is thinner than its spacing is not seen,
///           and a point nearer than a fiftieth of it to a surface is not counted.
[[nodiscard]] std::vector<Cut> cuts_into(const Part& part, const model::Model& m);

/// What lies in the raw piece, not in the part, and in no feature.
struct Missing {
  double volume_mm3 = 0.0;  ///< 0: nothing is seen
  Vec3 at;                  ///< the middle of its points
};

/// Accuracy  as cuts_into. `all`: every face is in a feature, so that any point counts; else only more than
///           the lattice's own error does.
[[nodiscard]] Missing not_covered(const Part& part, const model::Model& m, bool all);

}  // namespace capstan::from_cad
