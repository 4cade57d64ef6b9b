#include "tests/removal/drawing.h"

#include <sstream>

namespace capstan::testing::removal {
namespace {

constexpr int kFirst = 100;  // number of the first instance that a part adds
constexpr int kWorkpiece = 4;

std::string real(double v) {
  std::ostringstream out;
  out.precision(12);
  out << v;
  std::string text = out.str();
  const auto e = text.find('e');
  if (text.find('.') == std::string::npos) text.insert(e == std::string::npos ? text.size() : e, ".");
  if (e != std::string::npos) text[text.find('e')] = 'E';
  return text;
}

std::string ref(int id) { return id == 0 ? "$" : "#" + std::to_string(id); }
std::string triple(Point p) { return "(" + real(p.x) + "," + real(p.y) + "," + real(p.z) + ")"; }

}  // namespace

std::string list_of(const std::vector<Drawing::Id>& ids) {
  std::string out = "(";
  for (const int id : ids) out += (out.size() > 1 ? ",#" : "#") + std::to_string(id);
  return out + ")";
}

Drawing::Drawing(std::string name, Box block) : name_(std::move(name)), block_(block) {}

Drawing::Id Drawing::write(const std::string& text) {
  const int id = kFirst + static_cast<int>(lines_.size());
  lines_.push_back("#" + std::to_string(id) + "=" + text + ";\n");
  return id;
}

std::string Drawing::text() const {
  const Point size{block_.hi.x - block_.lo.x, block_.hi.y - block_.lo.y, block_.hi.z - block_.lo.z};
  std::string out = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('" + name_ +
                    "','features only: every operation is left open'),'2;1');\nFILE_NAME('" + name_ +
                    ".p21','',(''),(''),'','','');\nFILE_SCHEMA(('MACHINING_SCHEMA','MILLING_SCHEMA'));\n"
                    "ENDSEC;\nDATA;\n";
  out += "#1=PROJECT('" + name_ + "',#2,(#4),$,$,$);\n#2=WORKPLAN('MAIN WORKPLAN',(),$,#8,$);\n";
  out += "#4=WORKPIECE('" + name_ + "',#6,0.1,#5,$,$,());\n#5=WORKPIECE('RAW PIECE',#6,$,$,$,#26,());\n";
  out += "#6=MATERIAL('" + material_ + "','',());\n#8=SETUP('SETUP1',#28,#31,(#9));\n";
  out += "#9=WORKPIECE_SETUP(#4,#28,$,$,());\n#21=DIRECTION('',(0.,0.,1.));\n#22=DIRECTION('',(1.,0.,0.));\n";
  out += "#24=CARTESIAN_POINT('RAW PIECE'," + triple(block_.lo) + ");\n";
  out += "#25=AXIS2_PLACEMENT_3D('RAW PIECE',#24,#21,#22);\n";
  out += "#26=BLOCK('RAW PIECE',#25," + real(size.x) + "," + real(size.y) + "," + real(size.z) + ");\n";
  out += "#27=CARTESIAN_POINT('SETUP',(0.,0.,0.));\n#28=AXIS2_PLACEMENT_3D('SETUP',#27,#21,#22);\n";
  out += "#29=CARTESIAN_POINT('SECURITY PLANE',(0.,0.," + real(block_.hi.z + 20.0) + "));\n";
  out += "#30=AXIS2_PLACEMENT_3D('SECURITY PLANE',#29,#21,#22);\n#31=PLANE('SECURITY PLANE',#30);\n";
  for (const std::string& line : lines_) out += line;
  return out + "ENDSEC;\nEND-ISO-10303-21;\n";
}

Drawing::Id Drawing::point(Point p) { return write("CARTESIAN_POINT(''," + triple(p) + ")"); }
Drawing::Id Drawing::direction(Point d) { return write("DIRECTION(''," + triple(d) + ")"); }

Drawing::Id Drawing::placement(Point p, Point axis, Point along) {
  const Id at = point(p), z = direction(axis), x = direction(along);
  return write("AXIS2_PLACEMENT_3D(''," + ref(at) + "," + ref(z) + "," + ref(x) + ")");
}

Drawing::Id Drawing::depth(double below) { return write("PLANE(''," + ref(placement({0, 0, -below})) + ")"); }

Drawing::Id Drawing::length(double nominal, double upper, double lower) {
  const Id t = write("PLUS_MINUS_VALUE(" + real(upper) + "," + real(lower) + ",3)");
  return write("TOLERANCED_LENGTH_MEASURE(" + real(nominal) + "," + ref(t) + ")");
}

Drawing::Id Drawing::polyline(const std::vector<Point>& points) {
  std::vector<Id> ids;
  for (const Point& p : points) ids.push_back(point(p));
  return write("POLYLINE(''," + list_of(ids) + ")");
}

Drawing::Id Drawing::arc(Point centre, double radius, double from_deg, double to_deg, bool ccw) {
  const Id circle = write("CIRCLE(''," + ref(placement(centre)) + "," + real(radius) + ")");
  return write("TRIMMED_CURVE(''," + ref(circle) + ",(PARAMETER_VALUE(" + real(from_deg) +
               ")),(PARAMETER_VALUE(" + real(to_deg) + "))," + (ccw ? ".T." : ".F.") + ",.PARAMETER.)");
}

Drawing::Id Drawing::composite(const std::vector<std::pair<Id, bool>>& segments, bool) {
  std::vector<Id> ids;
  for (const auto& [curve, same] : segments)
    ids.push_back(write(std::string("COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,") + (same ? ".T.," : ".F.,") +
                        ref(curve) + ")"));
  return write("COMPOSITE_CURVE(''," + list_of(ids) + ",.F.)");
}

Drawing::Id Drawing::rectangle(double length_x, double width_y) {
  const Id w = length(width_y), l = length(length_x);
  return write("RECTANGULAR_CLOSED_PROFILE($," + ref(w) + "," + ref(l) + ")");
}
Drawing::Id Drawing::circle(double diameter) {
  return write("CIRCULAR_CLOSED_PROFILE($," + ref(length(diameter)) + ")");
}
Drawing::Id Drawing::closed(Id curve) { return write("GENERAL_CLOSED_PROFILE($," + ref(curve) + ")"); }
Drawing::Id Drawing::open(Id curve) { return write("GENERAL_PROFILE($," + ref(curve) + ")"); }

std::string Drawing::head(const std::string& name, Id at) const {
  return "('" + name + "'," + ref(kWorkpiece) + ",()," + ref(at);
}

Drawing::Id Drawing::face(const std::string& name, double x0, double y0, double length_x, double length_y,
                          double raw_z, double below, const std::vector<Id>& bosses) {
  const Id at = placement({x0, y0, raw_z}), bottom = depth(below);
  const Id path = linear_path(length_y, {0, 1, 0});
  const Id size = write("NUMERIC_PARAMETER('profile length'," + real(length_x) + ",'mm')");
  const Id profile = write("LINEAR_PROFILE($," + ref(size) + ")");
  return write("PLANAR_FACE" + head(name, at) + "," + ref(bottom) + "," + ref(path) + "," + ref(profile) +
               ",$," + list_of(bosses) + ")");
}

Drawing::Id Drawing::boss(const std::string& name, Id at, double below, Id profile) {
  const Id bottom = depth(below);
  return write("BOSS" + head(name, at) + "," + ref(bottom) + "," + ref(profile) + ",$)");
}

Drawing::Id Drawing::closed_pocket(const std::string& name, Id at, double below, Id profile, double corner,
                                   const std::vector<Id>& bosses, double floor_radius, bool through) {
  const Id bottom = depth(below);
  const Id condition =
      write(through ? "THROUGH_POCKET_BOTTOM_CONDITION()" : "PLANAR_POCKET_BOTTOM_CONDITION()");
  const Id floor = floor_radius > 0.0 ? length(floor_radius) : 0;
  const Id radius = corner > 0.0 ? length(corner) : 0;
  return write("CLOSED_POCKET" + head(name, at) + "," + ref(bottom) + "," + list_of(bosses) + ",$," +
               ref(condition) + "," + ref(floor) + "," + ref(radius) + "," + ref(profile) + ")");
}

Drawing::Id Drawing::open_pocket(const std::string& name, Id at, double below, Id profile, double corner) {
  const Id bottom = depth(below);
  const Id condition = write("PLANAR_POCKET_BOTTOM_CONDITION()");
  const Id radius = corner > 0.0 ? length(corner) : 0;
  return write("OPEN_POCKET" + head(name, at) + "," + ref(bottom) + ",(),$," + ref(condition) + ",$," +
               ref(radius) + "," + ref(profile) + ",$)");
}

Drawing::Id Drawing::slot(const std::string& name, Id at, double below, Id path, Id profile,
                          const std::string& first, const std::string& last) {
  const auto end = [&](const std::string& kind) {
    if (kind == "open") return write("OPEN_SLOT_END_TYPE()");
    if (kind == "radiused") return write("RADIUSED_SLOT_END_TYPE()");
    if (kind.starts_with("woodruff"))
      return write("WOODRUFF_SLOT_END_TYPE(" + ref(length(std::stod(kind.substr(8)))) + ")");
    const Id corner = length(kind.size() > 4 ? std::stod(kind.substr(4)) : 0.0);
    const auto stroke = kind.find('/');
    const Id other = stroke == std::string::npos ? corner : length(std::stod(kind.substr(stroke + 1)));
    return write("FLAT_SLOT_END_TYPE(" + ref(corner) + "," + ref(other) + ")");
  };
  const Id bottom = depth(below), a = end(first), b = end(last);
  return write("SLOT" + head(name, at) + "," + ref(bottom) + "," + ref(path) + "," + ref(profile) + "," +
               list_of({a, b}) + ")");
}

Drawing::Id Drawing::linear_path(double distance, Point along) {
  const Id l = length(distance, 0.2), d = direction(along);
  return write("LINEAR_PATH($," + ref(l) + "," + ref(d) + ")");
}
Drawing::Id Drawing::square_u(double width, double angle, double radius) {
  const Id w = length(width), r = length(radius);
  return write("SQUARE_U_PROFILE($," + ref(w) + "," + ref(r) + "," + real(angle) + "," + ref(r) + "," +
               real(angle) + ")");
}
Drawing::Id Drawing::rounded_u(double width) {
  return write("ROUNDED_U_PROFILE($," + ref(length(width)) + ")");
}
Drawing::Id Drawing::vee(double angle, double tilt, double radius) {
  return write("VEE_PROFILE($," + ref(length(radius)) + "," + real(angle) + "," + real(tilt) + ")");
}
Drawing::Id Drawing::tee(double bar_width, double bar_depth, double width) {
  const Id bar = length(bar_width), high = length(bar_depth), round = length(0.0), neck = length(width);
  const Id offset = length(0.5 * (bar_width - width));
  return write("TEE_PROFILE($,90.,90.," + ref(bar) + "," + ref(high) + "," + ref(round) + "," + ref(neck) +
               "," + ref(offset) + "," + ref(offset) + ")");
}

Drawing::Id Drawing::step(const std::string& name, Id at, double below, double distance, Point along,
                          const std::vector<Id>& bosses) {
  const Id bottom = depth(below), path = linear_path(distance, along);
  return write("STEP" + head(name, at) + "," + ref(bottom) + "," + ref(path) + ",$," + list_of(bosses) + ")");
}

Drawing::Id Drawing::hole(const std::string& name, Id at, double below, double diameter, Id bottom, Id taper,
                          double tolerance) {
  return hole_of(name, at, below, length(diameter, tolerance), bottom, taper);
}
Drawing::Id Drawing::hole_of(const std::string& name, Id at, double below, Id diameter, Id bottom, Id taper) {
  const Id floor = depth(below);
  return write("ROUND_HOLE" + head(name, at) + "," + ref(floor) + "," + ref(diameter) + "," + ref(taper) +
               "," + ref(bottom) + ")");
}
Drawing::Id Drawing::through_bottom() { return write("THROUGH_BOTTOM_CONDITION()"); }
Drawing::Id Drawing::flat_bottom() { return write("FLAT_HOLE_BOTTOM()"); }
Drawing::Id Drawing::conical_bottom(double tip) { return write("CONICAL_HOLE_BOTTOM(" + real(tip) + ",$)"); }
Drawing::Id Drawing::spherical_bottom(double radius) {
  return write("SPHERICAL_HOLE_BOTTOM(" + ref(length(radius)) + ")");
}
Drawing::Id Drawing::angle_taper(double deg) { return write("ANGLE_TAPER(" + real(deg) + ")"); }
Drawing::Id Drawing::diameter_taper(double diameter) {
  return write("DIAMETER_TAPER(" + ref(length(diameter)) + ")");
}

Drawing::Id Drawing::compound(const std::string& name, Id at, const std::vector<Id>& elements,
                              const std::string& keyword) {
  return write(keyword + head(name, at) + "," + list_of(elements) + ")");
}

Drawing::Id Drawing::circular_pattern(const std::string& name, Id at, Id base, double increment, int number,
                                      double diameter, const std::vector<int>& omitted, double turned_deg) {
  std::vector<Id> missing;
  for (const int i : omitted) missing.push_back(write("CIRCULAR_OMIT(" + std::to_string(i) + ")"));
  const Id size = length(diameter);
  return write("CIRCULAR_PATTERN" + head(name, at) + "," + ref(base) + "," + real(increment) + "," +
               std::to_string(number) + ",()," + list_of(missing) + "," + ref(size) + "," + real(turned_deg) +
               ")");
}

Drawing::Id Drawing::rectangular_pattern(const std::string& name, Id at, Id base, double spacing, Point along,
                                         int columns, int rows, double row_spacing, Point rows_along) {
  const Id s = length(spacing), d = direction(along), rs = length(row_spacing), rd = direction(rows_along);
  return write("RECTANGULAR_PATTERN" + head(name, at) + "," + ref(base) + "," + ref(s) + "," + ref(d) + "," +
               std::to_string(rows) + "," + std::to_string(columns) + "," + ref(rs) + "," + ref(rd) +
               ",(),())");
}

Drawing::Id Drawing::general_pattern(const std::string& name, Id at, Id base, const std::vector<Id>& places) {
  return write("GENERAL_PATTERN" + head(name, at) + "," + ref(base) + "," + list_of(places) + ")");
}

Drawing::Id Drawing::thread(const std::string& name, Id at, double below, Id in, double major, double pitch) {
  const Id bottom = depth(below);
  const Id area = write("PARTIAL_AREA_DEFINITION(" + real(below) + "," + ref(at) + ",$)");
  const Id fit = write("DESCRIPTIVE_PARAMETER('fit class','6H')");
  const Id form = write("DESCRIPTIVE_PARAMETER('form','M')");
  const Id turns = write("NUMERIC_PARAMETER('threads per mm'," + real(1.0 / pitch) + ",'mm')");
  const Id hand = write("DESCRIPTIVE_PARAMETER('hand','right')");
  const double core = major - pitch;
  return write("DEFINED_THREAD" + head(name, at) + "," + ref(bottom) + "," + ref(area) + "," + list_of({in}) +
               ",.T.,$," + ref(fit) + "," + ref(form) + "," + real(major) + "," + ref(turns) + "," +
               ref(hand) + "," + real(major - 0.65 * pitch) + "," + real(core) + ",$)");
}

Drawing::Id Drawing::outside(const std::string& name, Id at, double below, Id profile) {
  const Id bottom = depth(below), path = linear_path(below, {0, 0, -1});
  return write("GENERAL_OUTSIDE_PROFILE" + head(name, at) + "," + ref(bottom) + "," + ref(path) + "," +
               ref(profile) + ")");
}

Drawing::Id Drawing::chamfer(const std::string& name, Id first, Id second, double angle, double width) {
  const Id w = length(width);
  return write("CHAMFER('" + name + "'," + ref(kWorkpiece) + ",()," + ref(first) + "," + ref(second) + "," +
               real(angle) + "," + ref(w) + ")");
}

}  // namespace capstan::testing::removal
