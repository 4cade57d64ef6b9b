#include "planner/model/nouns/geometric_item.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kRepresentation[] = {
    row<&Representation::name>("name", kRequired),
    row<&Representation::items>("items", kRequired),
    row<&Representation::context_of_items>("context_of_items", kRequired),
};
constexpr Attribute kRepresentationItem[] = {
    row<&RepresentationItem::name>("name", kRequired),
};
constexpr Attribute kTrimmedCurve[] = {
    row<&TrimmedCurve::basis_curve>("basis_curve", kRequired),
    row<&TrimmedCurve::trim_1>("trim_1", kRequired),
    row<&TrimmedCurve::trim_2>("trim_2", kRequired),
    row<&TrimmedCurve::sense_agreement>("sense_agreement", kRequired),
    row<&TrimmedCurve::master_representation>("master_representation", kRequired),
};
constexpr Attribute kCompositeCurve[] = {
    row<&CompositeCurve::segments>("segments", kRequired),
    row<&CompositeCurve::self_intersect>("self_intersect", kRequired),
};
constexpr Attribute kCompositeCurveSegment[] = {
    row<&CompositeCurveSegment::transition>("transition", kRequired),
    row<&CompositeCurveSegment::same_sense>("same_sense", kRequired),
    row<&CompositeCurveSegment::parent_curve>("parent_curve", kRequired),
};
constexpr Attribute kPlacement[] = {
    row<&Placement::location>("location", kRequired),
};
constexpr Attribute kAxis1Placement[] = {
    row<&Axis1Placement::axis>("axis", kOptional),
};
constexpr Attribute kAxis2Placement3d[] = {
    row<&Axis2Placement3d::axis>("axis", kOptional),
    row<&Axis2Placement3d::ref_direction>("ref_direction", kOptional),
};
constexpr Attribute kBSplineCurve[] = {
    row<&BSplineCurve::degree>("degree", kRequired),
    row<&BSplineCurve::control_points_list>("control_points_list", kRequired),
    row<&BSplineCurve::curve_form>("curve_form", kRequired),
    row<&BSplineCurve::closed_curve>("closed_curve", kRequired),
    row<&BSplineCurve::self_intersect>("self_intersect", kRequired),
};
constexpr Attribute kBSplineSurface[] = {
    row<&BSplineSurface::u_degree>("u_degree", kRequired),
    row<&BSplineSurface::v_degree>("v_degree", kRequired),
    row<&BSplineSurface::control_points_list>("control_points_list", kRequired),
    row<&BSplineSurface::surface_form>("surface_form", kRequired),
    row<&BSplineSurface::u_closed>("u_closed", kRequired),
    row<&BSplineSurface::v_closed>("v_closed", kRequired),
    row<&BSplineSurface::self_intersect>("self_intersect", kRequired),
};
constexpr Attribute kPcurve[] = {
    row<&Pcurve::basis_surface>("basis_surface", kRequired),
    row<&Pcurve::reference_to_curve>("reference_to_curve", kRequired),
};
constexpr Attribute kBSplineCurveWithKnots[] = {
    row<&BSplineCurveWithKnots::knot_multiplicities>("knot_multiplicities", kRequired),
    row<&BSplineCurveWithKnots::knots>("knots", kRequired),
    row<&BSplineCurveWithKnots::knot_spec>("knot_spec", kRequired),
};
constexpr Attribute kBSplineSurfaceWithKnots[] = {
    row<&BSplineSurfaceWithKnots::u_multiplicities>("u_multiplicities", kRequired),
    row<&BSplineSurfaceWithKnots::v_multiplicities>("v_multiplicities", kRequired),
    row<&BSplineSurfaceWithKnots::u_knots>("u_knots", kRequired),
    row<&BSplineSurfaceWithKnots::v_knots>("v_knots", kRequired),
    row<&BSplineSurfaceWithKnots::knot_spec>("knot_spec", kRequired),
};
constexpr Attribute kCartesianPoint[] = {
    row<&CartesianPoint::coordinates>("coordinates", kRequired, Unit::kLength),
};
constexpr Attribute kConic[] = {
    row<&Conic::position>("position", kRequired),
};
constexpr Attribute kCircle[] = {
    row<&Circle::radius>("radius", kRequired, Unit::kLength),
};
constexpr Attribute kDirection[] = {
    row<&Direction::direction_ratios>("direction_ratios", kRequired),
};
constexpr Attribute kElementarySurface[] = {
    row<&ElementarySurface::position>("position", kRequired),
};
constexpr Attribute kEllipse[] = {
    row<&Ellipse::semi_axis_1>("semi_axis_1", kRequired, Unit::kLength),
    row<&Ellipse::semi_axis_2>("semi_axis_2", kRequired, Unit::kLength),
};
constexpr Attribute kRepresentationContext[] = {
    row<&RepresentationContext::context_identifier>("context_identifier", kRequired),
    row<&RepresentationContext::context_type>("context_type", kRequired),
};
constexpr Attribute kGeometricRepresentationContext[] = {
    row<&GeometricRepresentationContext::coordinate_space_dimension>("coordinate_space_dimension", kRequired),
};
constexpr Attribute kHyperbola[] = {
    row<&Hyperbola::semi_axis>("semi_axis", kRequired, Unit::kLength),
    row<&Hyperbola::semi_imag_axis>("semi_imag_axis", kRequired, Unit::kLength),
};
constexpr Attribute kLine[] = {
    row<&Line::pnt>("pnt", kRequired),
    row<&Line::dir>("dir", kRequired),
};
constexpr Attribute kParabola[] = {
    row<&Parabola::focal_dist>("focal_dist", kRequired, Unit::kLength),
};
constexpr Attribute kPolyline[] = {
    row<&Polyline::points>("points", kRequired),
};
constexpr Attribute kRationalBSplineCurve[] = {
    row<&RationalBSplineCurve::weights_data>("weights_data", kRequired),
};
constexpr Attribute kRationalBSplineSurface[] = {
    row<&RationalBSplineSurface::weights_data>("weights_data", kRequired),
};
constexpr Attribute kSphericalSurface[] = {
    row<&SphericalSurface::radius>("radius", kRequired, Unit::kLength),
};
constexpr Attribute kSweptSurface[] = {
    row<&SweptSurface::swept_curve>("swept_curve", kRequired),
};
constexpr Attribute kSurfaceOfLinearExtrusion[] = {
    row<&SurfaceOfLinearExtrusion::extrusion_axis>("extrusion_axis", kRequired),
};
constexpr Attribute kSurfaceOfRevolution[] = {
    row<&SurfaceOfRevolution::axis_position>("axis_position", kRequired),
};
constexpr Attribute kVector[] = {
    row<&Vector::orientation>("orientation", kRequired),
    row<&Vector::magnitude>("magnitude", kRequired, Unit::kLength),
};
constexpr Attribute kConnectedFaceSet[] = {
    row<&ConnectedFaceSet::cfs_faces>("cfs_faces", kRequired),
};
constexpr Attribute kEdge[] = {
    row<&Edge::edge_start>("edge_start", kRequired),
    row<&Edge::edge_end>("edge_end", kRequired),
};
constexpr Attribute kEdgeCurve[] = {
    row<&EdgeCurve::edge_geometry>("edge_geometry", kRequired),
    row<&EdgeCurve::same_sense>("same_sense", kRequired),
};
constexpr Attribute kEdgeLoop[] = {
    row<&EdgeLoop::edge_list>("edge_list", kRequired),
};
constexpr Attribute kFace[] = {
    row<&Face::bounds>("bounds", kRequired),
};
constexpr Attribute kFaceBound[] = {
    row<&FaceBound::bound>("bound", kRequired),
    row<&FaceBound::orientation>("orientation", kRequired),
};
constexpr Attribute kFaceSurface[] = {
    row<&FaceSurface::face_geometry>("face_geometry", kRequired),
    row<&FaceSurface::same_sense>("same_sense", kRequired),
};
constexpr Attribute kOrientedEdge[] = {
    row<&OrientedEdge::edge_element>("edge_element", kRequired),
    row<&OrientedEdge::orientation>("orientation", kRequired),
};
constexpr Attribute kPath[] = {
    row<&Path::edge_list>("edge_list", kRequired),
};
constexpr Attribute kVertexLoop[] = {
    row<&VertexLoop::loop_vertex>("loop_vertex", kRequired),
};
constexpr Attribute kVertexPoint[] = {
    row<&VertexPoint::vertex_geometry>("vertex_geometry", kRequired),
};
constexpr Attribute kBlock[] = {
    row<&Block::position>("position", kRequired),
    row<&Block::x>("x", kRequired, Unit::kLength),
    row<&Block::y>("y", kRequired, Unit::kLength),
    row<&Block::z>("z", kRequired, Unit::kLength),
};
constexpr Attribute kManifoldSolidBrep[] = {
    row<&ManifoldSolidBrep::outer>("outer", kRequired),
};
constexpr Attribute kRightCircularCylinder[] = {
    row<&RightCircularCylinder::position>("position", kRequired),
    row<&RightCircularCylinder::height>("height", kRequired, Unit::kLength),
    row<&RightCircularCylinder::radius>("radius", kRequired, Unit::kLength),
};
constexpr Attribute kHelix[] = {
    row<&Helix::position>("position", kRequired),
    row<&Helix::radius>("radius", kRequired, Unit::kLength),
    row<&Helix::pitch>("pitch", kRequired, Unit::kLength),
};

constexpr NounRow kRows[] = {
    {TypeId::kRepresentation, "REPRESENTATION", TypeId::kNone, false, true, kRepresentation},
    {TypeId::kShapeRepresentation, "SHAPE_REPRESENTATION", TypeId::kRepresentation, false, true, {}},
    {TypeId::kRepresentationItem, "REPRESENTATION_ITEM", TypeId::kNone, true, true, kRepresentationItem},
    {TypeId::kGeometricRepresentationItem,
     "GEOMETRIC_REPRESENTATION_ITEM",
     TypeId::kRepresentationItem,
     true,
     true,
     {}},
    {TypeId::kCurve, "CURVE", TypeId::kGeometricRepresentationItem, true, true, {}},
    {TypeId::kBoundedCurve, "BOUNDED_CURVE", TypeId::kCurve, true, true, {}},
    {TypeId::kTrimmedCurve, "TRIMMED_CURVE", TypeId::kBoundedCurve, false, true, kTrimmedCurve},
    {TypeId::kCompositeCurve, "COMPOSITE_CURVE", TypeId::kBoundedCurve, false, true, kCompositeCurve},
    {TypeId::kCompositeCurveSegment, "COMPOSITE_CURVE_SEGMENT", TypeId::kNone, false, true,
     kCompositeCurveSegment},
    {TypeId::kPlacement, "PLACEMENT", TypeId::kGeometricRepresentationItem, true, true, kPlacement},
    {TypeId::kAxis1Placement, "AXIS1_PLACEMENT", TypeId::kPlacement, false, true, kAxis1Placement},
    {TypeId::kAxis2Placement3d, "AXIS2_PLACEMENT_3D", TypeId::kPlacement, false, true, kAxis2Placement3d},
    {TypeId::kBSplineCurve, "B_SPLINE_CURVE", TypeId::kBoundedCurve, true, true, kBSplineCurve},
    {TypeId::kBezierCurve, "BEZIER_CURVE", TypeId::kBSplineCurve, false, true, {}},
    {TypeId::kSurface, "SURFACE", TypeId::kGeometricRepresentationItem, true, true, {}},
    {TypeId::kBoundedSurface, "BOUNDED_SURFACE", TypeId::kSurface, true, true, {}},
    {TypeId::kBSplineSurface, "B_SPLINE_SURFACE", TypeId::kBoundedSurface, true, true, kBSplineSurface},
    {TypeId::kBezierSurface, "BEZIER_SURFACE", TypeId::kBSplineSurface, false, true, {}},
    {TypeId::kPcurve, "PCURVE", TypeId::kCurve, false, true, kPcurve},
    {TypeId::kBoundedPcurve, "BOUNDED_PCURVE", TypeId::kPcurve, false, true, {}},
    {TypeId::kBSplineCurveWithKnots, "B_SPLINE_CURVE_WITH_KNOTS", TypeId::kBSplineCurve, false, true,
     kBSplineCurveWithKnots},
    {TypeId::kBSplineSurfaceWithKnots, "B_SPLINE_SURFACE_WITH_KNOTS", TypeId::kBSplineSurface, false, true,
     kBSplineSurfaceWithKnots},
    {TypeId::kPoint, "POINT", TypeId::kGeometricRepresentationItem, true, true, {}},
    {TypeId::kCartesianPoint, "CARTESIAN_POINT", TypeId::kPoint, false, true, kCartesianPoint},
    {TypeId::kConic, "CONIC", TypeId::kCurve, true, true, kConic},
    {TypeId::kCircle, "CIRCLE", TypeId::kConic, false, true, kCircle},
    {TypeId::kDirection, "DIRECTION", TypeId::kGeometricRepresentationItem, false, true, kDirection},
    {TypeId::kElementarySurface, "ELEMENTARY_SURFACE", TypeId::kSurface, true, true, kElementarySurface},
    {TypeId::kEllipse, "ELLIPSE", TypeId::kConic, false, true, kEllipse},
    {TypeId::kRepresentationContext, "REPRESENTATION_CONTEXT", TypeId::kNone, false, true,
     kRepresentationContext},
    {TypeId::kGeometricRepresentationContext, "GEOMETRIC_REPRESENTATION_CONTEXT",
     TypeId::kRepresentationContext, true, true, kGeometricRepresentationContext},
    {TypeId::kHyperbola, "HYPERBOLA", TypeId::kConic, false, true, kHyperbola},
    {TypeId::kLine, "LINE", TypeId::kCurve, false, true, kLine},
    {TypeId::kParabola, "PARABOLA", TypeId::kConic, false, true, kParabola},
    {TypeId::kPlane, "PLANE", TypeId::kElementarySurface, false, true, {}},
    {TypeId::kPolyline, "POLYLINE", TypeId::kBoundedCurve, false, true, kPolyline},
    {TypeId::kQuasiUniformCurve, "QUASI_UNIFORM_CURVE", TypeId::kBSplineCurve, false, true, {}},
    {TypeId::kQuasiUniformSurface, "QUASI_UNIFORM_SURFACE", TypeId::kBSplineSurface, false, true, {}},
    {TypeId::kRationalBSplineCurve, "RATIONAL_B_SPLINE_CURVE", TypeId::kBSplineCurve, false, true,
     kRationalBSplineCurve},
    {TypeId::kRationalBSplineSurface, "RATIONAL_B_SPLINE_SURFACE", TypeId::kBSplineSurface, false, true,
     kRationalBSplineSurface},
    {TypeId::kSphericalSurface, "SPHERICAL_SURFACE", TypeId::kElementarySurface, false, true,
     kSphericalSurface},
    {TypeId::kSweptSurface, "SWEPT_SURFACE", TypeId::kSurface, true, true, kSweptSurface},
    {TypeId::kSurfaceOfLinearExtrusion, "SURFACE_OF_LINEAR_EXTRUSION", TypeId::kSweptSurface, false, true,
     kSurfaceOfLinearExtrusion},
    {TypeId::kSurfaceOfRevolution, "SURFACE_OF_REVOLUTION", TypeId::kSweptSurface, false, true,
     kSurfaceOfRevolution},
    {TypeId::kUniformCurve, "UNIFORM_CURVE", TypeId::kBSplineCurve, false, true, {}},
    {TypeId::kUniformSurface, "UNIFORM_SURFACE", TypeId::kBSplineSurface, false, true, {}},
    {TypeId::kVector, "VECTOR", TypeId::kGeometricRepresentationItem, false, true, kVector},
    {TypeId::kTopologicalRepresentationItem,
     "TOPOLOGICAL_REPRESENTATION_ITEM",
     TypeId::kRepresentationItem,
     true,
     true,
     {}},
    {TypeId::kConnectedFaceSet, "CONNECTED_FACE_SET", TypeId::kTopologicalRepresentationItem, true, true,
     kConnectedFaceSet},
    {TypeId::kClosedShell, "CLOSED_SHELL", TypeId::kConnectedFaceSet, false, true, {}},
    {TypeId::kEdge, "EDGE", TypeId::kTopologicalRepresentationItem, true, true, kEdge},
    {TypeId::kEdgeCurve, "EDGE_CURVE", TypeId::kEdge, false, true, kEdgeCurve},
    {TypeId::kLoop, "LOOP", TypeId::kTopologicalRepresentationItem, true, true, {}},
    {TypeId::kEdgeLoop, "EDGE_LOOP", TypeId::kLoop, false, true, kEdgeLoop},
    {TypeId::kFace, "FACE", TypeId::kTopologicalRepresentationItem, true, true, kFace},
    {TypeId::kFaceBound, "FACE_BOUND", TypeId::kTopologicalRepresentationItem, false, true, kFaceBound},
    {TypeId::kFaceOuterBound, "FACE_OUTER_BOUND", TypeId::kFaceBound, false, true, {}},
    {TypeId::kFaceSurface, "FACE_SURFACE", TypeId::kFace, true, true, kFaceSurface},
    {TypeId::kOpenShell, "OPEN_SHELL", TypeId::kConnectedFaceSet, false, true, {}},
    {TypeId::kOrientedEdge, "ORIENTED_EDGE", TypeId::kEdge, false, true, kOrientedEdge},
    {TypeId::kPath, "PATH", TypeId::kTopologicalRepresentationItem, true, true, kPath},
    {TypeId::kVertex, "VERTEX", TypeId::kTopologicalRepresentationItem, true, true, {}},
    {TypeId::kVertexLoop, "VERTEX_LOOP", TypeId::kLoop, false, true, kVertexLoop},
    {TypeId::kVertexPoint, "VERTEX_POINT", TypeId::kVertex, false, true, kVertexPoint},
    {TypeId::kBlock, "BLOCK", TypeId::kGeometricRepresentationItem, false, true, kBlock},
    {TypeId::kSolidModel, "SOLID_MODEL", TypeId::kGeometricRepresentationItem, true, true, {}},
    {TypeId::kManifoldSolidBrep, "MANIFOLD_SOLID_BREP", TypeId::kSolidModel, false, true, kManifoldSolidBrep},
    {TypeId::kRightCircularCylinder, "RIGHT_CIRCULAR_CYLINDER", TypeId::kGeometricRepresentationItem, false,
     true, kRightCircularCylinder},
    {TypeId::kDefinitionalRepresentation,
     "DEFINITIONAL_REPRESENTATION",
     TypeId::kRepresentation,
     false,
     true,
     {}},
    {TypeId::kAdvancedFace, "ADVANCED_FACE", TypeId::kFaceSurface, false, true, {}},
    {TypeId::kAdvancedBrepShapeRepresentation,
     "ADVANCED_BREP_SHAPE_REPRESENTATION",
     TypeId::kShapeRepresentation,
     false,
     true,
     {}},
    {TypeId::kHelix, "HELIX", TypeId::kCurve, false, true, kHelix},
    {TypeId::kViaArcPoint, "VIA_ARC_POINT", TypeId::kCartesianPoint, false, false, {}},
    {TypeId::kViaHelixPoint, "VIA_HELIX_POINT", TypeId::kCartesianPoint, false, false, {}},
};

}  // namespace

std::span<const NounRow> geometric_item_rows() { return kRows; }

}  // namespace capstan::model
