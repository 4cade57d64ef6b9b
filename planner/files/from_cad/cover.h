#pragma once

#include <vector>

#include "planner/files/from_cad/solid/part.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::from_cad {

/// What a feature as it is written would take out of the part.
struct Cut {
  AnyRef feature;
  double volume_mm3 = 0.0;
};

/// Features, as the planner reads them, that cut into the part.
///
/// Accuracy  a lattice of some 60,000 points in the raw piece, at least four layers across each side; what is
///           thinner than its spacing may not be seen, and a point nearer than 0.04 mm to a surface is not
///           counted. Beside it 0.1 mm below the middle of each triangle of the part's faces, so that
///           fillets from 0.8 mm on are seen on a part of any size.
[[nodiscard]] std::vector<Cut> cuts_into(const Part& part, const model::Model& m);

/// What lies in the raw piece, not in the part, and in no feature.
struct Missing {
  double volume_mm3 = 0.0;  ///< 0: nothing is seen
  Vec3 at;                  ///< the middle of its points
};

/// Accuracy  the lattice of cuts_into. `all`: every face is in a feature, so that any point counts. Else more
///           points than the lattice's own error, the root of the number of its cells that the part's surface
///           meets; what the faces that are left out would take away is counted with it.
[[nodiscard]] Missing not_covered(const Part& part, const model::Model& m, bool all);

}  // namespace capstan::from_cad
