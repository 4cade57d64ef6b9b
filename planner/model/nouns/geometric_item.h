#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Points, directions, curves, surfaces and topology (ISO 10303-42).
/// Lengths in mm, angles in rad, feeds in mm/min, spindle speeds in 1/min (negative is clockwise seen from
/// the spindle, as ISO 14649 signs it), times in s, ratios as fractions of one.

namespace capstan::model {

struct Representation : Noun {
  static constexpr TypeId kType = TypeId::kRepresentation;
  Text name;
  RefList<RepresentationItem> items;
  Ref<RepresentationContext> context_of_items;
};

struct ShapeRepresentation : Representation {
  static constexpr TypeId kType = TypeId::kShapeRepresentation;
};

struct RepresentationItem : Noun {
  static constexpr TypeId kType = TypeId::kRepresentationItem;
  Text name;
};

struct GeometricRepresentationItem : RepresentationItem {
  static constexpr TypeId kType = TypeId::kGeometricRepresentationItem;
};

struct Curve : GeometricRepresentationItem {
  static constexpr TypeId kType = TypeId::kCurve;
};

struct BoundedCurve : Curve {
  static constexpr TypeId kType = TypeId::kBoundedCurve;
};

struct TrimmedCurve : BoundedCurve {
  static constexpr TypeId kType = TypeId::kTrimmedCurve;
  Ref<Curve> basis_curve;
  SelectList trim_1;
  SelectList trim_2;
  Boolean sense_agreement;
  Enumerated<TrimmingPreference> master_representation;
};

struct CompositeCurve : BoundedCurve {
  static constexpr TypeId kType = TypeId::kCompositeCurve;
  RefList<CompositeCurveSegment> segments;
  Logical self_intersect;
};

struct CompositeCurveSegment : Noun {
  static constexpr TypeId kType = TypeId::kCompositeCurveSegment;
  Enumerated<TransitionCode> transition;
  Boolean same_sense;
  Ref<Curve> parent_curve;
};

struct Placement : GeometricRepresentationItem {
  static constexpr TypeId kType = TypeId::kPlacement;
  Ref<CartesianPoint> location;
};

struct Axis1Placement : Placement {
  static constexpr TypeId kType = TypeId::kAxis1Placement;
  Ref<Direction> axis;  ///< optional
};

struct Axis2Placement3d : Placement {
  static constexpr TypeId kType = TypeId::kAxis2Placement3d;
  Ref<Direction> axis;           ///< optional
  Ref<Direction> ref_direction;  ///< optional
};

struct BSplineCurve : BoundedCurve {
  static constexpr TypeId kType = TypeId::kBSplineCurve;
  Integer degree;
  RefList<CartesianPoint> control_points_list;
  Enumerated<BSplineCurveForm> curve_form;
  Logical closed_curve;
  Logical self_intersect;
};

struct BezierCurve : BSplineCurve {
  static constexpr TypeId kType = TypeId::kBezierCurve;
};

struct Surface : GeometricRepresentationItem {
  static constexpr TypeId kType = TypeId::kSurface;
};

struct BoundedSurface : Surface {
  static constexpr TypeId kType = TypeId::kBoundedSurface;
};

struct BSplineSurface : BoundedSurface {
  static constexpr TypeId kType = TypeId::kBSplineSurface;
  Integer u_degree;
  Integer v_degree;
  RefTable control_points_list;
  Enumerated<BSplineSurfaceForm> surface_form;
  Logical u_closed;
  Logical v_closed;
  Logical self_intersect;
};

struct BezierSurface : BSplineSurface {
  static constexpr TypeId kType = TypeId::kBezierSurface;
};

struct Pcurve : Curve {
  static constexpr TypeId kType = TypeId::kPcurve;
  Ref<Surface> basis_surface;
  Ref<DefinitionalRepresentation> reference_to_curve;
};

struct BoundedPcurve : Pcurve {
  static constexpr TypeId kType = TypeId::kBoundedPcurve;
};

struct BSplineCurveWithKnots : BSplineCurve {
  static constexpr TypeId kType = TypeId::kBSplineCurveWithKnots;
  IntegerList knot_multiplicities;
  RealList knots;
  Enumerated<KnotType> knot_spec;
};

struct BSplineSurfaceWithKnots : BSplineSurface {
  static constexpr TypeId kType = TypeId::kBSplineSurfaceWithKnots;
  IntegerList u_multiplicities;
  IntegerList v_multiplicities;
  RealList u_knots;
  RealList v_knots;
  Enumerated<KnotType> knot_spec;
};

struct Point : GeometricRepresentationItem {
  static constexpr TypeId kType = TypeId::kPoint;
};

struct CartesianPoint : Point {
  static constexpr TypeId kType = TypeId::kCartesianPoint;
  RealList coordinates;  ///< mm
};

struct Conic : Curve {
  static constexpr TypeId kType = TypeId::kConic;
  Ref<Axis2Placement3d> position;
};

struct Circle : Conic {
  static constexpr TypeId kType = TypeId::kCircle;
  Real radius;  ///< mm
};

struct Direction : GeometricRepresentationItem {
  static constexpr TypeId kType = TypeId::kDirection;
  RealList direction_ratios;
};

struct ElementarySurface : Surface {
  static constexpr TypeId kType = TypeId::kElementarySurface;
  Ref<Axis2Placement3d> position;
};

struct Ellipse : Conic {
  static constexpr TypeId kType = TypeId::kEllipse;
  Real semi_axis_1;  ///< mm
  Real semi_axis_2;  ///< mm
};

struct RepresentationContext : Noun {
  static constexpr TypeId kType = TypeId::kRepresentationContext;
  Text context_identifier;
  Text context_type;
};

struct GeometricRepresentationContext : RepresentationContext {
  static constexpr TypeId kType = TypeId::kGeometricRepresentationContext;
  Integer coordinate_space_dimension;
};

struct Hyperbola : Conic {
  static constexpr TypeId kType = TypeId::kHyperbola;
  Real semi_axis;       ///< mm
  Real semi_imag_axis;  ///< mm
};

struct Line : Curve {
  static constexpr TypeId kType = TypeId::kLine;
  Ref<CartesianPoint> pnt;
  Ref<Vector> dir;
};

struct Parabola : Conic {
  static constexpr TypeId kType = TypeId::kParabola;
  Real focal_dist;  ///< mm
};

struct Plane : ElementarySurface {
  static constexpr TypeId kType = TypeId::kPlane;
};

struct Polyline : BoundedCurve {
  static constexpr TypeId kType = TypeId::kPolyline;
  RefList<CartesianPoint> points;
};

struct QuasiUniformCurve : BSplineCurve {
  static constexpr TypeId kType = TypeId::kQuasiUniformCurve;
};

struct QuasiUniformSurface : BSplineSurface {
  static constexpr TypeId kType = TypeId::kQuasiUniformSurface;
};

struct RationalBSplineCurve : BSplineCurve {
  static constexpr TypeId kType = TypeId::kRationalBSplineCurve;
  RealList weights_data;
};

struct RationalBSplineSurface : BSplineSurface {
  static constexpr TypeId kType = TypeId::kRationalBSplineSurface;
  RealTable weights_data;
};

struct SphericalSurface : ElementarySurface {
  static constexpr TypeId kType = TypeId::kSphericalSurface;
  Real radius;  ///< mm
};

struct SweptSurface : Surface {
  static constexpr TypeId kType = TypeId::kSweptSurface;
  Ref<Curve> swept_curve;
};

struct SurfaceOfLinearExtrusion : SweptSurface {
  static constexpr TypeId kType = TypeId::kSurfaceOfLinearExtrusion;
  Ref<Vector> extrusion_axis;
};

struct SurfaceOfRevolution : SweptSurface {
  static constexpr TypeId kType = TypeId::kSurfaceOfRevolution;
  Ref<Axis1Placement> axis_position;
};

struct UniformCurve : BSplineCurve {
  static constexpr TypeId kType = TypeId::kUniformCurve;
};

struct UniformSurface : BSplineSurface {
  static constexpr TypeId kType = TypeId::kUniformSurface;
};

struct Vector : GeometricRepresentationItem {
  static constexpr TypeId kType = TypeId::kVector;
  Ref<Direction> orientation;
  Real magnitude;  ///< mm
};

struct TopologicalRepresentationItem : RepresentationItem {
  static constexpr TypeId kType = TypeId::kTopologicalRepresentationItem;
};

struct ConnectedFaceSet : TopologicalRepresentationItem {
  static constexpr TypeId kType = TypeId::kConnectedFaceSet;
  RefList<Face> cfs_faces;
};

struct ClosedShell : ConnectedFaceSet {
  static constexpr TypeId kType = TypeId::kClosedShell;
};

struct Edge : TopologicalRepresentationItem {
  static constexpr TypeId kType = TypeId::kEdge;
  Ref<Vertex> edge_start;
  Ref<Vertex> edge_end;
};

struct EdgeCurve : Edge {
  static constexpr TypeId kType = TypeId::kEdgeCurve;
  Ref<Curve> edge_geometry;
  Boolean same_sense;
};

struct Loop : TopologicalRepresentationItem {
  static constexpr TypeId kType = TypeId::kLoop;
};

struct EdgeLoop : Loop {
  static constexpr TypeId kType = TypeId::kEdgeLoop;
  RefList<OrientedEdge> edge_list;
};

struct Face : TopologicalRepresentationItem {
  static constexpr TypeId kType = TypeId::kFace;
  RefList<FaceBound> bounds;
};

struct FaceBound : TopologicalRepresentationItem {
  static constexpr TypeId kType = TypeId::kFaceBound;
  Ref<Loop> bound;
  Boolean orientation;
};

struct FaceOuterBound : FaceBound {
  static constexpr TypeId kType = TypeId::kFaceOuterBound;
};

struct FaceSurface : Face {
  static constexpr TypeId kType = TypeId::kFaceSurface;
  Ref<Surface> face_geometry;
  Boolean same_sense;
};

struct OpenShell : ConnectedFaceSet {
  static constexpr TypeId kType = TypeId::kOpenShell;
};

struct OrientedEdge : Edge {
  static constexpr TypeId kType = TypeId::kOrientedEdge;
  Ref<Edge> edge_element;
  Boolean orientation;
};

struct Path : TopologicalRepresentationItem {
  static constexpr TypeId kType = TypeId::kPath;
  RefList<OrientedEdge> edge_list;
};

struct Vertex : TopologicalRepresentationItem {
  static constexpr TypeId kType = TypeId::kVertex;
};

struct VertexLoop : Loop {
  static constexpr TypeId kType = TypeId::kVertexLoop;
  Ref<Vertex> loop_vertex;
};

struct VertexPoint : Vertex {
  static constexpr TypeId kType = TypeId::kVertexPoint;
  Ref<Point> vertex_geometry;
};

struct Block : GeometricRepresentationItem {
  static constexpr TypeId kType = TypeId::kBlock;
  Ref<Axis2Placement3d> position;
  Real x;  ///< mm
  Real y;  ///< mm
  Real z;  ///< mm
};

struct SolidModel : GeometricRepresentationItem {
  static constexpr TypeId kType = TypeId::kSolidModel;
};

struct ManifoldSolidBrep : SolidModel {
  static constexpr TypeId kType = TypeId::kManifoldSolidBrep;
  Ref<ClosedShell> outer;
};

struct RightCircularCylinder : GeometricRepresentationItem {
  static constexpr TypeId kType = TypeId::kRightCircularCylinder;
  Ref<Axis1Placement> position;
  Real height;  ///< mm
  Real radius;  ///< mm
};

struct DefinitionalRepresentation : Representation {
  static constexpr TypeId kType = TypeId::kDefinitionalRepresentation;
};

struct AdvancedFace : FaceSurface {
  static constexpr TypeId kType = TypeId::kAdvancedFace;
};

struct AdvancedBrepShapeRepresentation : ShapeRepresentation {
  static constexpr TypeId kType = TypeId::kAdvancedBrepShapeRepresentation;
};

struct Helix : Curve {
  static constexpr TypeId kType = TypeId::kHelix;
  Ref<Axis2Placement3d> position;
  Real radius;  ///< mm
  Real pitch;   ///< mm
};

/// A point of a polyline, never its first or last: an arc runs from the point before, through this one,
/// to the point after (less than a full turn; two of them make a full circle).
struct ViaArcPoint : CartesianPoint {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kViaArcPoint;
};

/// As `ViaArcPoint`, for a helix.
struct ViaHelixPoint : CartesianPoint {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kViaHelixPoint;
};

}  // namespace capstan::model
