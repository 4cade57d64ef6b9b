// Makes cover.step, the CAD part of the first session: a plate of 100 x 70 x 20 mm with a step, a pocket with
// round corners, a slot, four through holes, a counterbored hole and a drilled one. AP242, mm; its top is z =
// 0. What is asked of it stands in the file as semantic PMI: a fit, deviations, a position with its datum, a
// flatness, textures. OpenCASCADE writes the shape; the PMI is put behind it here.
//
//   g++ -std=c++17 make_part.cpp -I/usr/include/opencascade -o make_part \
//       -lTKSTEP -lTKSTEPBase -lTKXSBase -lTKBO -lTKFillet -lTKPrim -lTKTopAlgo -lTKBRep -lTKG3d -lTKMath
//       -lTKernel
//   ./make_part cover.step

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Tool.hxx>
#include <Interface_Static.hxx>
#include <STEPConstruct.hxx>
#include <STEPControl_Writer.hxx>
#include <StepData_StepModel.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace {

// Hollows end this far above the top, so that no two faces coincide.
constexpr double kOver = 1.0;

TopoDS_Shape box(double x0, double y0, double x1, double y1, double depth) {
  return BRepPrimAPI_MakeBox(gp_Pnt(x0, y0, -depth), gp_Pnt(x1, y1, kOver)).Shape();
}

TopoDS_Shape with_round_corners(const TopoDS_Shape& pocket, double radius) {
  BRepFilletAPI_MakeFillet round(pocket);
  for (TopExp_Explorer e(pocket, TopAbs_EDGE); e.More(); e.Next()) {
    TopoDS_Vertex a, b;
    TopExp::Vertices(TopoDS::Edge(e.Current()), a, b);
    const gp_Pnt p = BRep_Tool::Pnt(a), q = BRep_Tool::Pnt(b);
    if (std::abs(p.X() - q.X()) + std::abs(p.Y() - q.Y()) < 1e-9)
      round.Add(radius, TopoDS::Edge(e.Current()));
  }
  return round.Shape();
}

TopoDS_Shape hole(double x, double y, double diameter, double depth) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, -depth), gp_Dir(0, 0, 1)), 0.5 * diameter,
                                  depth + kOver)
      .Shape();
}

// The point that a drill of 118 degrees leaves below a hole.
TopoDS_Shape point(double x, double y, double diameter, double depth) {
  const double radius = 0.5 * diameter;
  const double height = radius / std::tan(59.0 * M_PI / 180.0);
  return BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(x, y, -depth), gp_Dir(0, 0, -1)), radius, 0.0, height).Shape();
}

// The numbers of faces in the file.
class Faces {
 public:
  Faces(const TopoDS_Shape& part, const STEPControl_Writer& writer) : writer_(writer) {
    for (TopExp_Explorer f(part, TopAbs_FACE); f.More(); f.Next()) all_.push_back(TopoDS::Face(f.Current()));
  }
  // Cylinders of a diameter.
  std::vector<int> bores(double diameter) const {
    return those([=](const BRepAdaptor_Surface& s) {
      return s.GetType() == GeomAbs_Cylinder && std::abs(2.0 * s.Cylinder().Radius() - diameter) < 1e-9;
    });
  }
  // Planes that stand at a place along an axis: 0 is x, 2 is z.
  std::vector<int> planes(int axis, double at) const {
    return those([=](const BRepAdaptor_Surface& s) {
      if (s.GetType() != GeomAbs_Plane) return false;
      const gp_Ax1 normal = s.Plane().Axis();
      return std::abs(normal.Direction().Coord(axis + 1)) > 1.0 - 1e-9 &&
             std::abs(normal.Location().Coord(axis + 1) - at) < 1e-9;
    });
  }

 private:
  std::vector<int> those(const std::function<bool(const BRepAdaptor_Surface&)>& wanted) const {
    std::vector<int> out;
    for (const TopoDS_Face& f : all_) {
      if (!wanted(BRepAdaptor_Surface(f))) continue;
      const auto process = writer_.WS()->TransferWriter()->FinderProcess();
      out.push_back(writer_.WS()->Model()->Number(STEPConstruct::FindEntity(process, f)));
    }
    return out;
  }
  const STEPControl_Writer& writer_;
  std::vector<TopoDS_Face> all_;
};

// Writes instances behind those of a file.
class Pmi {
 public:
  explicit Pmi(const std::string& step) : text_(step) {
    shape_ = before("PRODUCT_DEFINITION_SHAPE(");
    representation_ = before("ADVANCED_BREP_SHAPE_REPRESENTATION(");
    mm_ = before("( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.)");
    for (std::size_t at = text_.find("\n#"); at != std::string::npos; at = text_.find("\n#", at + 1))
      last_ = std::max(last_, std::atoi(text_.c_str() + at + 2));
    um_ = add("( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MICRO.,.METRE.) )");
    context_ = add("( GEOMETRIC_REPRESENTATION_CONTEXT(3) REPRESENTATION_CONTEXT('PMI','') )");
  }

  int add(const std::string& entity) {
    more_ << "#" << ++last_ << " = " << entity << ";\n";
    return last_;
  }
  static std::string ref(int id) { return "#" + std::to_string(id); }
  static std::string list(const std::vector<int>& ids) {
    std::string out;
    for (const int id : ids) out += (out.empty() ? "(" : ",") + ref(id);
    return out + ")";
  }

  // What a statement is about: a face, or several together.
  int aspect(const std::vector<int>& faces, const std::string& kind = "SHAPE_ASPECT") {
    std::vector<int> each;
    for (const int f : faces) {
      each.push_back(add((faces.size() > 1 ? "SHAPE_ASPECT" : kind) + "('',''," + ref(shape_) + ",.T.)"));
      add("GEOMETRIC_ITEM_SPECIFIC_USAGE('',''," + ref(each.back()) + "," + ref(representation_) + "," +
          ref(f) + ")");
    }
    if (each.size() == 1) return each.front();
    const int all = add("COMPOSITE_SHAPE_ASPECT('',''," + ref(shape_) + ",.F.)");
    for (const int e : each) add("SHAPE_ASPECT_RELATIONSHIP('',''," + ref(all) + "," + ref(e) + ")");
    return all;
  }
  int length(const std::string& value, const std::string& name = "") { return measure(value, mm_, name); }

  int size(int aspect, const std::string& kind, const std::string& nominal) {
    return valued(add("DIMENSIONAL_SIZE(" + ref(aspect) + ",'" + kind + "')"), nominal);
  }
  int distance(int from, int to, const std::string& nominal) {
    return valued(add("DIMENSIONAL_LOCATION('linear distance',''," + ref(from) + "," + ref(to) + ")"),
                  nominal);
  }
  void deviate(int dimension, const std::string& lower, const std::string& upper) {
    const int from = length(lower), to = length(upper);
    tolerate(add("TOLERANCE_VALUE(" + ref(from) + "," + ref(to) + ")"), dimension);
  }
  void fit(int dimension, const std::string& letter, const std::string& grade) {
    tolerate(add("LIMITS_AND_FITS('" + letter + "','hole','" + grade + "','ISO 286')"), dimension);
  }
  // A datum of one compartment: its system.
  int datum(const std::vector<int>& faces, const std::string& letter) {
    const int feature = aspect(faces, "DATUM_FEATURE");
    const int datum = add("DATUM('',''," + ref(shape_) + ",.F.,'" + letter + "')");
    add("SHAPE_ASPECT_RELATIONSHIP('',''," + ref(feature) + "," + ref(datum) + ")");
    const int compartment =
        add("DATUM_REFERENCE_COMPARTMENT('',''," + ref(shape_) + ",.F.," + ref(datum) + ",$)");
    return add("DATUM_SYSTEM('',''," + ref(shape_) + ",.F.,(" + ref(compartment) + "))");
  }
  void position(int aspect, const std::string& diameter, int datums) {
    const int zone =
        add("( GEOMETRIC_TOLERANCE('',''," + ref(length(diameter)) + "," + ref(aspect) +
            ") GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE((" + ref(datums) + ")) POSITION_TOLERANCE() )");
    const int form = add("TOLERANCE_ZONE_FORM('cylindrical or circular')");
    add("TOLERANCE_ZONE('',''," + ref(shape_) + ",.F.,(" + ref(zone) + ")," + ref(form) + ")");
  }
  void flatness(int aspect, const std::string& value) {
    add("FLATNESS_TOLERANCE('',''," + ref(length(value)) + "," + ref(aspect) + ")");
  }
  void ra(int aspect, const std::string& micrometres) {
    const int property = add("PROPERTY_DEFINITION('surface_condition',''," + ref(aspect) + ")");
    const int value = measure(micrometres, um_, "Ra");
    const int method = add("DESCRIPTIVE_REPRESENTATION_ITEM('measuring method','ISO 21920')");
    const int texture =
        add("SURFACE_TEXTURE_REPRESENTATION(''," + list({value, method}) + "," + ref(context_) + ")");
    add("PROPERTY_DEFINITION_REPRESENTATION(" + ref(property) + "," + ref(texture) + ")");
  }

  std::string text() const {
    std::string out = text_;
    return out.insert(out.find("ENDSEC;\nEND-ISO"), more_.str());
  }

 private:
  int before(const std::string& what) const {
    const std::size_t from = text_.rfind("\n#", text_.find(what));
    return std::atoi(text_.c_str() + from + 2);
  }
  int measure(const std::string& value, int unit, const std::string& name) {
    return add(
        "( LENGTH_MEASURE_WITH_UNIT() MEASURE_REPRESENTATION_ITEM() MEASURE_WITH_UNIT(LENGTH_MEASURE(" +
        value + ")," + ref(unit) + ") REPRESENTATION_ITEM('" + name + "') )");
  }
  int valued(int dimension, const std::string& nominal) {
    const int value = length(nominal, "nominal value");
    const int shape = add("SHAPE_DIMENSION_REPRESENTATION(''," + list({value}) + "," + ref(context_) + ")");
    add("DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(" + ref(dimension) + "," + ref(shape) + ")");
    return dimension;
  }
  void tolerate(int range, int dimension) {
    add("PLUS_MINUS_TOLERANCE(" + ref(range) + "," + ref(dimension) + ")");
  }

  std::string text_;
  std::ostringstream more_;
  int shape_ = 0, representation_ = 0, mm_ = 0, um_ = 0, context_ = 0, last_ = 0;
};

// What is asked of the cover.
void ask(const Faces& faces, Pmi& pmi) {
  const int a = pmi.datum(faces.planes(2, -20.0), "A");
  const int screws = pmi.aspect(faces.bores(5.5));
  pmi.deviate(pmi.size(screws, "diameter", "5.5"), "0.", "0.12");
  pmi.position(screws, "0.3", a);
  pmi.fit(pmi.size(pmi.aspect(faces.bores(6.0)), "diameter", "6."), "H", "8");
  pmi.deviate(pmi.size(pmi.aspect(faces.bores(11.0)), "diameter", "11."), "0.", "0.18");
  const int left = pmi.aspect(faces.planes(0, 82.0)), right = pmi.aspect(faces.planes(0, 92.0));
  pmi.deviate(pmi.distance(left, right, "10."), "0.", "0.1");
  const int pocket_floor = pmi.aspect(faces.planes(2, -9.0));
  pmi.flatness(pocket_floor, "0.05");
  pmi.ra(pocket_floor, "1.6");
  pmi.ra(pmi.aspect(faces.planes(2, -6.0)), "3.2");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_part FILE\n";
    return 2;
  }
  constexpr double kThick = 20.0;
  TopoDS_Shape part = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, -kThick), gp_Pnt(100, 70, 0)).Shape();
  const TopoDS_Shape hollows[] = {box(-kOver, -kOver, 14, 71, 6),                 // step
                                  with_round_corners(box(30, 20, 70, 50, 9), 6),  // pocket
                                  box(82, -kOver, 92, 71, 5),                     // slot
                                  hole(22, 10, 5.5, kThick + kOver),
                                  hole(76, 10, 5.5, kThick + kOver),
                                  hole(22, 60, 5.5, kThick + kOver),
                                  hole(76, 60, 5.5, kThick + kOver),
                                  hole(50, 10, 11, 6.5),
                                  hole(50, 10, 6.6, kThick + kOver),  // counterbored, for a cap screw M6
                                  hole(50, 60, 6, 12),
                                  point(50, 60, 6, 12)};
  for (const TopoDS_Shape& hollow : hollows) part = BRepAlgoAPI_Cut(part, hollow).Shape();

  STEPControl_Writer writer;
  Interface_Static::SetCVal("write.step.schema", "AP242DIS");
  Interface_Static::SetCVal("write.step.unit", "MM");
  Interface_Static::SetCVal("write.step.product.name", "COVER");
  writer.Model(true);  // its header names the schema
  if (writer.Transfer(part, STEPControl_ManifoldSolidBrep) != IFSelect_RetDone) return 1;
  APIHeaderSection_MakeHeader header(writer.Model());
  const auto text = [](const char* t) { return new TCollection_HAsciiString(t); };
  header.SetName(text("cover.step"));
  header.SetTimeStamp(text("2024-01-01T00:00:00"));  // the same bytes whenever it is made
  header.SetAuthorValue(1, text(""));
  header.SetOrganizationValue(1, text(""));
  if (writer.Write(argv[1]) != IFSelect_RetDone) return 1;
  std::ostringstream step;
  step << std::ifstream(argv[1]).rdbuf();
  Pmi pmi(step.str());
  ask(Faces(part, writer), pmi);
  std::ofstream out(argv[1]);
  out << pmi.text();
  return out ? 0 : 1;
}
