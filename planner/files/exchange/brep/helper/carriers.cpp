#include "planner/files/exchange/brep/helper/carriers.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <Geom2d_Curve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <cmath>

namespace capstan::exchange {
namespace {

/// Sine between the two directions of a surface below which it counts as a pole. A default without a source.
constexpr double kLeastNormal = 1e-9;

geometry::Vec3 vec(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }
geometry::Vec3 vec(const gp_Pnt& p) { return vec(p.XYZ()); }

bool reversed(const TopoDS_Shape& s) { return s.Orientation() == TopAbs_REVERSED; }

/// A point of a face by its parameters; nothing where the surface has no normal.
std::optional<FacePoint> face_point(const BRepAdaptor_Surface& surface, const TopoDS_Face& face, double u,
                                    double v) {
  gp_Pnt p;
  gp_Vec du, dv;
  surface.D1(u, v, p, du, dv);
  const gp_Vec n = du.Crossed(dv);
  const double length = n.Magnitude();
  if (!(length > kLeastNormal * du.Magnitude() * dv.Magnitude())) return std::nullopt;
  return FacePoint{vec(p), vec(n.XYZ() / (reversed(face) ? -length : length))};
}

/// Some point of a face that has a normal, near the middle of an edge.
std::optional<FacePoint> some_point(const BRepAdaptor_Surface& surface, const TopoDS_Face& face) {
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    double first = 0, last = 0;
    const TopoDS_Edge& edge = TopoDS::Edge(e.Current());
    if (BRep_Tool::Degenerated(edge)) continue;
    const auto curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (curve.IsNull()) continue;
    const gp_Pnt2d at = curve->Value(first + 0.47 * (last - first));
    if (auto p = face_point(surface, face, at.X(), at.Y())) return p;
  }
  return face_point(surface, face, 0.5 * (surface.FirstUParameter() + surface.LastUParameter()),
                    0.5 * (surface.FirstVParameter() + surface.LastVParameter()));
}

}  // namespace

void set_carrier(const TopoDS_Face& shape, Face& face) {
  const BRepAdaptor_Surface surface(shape);
  face.same_sense = !reversed(shape);
  const auto place = [&face](Carrier carrier, const gp_Pnt& point, const gp_Dir& axis, double radius) {
    face.carrier = carrier;
    face.point = vec(point.XYZ());
    face.axis = vec(axis.XYZ());
    face.radius = radius;
  };
  switch (surface.GetType()) {
    case GeomAbs_Plane: {
      const gp_Ax3 placed = surface.Plane().Position();
      place(Carrier::kPlane, placed.Location(),
            placed.Direct() ? placed.Direction() : placed.Direction().Reversed(), 0);
      return;
    }
    case GeomAbs_Cylinder:
      place(Carrier::kCylinder, surface.Cylinder().Location(), surface.Cylinder().Axis().Direction(),
            surface.Cylinder().Radius());
      break;
    case GeomAbs_Cone: {
      const gp_Cone cone = surface.Cone();
      const gp_Dir axis = cone.Axis().Direction();
      place(Carrier::kCone, cone.Location(), cone.SemiAngle() < 0 ? axis.Reversed() : axis, cone.RefRadius());
      face.half_angle = std::abs(cone.SemiAngle());
      break;
    }
    case GeomAbs_Sphere:
      place(Carrier::kSphere, surface.Sphere().Location(), surface.Sphere().Position().Direction(),
            surface.Sphere().Radius());
      break;
    case GeomAbs_Torus:
      place(Carrier::kTorus, surface.Torus().Location(), surface.Torus().Axis().Direction(),
            surface.Torus().MajorRadius());
      face.minor_radius = surface.Torus().MinorRadius();
      break;
    case GeomAbs_BezierSurface:
    case GeomAbs_BSplineSurface:
      face.carrier = Carrier::kSpline;
      return;
    default:
      face.carrier = Carrier::kOther;
      return;
  }
  if (const auto at = some_point(surface, shape)) set_senses(*at, face);
}

void set_curve(const TopoDS_Edge& shape, Edge& edge) {
  const BRepAdaptor_Curve curve(shape);
  const double first = curve.FirstParameter(), last = curve.LastParameter();
  edge.start = vec(curve.Value(first));
  edge.end = BRep_Tool::IsClosed(shape) ? edge.start : vec(curve.Value(last));
  edge.middle = vec(curve.Value(0.5 * (first + last)));
  edge.length = GCPnts_AbscissaPoint::Length(curve);
  switch (curve.GetType()) {
    case GeomAbs_Line:
      edge.curve = Curve::kLine;
      edge.axis = vec(curve.Line().Direction().XYZ());
      break;
    case GeomAbs_Circle:
      edge.curve = Curve::kCircle;
      edge.centre = vec(curve.Circle().Location());
      edge.axis = vec(curve.Circle().Axis().Direction().XYZ());
      edge.radius = curve.Circle().Radius();
      break;
    case GeomAbs_Ellipse:
      edge.curve = Curve::kEllipse;
      edge.centre = vec(curve.Ellipse().Location());
      edge.axis = vec(curve.Ellipse().Axis().Direction().XYZ());
      edge.radius = curve.Ellipse().MajorRadius();
      edge.minor_radius = curve.Ellipse().MinorRadius();
      break;
    case GeomAbs_BezierCurve:
    case GeomAbs_BSplineCurve:
      edge.curve = Curve::kSpline;
      break;
    default:
      edge.curve = Curve::kOther;
  }
}

std::optional<Side> side_at(const TopoDS_Edge& edge, bool forward, const TopoDS_Face& face, double part) {
  double first = 0, last = 0;
  // A seam has two curves in the face's parameters; its orientation in the forward face says which.
  const bool natural = forward != reversed(face);
  const TopoDS_Face plain = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const auto on_face = BRep_Tool::CurveOnSurface(
      TopoDS::Edge(edge.Oriented(natural ? TopAbs_FORWARD : TopAbs_REVERSED)), plain, first, last);
  if (on_face.IsNull()) return std::nullopt;
  const double at = first + part * (last - first);
  const gp_Pnt2d uv = on_face->Value(at);
  const auto p = face_point(BRepAdaptor_Surface(plain), face, uv.X(), uv.Y());
  if (!p) return std::nullopt;
  gp_Pnt on_curve;
  gp_Vec along;
  BRepAdaptor_Curve(edge).D1(at, on_curve, along);
  return side_of(p->normal, vec(along.XYZ() * (forward ? 1.0 : -1.0)));
}

}  // namespace capstan::exchange
