#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Shape elements, dimensions, geometric tolerances, datums (ISO 10303-47; ISO 10303-238).
/// None of this is in ISO 14649. Lengths in mm, angles in rad, times in s.

namespace capstan::model {

/// A piece of the shape of a part that something is stated of.
struct ShapeElement : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kShapeElement;
  Text its_id;       ///< optional
  Text description;  ///< optional
  Ref<Workpiece> its_workpiece;
  RefList<RepresentationItem> explicit_representation;  ///< optional; its faces, edges or curves in the part
  OneOfList<ManufacturingFeature, ShapeElement>
      its_elements;  ///< optional; of a composite one, such as a pattern toleranced as a whole
};

struct DatumFeature : ShapeElement {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kDatumFeature;
};

struct Datum : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kDatum;
  Text identification;  ///< the letter
  Ref<Workpiece> its_workpiece;
  OneOfList<DatumFeature, DatumTarget, ManufacturingFeature, ShapeElement> established_by;
};

/// A target; by itself an area given by its geometry.
struct DatumTarget : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kDatumTarget;
  Text target_id;  ///< the number beside the letter
  Ref<Workpiece> its_workpiece;
  Text description;                                     ///< optional
  RefList<RepresentationItem> explicit_representation;  ///< optional; of a target that is drawn, not placed
};

struct PlacedDatumTarget : DatumTarget {  // abstract, ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kPlacedDatumTarget;
  Ref<Axis2Placement3d> placement;
};

struct PointDatumTarget : PlacedDatumTarget {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kPointDatumTarget;
};

struct LineDatumTarget : PlacedDatumTarget {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kLineDatumTarget;
  Real length;  ///< mm; along the placement's x
};

struct RectangleDatumTarget : PlacedDatumTarget {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kRectangleDatumTarget;
  Real length;  ///< mm; along the placement's x
  Real width;   ///< mm; along its y
};

struct CircleDatumTarget : PlacedDatumTarget {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kCircleDatumTarget;
  Real diameter;  ///< mm
};

struct CircularCurveDatumTarget : PlacedDatumTarget {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kCircularCurveDatumTarget;
  Real diameter;  ///< mm
};

/// One compartment of a datum system; the order in the system is the precedence.
struct DatumReference : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kDatumReference;
  Ref<Datum> referenced_datum;           ///< optional; unset for a common datum
  RefList<DatumReference> its_elements;  ///< optional; the datums of a common one (A-B)
  TextList modifiers;    ///< optional; EXPRESS words, lower case: "maximum_material_requirement"
  Text valued_modifier;  ///< optional; "projected", "distance", "spherical", "circular_or_cylindrical"
  Real modifier_value;   ///< mm, optional
};

struct DatumSystem : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kDatumSystem;
  Text its_id;                           ///< optional
  Ref<Workpiece> its_workpiece;          ///< optional
  RefList<DatumReference> constituents;  ///< primary, secondary, tertiary
};

struct GeometricTolerance : Noun {  // abstract, ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kGeometricTolerance;
  Text its_id;           ///< optional
  Text description;      ///< optional
  Real tolerance_value;  ///< mm
  Ref<Workpiece> its_workpiece;
  OneOfList<ManufacturingFeature, MachinedSurface, ShapeElement, ShapeDimension, Datum> applied_to;
  Ref<DatumSystem> its_datum_system;  ///< optional
  TextList modifiers;  ///< optional; EXPRESS words, lower case: "maximum_material_requirement", "free_state"
  Real maximum_tolerance;      ///< mm, optional
  Text zone_form;              ///< optional; "cylindrical or circular", "spherical", "within a cylinder", ...
  Real projected_zone_length;  ///< mm, optional
  OneOf<ManufacturingFeature, MachinedSurface, ShapeElement> projection_end;  ///< optional
  Ref<Axis2Placement3d> affected_plane;                                       ///< optional
  Real unit_size;                      ///< mm, optional; per unit basis
  Real unit_angle;                     ///< rad, optional
  Enumerated<AreaUnitType> area_type;  ///< optional
  Real second_unit_size;               ///< mm, optional
  Real second_unit_angle;              ///< rad, optional
  Real displacement;                   ///< mm, optional; of an unequally disposed zone
};

struct AngularityTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kAngularityTolerance;
};

struct CircularRunoutTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kCircularRunoutTolerance;
};

struct RoundnessTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kRoundnessTolerance;
};

struct CoaxialityTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kCoaxialityTolerance;
};

struct ConcentricityTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kConcentricityTolerance;
};

struct CylindricityTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kCylindricityTolerance;
};

struct FlatnessTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kFlatnessTolerance;
};

struct LineProfileTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kLineProfileTolerance;
};

struct ParallelismTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kParallelismTolerance;
};

struct PerpendicularityTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kPerpendicularityTolerance;
};

struct PositionTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kPositionTolerance;
};

struct StraightnessTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kStraightnessTolerance;
};

struct SurfaceProfileTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kSurfaceProfileTolerance;
};

struct SymmetryTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kSymmetryTolerance;
};

struct TotalRunoutTolerance : GeometricTolerance {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kTotalRunoutTolerance;
};

struct ShapeDimension : Noun {  // abstract, ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kShapeDimension;
  Text its_id;  ///< optional
  Text kind;    ///< "diameter", "linear distance", "curved distance", ...
  Ref<Workpiece> its_workpiece;
  Real nominal_value;                                       ///< mm, optional
  Real nominal_angle;                                       ///< rad, optional; in place of nominal_value
  OneOf<PlusMinusValue, LimitsAndFits> implicit_tolerance;  ///< optional
  Real upper_angle_limit;                                   ///< rad, optional; plus, of an angle
  Real lower_angle_limit;                                   ///< rad, optional; minus, signed
  Real upper_range;     ///< mm, optional; limits given instead of a nominal
  Real lower_range;     ///< mm, optional
  TextList qualifiers;  ///< optional; "maximum", "minimum", "average", "reference", "theoretical", ...
  Ref<BoundedCurve> measurement_path;  ///< optional; along which it is measured
};

struct SizeDimension : ShapeDimension {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kSizeDimension;
  OneOf<ManufacturingFeature, MachinedSurface, ShapeElement> applied_to;
  Enumerated<AngleRelator> angle_selection;  ///< optional
};

struct LocationDimension : ShapeDimension {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kLocationDimension;
  OneOf<ManufacturingFeature, MachinedSurface, ShapeElement, Datum> origin;
  OneOf<ManufacturingFeature, MachinedSurface, ShapeElement, Datum> target;
  Boolean directed;                          ///< optional; measured from origin to target
  Enumerated<AngleRelator> angle_selection;  ///< optional
};

}  // namespace capstan::model
