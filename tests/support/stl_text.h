#pragma once

#include <string>

#include "planner/ground/geometry/mesh.h"

namespace capstan::testing {

/// A mesh as a text STL file; normals are 0, for readers make their own.
inline std::string stl_text(const geometry::Mesh& mesh) {
  std::string out = "solid part\n";
  for (const auto& t : mesh.triangles) {
    out += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t i : t) {
      const geometry::Vec3 v = mesh.vertices[i];
      out += "vertex " + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + "\n";
    }
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid part\n";
}

}  // namespace capstan::testing
