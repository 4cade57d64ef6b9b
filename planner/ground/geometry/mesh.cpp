#include "planner/ground/geometry/mesh.h"

namespace capstan::geometry {

Box3 bounds(const Mesh& mesh) {
  Box3 box;
  for (const Vec3& v : mesh.vertices) box.add(v);
  return box;
}

}  // namespace capstan::geometry
