#include "tests/support/plate.h"

#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"

namespace capstan::testing {
namespace {

constexpr double kCell = 14.0;       // mm between features
constexpr double kThickness = 20.0;  // mm

/// Instances, numbered as they are added.
class Writer {
 public:
  std::string add(const std::string& instance) {
    const std::string name = "#" + std::to_string(++n_);
    text_ += name + "=" + instance + ";\n";
    return name;
  }

  std::string point(double x, double y, double z) {
    return add("CARTESIAN_POINT('',(" + real(x) + "," + real(y) + "," + real(z) + "))");
  }

  std::string place(double x, double y, double z) {
    return add("AXIS2_PLACEMENT_3D(''," + point(x, y, z) + "," + up_ + "," + along_ + ")");
  }

  std::string size(double mm, const std::string& limits) {
    return add("TOLERANCED_LENGTH_MEASURE(" + real(mm) + "," + limits + ")");
  }

  std::string limits(double upper, double lower) {
    return add("PLUS_MINUS_VALUE(" + real(upper) + "," + real(lower) + ",3)");
  }

  void directions() {
    up_ = add("DIRECTION('',(0.,0.,1.))");
    along_ = add("DIRECTION('',(1.,0.,0.))");
  }

  static std::string real(double v) {
    std::string s = shortest(v);
    if (s.find_first_of(".e") == std::string::npos) s += ".";
    return s;
  }

  std::string text_;

 private:
  int n_ = 0;
  std::string up_, along_;
};

/// The raw and the finished piece in one set-up, and the project. Gives the finished piece.
std::string begun(Writer& w, double length_mm, double width_mm) {
  const std::string material = w.add("MATERIAL('C45','STEEL',())");
  const std::string block =
      w.add("BLOCK('RAW PIECE'," + w.place(0.0, 0.0, -kThickness) + "," + Writer::real(length_mm) + "," +
            Writer::real(width_mm) + "," + Writer::real(kThickness) + ")");
  const std::string raw = w.add("WORKPIECE('RAW PIECE'," + material + ",$,$,$," + block + ",())");
  const std::string piece = w.add("WORKPIECE('PLATE'," + material + ",0.1," + raw + ",$,$,())");
  const std::string origin = w.place(0.0, 0.0, 0.0);
  const std::string security = w.add("PLANE('SECURITY PLANE'," + w.place(0.0, 0.0, 20.0) + ")");
  const std::string placed = w.add("WORKPIECE_SETUP(" + piece + "," + origin + ",$,$,())");
  const std::string setup = w.add("SETUP('SETUP'," + origin + "," + security + ",(" + placed + "))");
  const std::string plan = w.add("WORKPLAN('MAIN',(),$," + setup + ",$)");
  w.add("PROJECT('PLATE'," + plan + ",(" + piece + "),$,$,$)");
  return piece;
}

std::string file_of(const Writer& w) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
         "FILE_NAME('plate.p21','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('MACHINING_SCHEMA','MILLING_SCHEMA'));\nENDSEC;\nDATA;\n" +
         w.text_ + "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// `holes_only`: every feature is a through hole.
Plate made(std::size_t features, double first_pocket_mm, bool holes_only) {
  Plate out;
  out.features = features;
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(1.6 * static_cast<double>(features))));
  const std::size_t rows = (features + columns - 1) / columns;
  out.length_mm = kCell * static_cast<double>(columns);
  out.width_mm = kCell * static_cast<double>(rows);

  Writer w;
  w.directions();
  const std::string piece = begun(w, out.length_mm, out.width_mm);

  const std::string coarse = w.limits(0.2, 0.2);
  const std::string medium = w.limits(0.1, 0.1);
  const std::string h7 = w.limits(0.015, 0.0);
  const std::string through = w.add("THROUGH_BOTTOM_CONDITION()");
  const std::string flat = w.add("PLANAR_POCKET_BOTTOM_CONDITION()");
  const std::string through_depth = w.add("PLANE(''," + w.place(0.0, 0.0, -kThickness) + ")");
  const std::string pocket_depth = w.add("PLANE(''," + w.place(0.0, 0.0, -3.0) + ")");
  const std::string first_depth =
      first_pocket_mm == 3.0 ? pocket_depth : w.add("PLANE(''," + w.place(0.0, 0.0, -first_pocket_mm) + ")");
  for (std::size_t i = 0; i < features; ++i) {
    const double x = kCell * (static_cast<double>(i % columns) + 0.5);
    const double y = kCell * (static_cast<double>(i / columns) + 0.5);
    const std::string at = w.place(x, y, 0.0);
    const std::string name = "'F" + std::to_string(i + 1) + "'";
    switch (holes_only ? 0 : i % 4) {
      case 1: {
        const std::string profile =
            w.add("RECTANGULAR_CLOSED_PROFILE($," + w.size(8.0, medium) + "," + w.size(10.0, medium) + ")");
        const std::string corner = w.size(2.5, coarse);
        w.add("CLOSED_POCKET(" + name + "," + piece + ",()," + at + "," +
              (i == 1 ? first_depth : pocket_depth) + ",(),$," + flat + ",$," + corner + "," + profile + ")");
        ++out.pockets;
        break;
      }
      case 3:
        w.add("ROUND_HOLE(" + name + "," + piece + ",()," + at + "," + through_depth + "," + w.size(8.0, h7) +
              ",$," + through + ")");
        ++out.dowel_holes;
        break;
      default:
        w.add("ROUND_HOLE(" + name + "," + piece + ",()," + at + "," + through_depth + "," +
              w.size(6.6, coarse) + ",$," + through + ")");
        ++out.holes;
    }
  }
  out.text = file_of(w);
  return out;
}

}  // namespace

Plate plate(std::size_t features, double first_pocket_mm) { return made(features, first_pocket_mm, false); }

Plate plate_of_holes(std::size_t holes) { return made(holes, 3.0, true); }

std::string plate_of_a_polygon(std::size_t vertices) {
  constexpr double kSide = 150.0, kDepth = 3.0, kRadius = 50.0, kWave = 6.0;  // mm
  Writer w;
  w.directions();
  const std::string piece = begun(w, kSide, kSide);
  const std::string flat = w.add("PLANAR_POCKET_BOTTOM_CONDITION()");
  const std::string depth = w.add("PLANE(''," + w.place(0.0, 0.0, -kDepth) + ")");
  const std::string corner = w.size(2.5, w.limits(0.1, 0.1));
  std::string points;
  std::string first;
  for (std::size_t i = 0; i < vertices; ++i) {
    const double t = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(vertices);
    const double r = kRadius + kWave * std::sin(5.0 * t);
    const std::string point =
        w.point(std::round(r * std::cos(t) * 1e6) / 1e6, std::round(r * std::sin(t) * 1e6) / 1e6, 0.0);
    if (first.empty()) first = point;
    points += point + ",";
  }
  const std::string outline = w.add("POLYLINE('',(" + points + first + "))");
  const std::string profile = w.add("GENERAL_CLOSED_PROFILE($," + outline + ")");
  w.add("CLOSED_POCKET('P'," + piece + ",()," + w.place(0.5 * kSide, 0.5 * kSide, 0.0) + "," + depth +
        ",(),$," + flat + ",$," + corner + "," + profile + ")");
  return file_of(w);
}

std::string with_tool_changed(std::string table, const std::string& words, const std::string& key,
                              double by_mm) {
  const auto named = table.find(words);
  if (named == std::string::npos) return {};
  const auto before = table.rfind('\n', named);
  const auto of = before == std::string::npos ? 0 : before + 1;
  const auto at = table.find(key + "+", of);
  if (at == std::string::npos || at > table.find('\n', named)) return {};
  const auto end = table.find(' ', at);
  const double now = parse_double(table.substr(at + 2, end - at - 2)).value_or(0.0) + by_mm;
  return table.replace(at, end - at, key + "+" + shortest(now));
}

}  // namespace capstan::testing
