// Makes cover.step, the CAD part of the first session: a plate of 100 x 70 x 20 mm with a step, a pocket with
// round corners, a slot, four through holes, a counterbored hole and a drilled one. AP242, mm; its top is z =
// 0.
//
//   g++ -std=c++17 make_part.cpp -I/usr/include/opencascade -o make_part \
//       -lTKSTEP -lTKXSBase -lTKBO -lTKFillet -lTKPrim -lTKTopAlgo -lTKBRep -lTKG3d -lTKMath -lTKernel
//   ./make_part cover.step

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Tool.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>
#include <StepData_StepModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <cmath>
#include <iostream>

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
  return writer.Write(argv[1]) == IFSelect_RetDone ? 0 : 1;
}
