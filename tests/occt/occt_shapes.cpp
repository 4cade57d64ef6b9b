// What OpenCASCADE makes of a STEP file's shapes: occt_shapes FILE. A program of its own, so that its crash
// is not a test's.
#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <STEPControl_Reader.hxx>
#include <StepData_StepModel.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <TopExp_Explorer.hxx>
#include <XSControl_WorkSession.hxx>
#include <cstdio>

namespace {

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  int n = 0;
  for (TopExp_Explorer e(shape, kind); e.More(); e.Next()) ++n;
  return n;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: occt_shapes FILE\n", stderr);
    return 2;
  }
  STEPControl_Reader reader;
  if (reader.ReadFile(argv[1]) != IFSelect_RetDone) {
    std::puts("not read");
    return 1;
  }
  const Handle(StepData_StepModel) model = reader.StepModel();
  int points = 0;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    if (model->Value(i)->IsKind(STANDARD_TYPE(StepGeom_CartesianPoint))) ++points;
  }
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.OneShape();
  std::printf("points %d\n", points);
  if (shape.IsNull()) {
    std::puts("solids 0");
    return 0;
  }
  GProp_GProps volume;
  BRepGProp::VolumeProperties(shape, volume);
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box, false, false);
  double x0 = 0, y0 = 0, z0 = 0, x1 = 0, y1 = 0, z1 = 0;
  box.Get(x0, y0, z0, x1, y1, z1);
  std::printf("solids %d faces %d edges %d\nvolume %.3f\nbox %.3f %.3f %.3f to %.3f %.3f %.3f\n",
              count(shape, TopAbs_SOLID), count(shape, TopAbs_FACE), count(shape, TopAbs_EDGE), volume.Mass(),
              x0, y0, z0, x1, y1, z1);
  return 0;
}
