#include "planner/door/app/show/inspect_shapes.h"

#include <map>

#include "planner/door/app/show/inspect.h"
#include "planner/door/app/show/inspect_features.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"

namespace capstan::app {
namespace {

using exchange::Body;
using exchange::Brep;
using exchange::Carrier;
using exchange::Convexity;
using exchange::Edge;
using exchange::Face;
using service::box_text;
using service::table;
using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t kShownBodies = 40;

std::string bodies_of(const Brep& shapes) {
  Rows rows;
  for (const Body& b : shapes.bodies) {
    if (rows.size() == kShownBodies) {
      rows.push_back({"and " + std::to_string(shapes.bodies.size() - kShownBodies) + " more"});
      break;
    }
    rows.push_back({(b.id != 0 ? "#" + std::to_string(b.id) : std::string("-")), b.solid ? "solid" : "sheet",
                    counted(b.face_count, "face", "faces"),
                    b.solid ? trimmed(b.volume, 3) + " mm3" : "no volume", trimmed(b.area, 3) + " mm2",
                    b.name.empty() ? "" : "'" + b.name + "'"});
    // As `--body` takes it, where there is a choice.
    if (shapes.bodies.size() > 1) rows.back().insert(rows.back().begin(), std::to_string(rows.size()));
  }
  return "\nBodies (" + std::to_string(shapes.bodies.size()) + ")\n" + table(rows);
}

/// Holes and fillets are told from bosses and rounds, which a cutter reaches in other ways.
std::string faces_of(const Brep& shapes) {
  struct Kind {
    std::size_t faces = 0, inward = 0;
    double area_mm2 = 0;
  };
  std::map<Carrier, Kind> kinds;
  for (const Face& f : shapes.faces) {
    Kind& kind = kinds[f.carrier];
    ++kind.faces;
    if (!f.outward) ++kind.inward;
    kind.area_mm2 += f.area;
  }
  Rows rows;
  for (const auto& [carrier, kind] : kinds) {
    std::string inward;
    if (kind.inward != 0)
      inward = std::to_string(kind.inward) + " with the material outside (holes, fillets)";
    rows.push_back(
        {to_text(carrier), std::to_string(kind.faces), trimmed(kind.area_mm2, 3) + " mm2", inward});
  }
  return "\nFaces by carrier (" + std::to_string(shapes.faces.size()) + ")\n" + table(rows);
}

std::string edges_of(const Brep& shapes) {
  std::map<Convexity, std::size_t> kinds;
  for (const Edge& e : shapes.edges) ++kinds[e.convexity];
  Rows rows;
  for (const auto& [convexity, n] : kinds) {
    const char* name = convexity == Convexity::kConvex    ? "convex"
                       : convexity == Convexity::kConcave ? "concave"
                       : convexity == Convexity::kSmooth  ? "smooth"
                                                          : "open";
    rows.push_back({name, std::to_string(n)});
  }
  return "\nEdges by angle (" + std::to_string(shapes.edges.size()) + ")\n" + table(rows);
}

}  // namespace

std::string inspect(const Brep& shapes, const std::vector<Diagnostic>& diagnostics) {
  double volume_mm3 = 0.0, area_mm2 = 0.0;
  std::size_t solids = 0;
  for (const Body& b : shapes.bodies) {
    volume_mm3 += b.volume;
    area_mm2 += b.area;
    solids += b.solid ? 1U : 0U;
  }
  std::string out = "CAD model  " + counted(solids, "solid", "solids");
  if (const std::size_t sheets = shapes.bodies.size() - solids; sheets != 0)
    out += ", " + counted(sheets, "sheet", "sheets");
  out += "\nUnit       " + shapes.unit + (shapes.unit == "mm" ? "" : "; shown in mm");
  out += "\nBox        " + box_text(shapes.box);
  out += "\nVolume     " + trimmed(volume_mm3, 3) + " mm3";
  out += "\nArea       " + trimmed(area_mm2, 3) + " mm2";
  out += "\nTriangles  " + std::to_string(shapes.triangles.size()) + ", within " + trimmed(shapes.chord, 4) +
         " mm of the surfaces\n";
  return out + bodies_of(shapes) + faces_of(shapes) + edges_of(shapes) + recognised_features(shapes) +
         faults(diagnostics);
}

}  // namespace capstan::app
