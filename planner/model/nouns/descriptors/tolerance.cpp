#include "planner/model/nouns/tolerance.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kShapeElement[] = {
    plan_row<&ShapeElement::its_id>("its_id", kOptional),
    plan_row<&ShapeElement::description>("description", kOptional),
    plan_row<&ShapeElement::its_workpiece>("its_workpiece", kRequired),
    plan_row<&ShapeElement::explicit_representation>("explicit_representation", kOptional),
    plan_row<&ShapeElement::its_elements>("its_elements", kOptional),
};
constexpr Attribute kDatum[] = {
    plan_row<&Datum::identification>("identification", kRequired),
    plan_row<&Datum::its_workpiece>("its_workpiece", kRequired),
    plan_row<&Datum::established_by>("established_by", kRequired),
};
constexpr Attribute kDatumTarget[] = {
    plan_row<&DatumTarget::target_id>("target_id", kRequired),
    plan_row<&DatumTarget::its_workpiece>("its_workpiece", kRequired),
    plan_row<&DatumTarget::description>("description", kOptional),
    plan_row<&DatumTarget::explicit_representation>("explicit_representation", kOptional),
};
constexpr Attribute kPlacedDatumTarget[] = {
    plan_row<&PlacedDatumTarget::placement>("placement", kRequired),
};
constexpr Attribute kLineDatumTarget[] = {
    plan_row<&LineDatumTarget::length>("length", kRequired, Unit::kLength),
};
constexpr Attribute kRectangleDatumTarget[] = {
    plan_row<&RectangleDatumTarget::length>("length", kRequired, Unit::kLength),
    plan_row<&RectangleDatumTarget::width>("width", kRequired, Unit::kLength),
};
constexpr Attribute kCircleDatumTarget[] = {
    plan_row<&CircleDatumTarget::diameter>("diameter", kRequired, Unit::kLength),
};
constexpr Attribute kCircularCurveDatumTarget[] = {
    plan_row<&CircularCurveDatumTarget::diameter>("diameter", kRequired, Unit::kLength),
};
constexpr Attribute kDatumReference[] = {
    plan_row<&DatumReference::referenced_datum>("referenced_datum", kOptional),
    plan_row<&DatumReference::its_elements>("its_elements", kOptional),
    plan_row<&DatumReference::modifiers>("modifiers", kOptional),
    plan_row<&DatumReference::valued_modifier>("valued_modifier", kOptional),
    plan_row<&DatumReference::modifier_value>("modifier_value", kOptional, Unit::kLength),
};
constexpr Attribute kDatumSystem[] = {
    plan_row<&DatumSystem::its_id>("its_id", kOptional),
    plan_row<&DatumSystem::its_workpiece>("its_workpiece", kOptional),
    plan_row<&DatumSystem::constituents>("constituents", kRequired),
};
constexpr Attribute kGeometricTolerance[] = {
    plan_row<&GeometricTolerance::its_id>("its_id", kOptional),
    plan_row<&GeometricTolerance::description>("description", kOptional),
    plan_row<&GeometricTolerance::tolerance_value>("tolerance_value", kRequired, Unit::kLength),
    plan_row<&GeometricTolerance::its_workpiece>("its_workpiece", kRequired),
    plan_row<&GeometricTolerance::applied_to>("applied_to", kRequired),
    plan_row<&GeometricTolerance::its_datum_system>("its_datum_system", kOptional),
    plan_row<&GeometricTolerance::modifiers>("modifiers", kOptional),
    plan_row<&GeometricTolerance::maximum_tolerance>("maximum_tolerance", kOptional, Unit::kLength),
    plan_row<&GeometricTolerance::zone_form>("zone_form", kOptional),
    plan_row<&GeometricTolerance::projected_zone_length>("projected_zone_length", kOptional, Unit::kLength),
    plan_row<&GeometricTolerance::projection_end>("projection_end", kOptional),
    plan_row<&GeometricTolerance::affected_plane>("affected_plane", kOptional),
    plan_row<&GeometricTolerance::unit_size>("unit_size", kOptional, Unit::kLength),
    plan_row<&GeometricTolerance::unit_angle>("unit_angle", kOptional, Unit::kAngle),
    plan_row<&GeometricTolerance::area_type>("area_type", kOptional),
    plan_row<&GeometricTolerance::second_unit_size>("second_unit_size", kOptional, Unit::kLength),
    plan_row<&GeometricTolerance::second_unit_angle>("second_unit_angle", kOptional, Unit::kAngle),
    plan_row<&GeometricTolerance::displacement>("displacement", kOptional, Unit::kLength),
};
constexpr Attribute kShapeDimension[] = {
    plan_row<&ShapeDimension::its_id>("its_id", kOptional),
    plan_row<&ShapeDimension::kind>("kind", kRequired),
    plan_row<&ShapeDimension::its_workpiece>("its_workpiece", kRequired),
    plan_row<&ShapeDimension::nominal_value>("nominal_value", kOptional, Unit::kLength),
    plan_row<&ShapeDimension::nominal_angle>("nominal_angle", kOptional, Unit::kAngle),
    plan_row<&ShapeDimension::implicit_tolerance>("implicit_tolerance", kOptional),
    plan_row<&ShapeDimension::upper_angle_limit>("upper_angle_limit", kOptional, Unit::kAngle),
    plan_row<&ShapeDimension::lower_angle_limit>("lower_angle_limit", kOptional, Unit::kAngle),
    plan_row<&ShapeDimension::upper_range>("upper_range", kOptional, Unit::kLength),
    plan_row<&ShapeDimension::lower_range>("lower_range", kOptional, Unit::kLength),
    plan_row<&ShapeDimension::qualifiers>("qualifiers", kOptional),
    plan_row<&ShapeDimension::measurement_path>("measurement_path", kOptional),
};
constexpr Attribute kSizeDimension[] = {
    plan_row<&SizeDimension::applied_to>("applied_to", kRequired),
    plan_row<&SizeDimension::angle_selection>("angle_selection", kOptional),
};
constexpr Attribute kLocationDimension[] = {
    plan_row<&LocationDimension::origin>("origin", kRequired),
    plan_row<&LocationDimension::target>("target", kRequired),
    plan_row<&LocationDimension::directed>("directed", kOptional),
    plan_row<&LocationDimension::angle_selection>("angle_selection", kOptional),
};

constexpr NounRow kRows[] = {
    {TypeId::kShapeElement, "SHAPE_ELEMENT", TypeId::kNone, false, false, kShapeElement},
    {TypeId::kDatumFeature, "DATUM_FEATURE", TypeId::kShapeElement, false, false, {}},
    {TypeId::kDatum, "DATUM", TypeId::kNone, false, false, kDatum},
    {TypeId::kDatumTarget, "DATUM_TARGET", TypeId::kNone, false, false, kDatumTarget},
    {TypeId::kPlacedDatumTarget, "PLACED_DATUM_TARGET", TypeId::kDatumTarget, true, false,
     kPlacedDatumTarget},
    {TypeId::kPointDatumTarget, "POINT_DATUM_TARGET", TypeId::kPlacedDatumTarget, false, false, {}},
    {TypeId::kLineDatumTarget, "LINE_DATUM_TARGET", TypeId::kPlacedDatumTarget, false, false,
     kLineDatumTarget},
    {TypeId::kRectangleDatumTarget, "RECTANGLE_DATUM_TARGET", TypeId::kPlacedDatumTarget, false, false,
     kRectangleDatumTarget},
    {TypeId::kCircleDatumTarget, "CIRCLE_DATUM_TARGET", TypeId::kPlacedDatumTarget, false, false,
     kCircleDatumTarget},
    {TypeId::kCircularCurveDatumTarget, "CIRCULAR_CURVE_DATUM_TARGET", TypeId::kPlacedDatumTarget, false,
     false, kCircularCurveDatumTarget},
    {TypeId::kDatumReference, "DATUM_REFERENCE", TypeId::kNone, false, false, kDatumReference},
    {TypeId::kDatumSystem, "DATUM_SYSTEM", TypeId::kNone, false, false, kDatumSystem},
    {TypeId::kGeometricTolerance, "GEOMETRIC_TOLERANCE", TypeId::kNone, true, false, kGeometricTolerance},
    {TypeId::kAngularityTolerance, "ANGULARITY_TOLERANCE", TypeId::kGeometricTolerance, false, false, {}},
    {TypeId::kCircularRunoutTolerance,
     "CIRCULAR_RUNOUT_TOLERANCE",
     TypeId::kGeometricTolerance,
     false,
     false,
     {}},
    {TypeId::kRoundnessTolerance, "ROUNDNESS_TOLERANCE", TypeId::kGeometricTolerance, false, false, {}},
    {TypeId::kCoaxialityTolerance, "COAXIALITY_TOLERANCE", TypeId::kGeometricTolerance, false, false, {}},
    {TypeId::kConcentricityTolerance,
     "CONCENTRICITY_TOLERANCE",
     TypeId::kGeometricTolerance,
     false,
     false,
     {}},
    {TypeId::kCylindricityTolerance, "CYLINDRICITY_TOLERANCE", TypeId::kGeometricTolerance, false, false, {}},
    {TypeId::kFlatnessTolerance, "FLATNESS_TOLERANCE", TypeId::kGeometricTolerance, false, false, {}},
    {TypeId::kLineProfileTolerance, "LINE_PROFILE_TOLERANCE", TypeId::kGeometricTolerance, false, false, {}},
    {TypeId::kParallelismTolerance, "PARALLELISM_TOLERANCE", TypeId::kGeometricTolerance, false, false, {}},
    {TypeId::kPerpendicularityTolerance,
     "PERPENDICULARITY_TOLERANCE",
     TypeId::kGeometricTolerance,
     false,
     false,
     {}},
    {TypeId::kPositionTolerance, "POSITION_TOLERANCE", TypeId::kGeometricTolerance, false, false, {}},
    {TypeId::kStraightnessTolerance, "STRAIGHTNESS_TOLERANCE", TypeId::kGeometricTolerance, false, false, {}},
    {TypeId::kSurfaceProfileTolerance,
     "SURFACE_PROFILE_TOLERANCE",
     TypeId::kGeometricTolerance,
     false,
     false,
     {}},
    {TypeId::kSymmetryTolerance, "SYMMETRY_TOLERANCE", TypeId::kGeometricTolerance, false, false, {}},
    {TypeId::kTotalRunoutTolerance, "TOTAL_RUNOUT_TOLERANCE", TypeId::kGeometricTolerance, false, false, {}},
    {TypeId::kShapeDimension, "SHAPE_DIMENSION", TypeId::kNone, true, false, kShapeDimension},
    {TypeId::kSizeDimension, "SIZE_DIMENSION", TypeId::kShapeDimension, false, false, kSizeDimension},
    {TypeId::kLocationDimension, "LOCATION_DIMENSION", TypeId::kShapeDimension, false, false,
     kLocationDimension},
};

}  // namespace

std::span<const NounRow> tolerance_rows() { return kRows; }

}  // namespace capstan::model
