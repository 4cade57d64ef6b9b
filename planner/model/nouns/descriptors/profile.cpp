#include "planner/model/nouns/profile.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kRadiusedPocketBottomCondition[] = {
    row<&RadiusedPocketBottomCondition::floor_radius_center>("floor_radius_center", kRequired),
    row<&RadiusedPocketBottomCondition::floor_radius>("floor_radius", kRequired),
};
constexpr Attribute kGeneralPocketBottomCondition[] = {
    row<&GeneralPocketBottomCondition::shape>("shape", kRequired),
};
constexpr Attribute kWoodruffSlotEndType[] = {
    row<&WoodruffSlotEndType::radius>("radius", kRequired),
};
constexpr Attribute kFlatSlotEndType[] = {
    row<&FlatSlotEndType::corner_radius1>("corner_radius1", kRequired),
    row<&FlatSlotEndType::corner_radius2>("corner_radius2", kRequired),
};
constexpr Attribute kProfileFloor[] = {
    row<&ProfileFloor::floor_radius>("floor_radius", kOptional),
    row<&ProfileFloor::start_or_end>("start_or_end", kRequired),
};
constexpr Attribute kGeneralProfileFloor[] = {
    row<&GeneralProfileFloor::floor>("floor", kRequired),
};
constexpr Attribute kPlanarProfileFloor[] = {
    row<&PlanarProfileFloor::floor>("floor", kRequired),
};
constexpr Attribute kDiameterTaper[] = {
    row<&DiameterTaper::final_diameter>("final_diameter", kRequired),
};
constexpr Attribute kAngleTaper[] = {
    row<&AngleTaper::angle>("angle", kRequired, Unit::kAngle),
};
constexpr Attribute kFlatWithRadiusHoleBottom[] = {
    row<&FlatWithRadiusHoleBottom::corner_radius>("corner_radius", kRequired),
};
constexpr Attribute kSphericalHoleBottom[] = {
    row<&SphericalHoleBottom::radius>("radius", kRequired),
};
constexpr Attribute kConicalHoleBottom[] = {
    row<&ConicalHoleBottom::tip_angle>("tip_angle", kRequired, Unit::kAngle),
    row<&ConicalHoleBottom::tip_radius>("tip_radius", kOptional),
};
constexpr Attribute kCircularOffset[] = {
    row<&CircularOffset::angular_offset>("angular_offset", kRequired, Unit::kAngle),
    row<&CircularOffset::index>("index", kRequired),
};
constexpr Attribute kCircularOmit[] = {
    row<&CircularOmit::index>("index", kRequired),
};
constexpr Attribute kRectangularOffset[] = {
    row<&RectangularOffset::offset_direction>("offset_direction", kRequired),
    row<&RectangularOffset::offset_distance>("offset_distance", kRequired, Unit::kLength),
    row<&RectangularOffset::row_index>("row_index", kRequired),
    row<&RectangularOffset::column_index>("column_index", kRequired),
};
constexpr Attribute kRectangularOmit[] = {
    row<&RectangularOmit::row_index>("row_index", kRequired),
    row<&RectangularOmit::column_index>("column_index", kRequired),
};
constexpr Attribute kPartialAreaDefinition[] = {
    row<&PartialAreaDefinition::effective_length>("effective_length", kRequired, Unit::kLength),
    row<&PartialAreaDefinition::placement>("placement", kRequired),
    row<&PartialAreaDefinition::maximum_length>("maximum_length", kOptional, Unit::kLength),
};
constexpr Attribute kProfile[] = {
    row<&Profile::placement>("placement", kOptional),
};
constexpr Attribute kLinearProfile[] = {
    row<&LinearProfile::profile_length>("profile_length", kRequired),
};
constexpr Attribute kSquareUProfile[] = {
    row<&SquareUProfile::width>("width", kRequired),
    row<&SquareUProfile::first_radius>("first_radius", kRequired),
    row<&SquareUProfile::first_angle>("first_angle", kRequired, Unit::kAngle),
    row<&SquareUProfile::second_radius>("second_radius", kRequired),
    row<&SquareUProfile::second_angle>("second_angle", kRequired, Unit::kAngle),
    plan_row<&SquareUProfile::depth>("depth", kOptional),
};
constexpr Attribute kRoundedUProfile[] = {
    row<&RoundedUProfile::width>("width", kRequired),
    plan_row<&RoundedUProfile::depth>("depth", kOptional),
};
constexpr Attribute kTeeProfile[] = {
    row<&TeeProfile::first_angle>("first_angle", kRequired, Unit::kAngle),
    row<&TeeProfile::second_angle>("second_angle", kRequired, Unit::kAngle),
    row<&TeeProfile::cross_bar_width>("cross_bar_width", kRequired),
    row<&TeeProfile::cross_bar_depth>("cross_bar_depth", kRequired),
    row<&TeeProfile::radius>("radius", kRequired),
    row<&TeeProfile::width>("width", kRequired),
    row<&TeeProfile::first_offset>("first_offset", kRequired),
    row<&TeeProfile::second_offset>("second_offset", kRequired),
    plan_row<&TeeProfile::depth>("depth", kOptional),
};
constexpr Attribute kVeeProfile[] = {
    row<&VeeProfile::profile_radius>("profile_radius", kRequired),
    row<&VeeProfile::profile_angle>("profile_angle", kRequired, Unit::kAngle),
    row<&VeeProfile::tilt_angle>("tilt_angle", kRequired, Unit::kAngle),
    plan_row<&VeeProfile::first_length>("first_length", kOptional),
    plan_row<&VeeProfile::second_length>("second_length", kOptional),
};
constexpr Attribute kPartialCircularProfile[] = {
    row<&PartialCircularProfile::radius>("radius", kRequired),
    row<&PartialCircularProfile::sweep_angle>("sweep_angle", kRequired, Unit::kAngle),
};
constexpr Attribute kGeneralProfile[] = {
    row<&GeneralProfile::its_profile>("its_profile", kRequired),
    plan_row<&GeneralProfile::path_shape_items>("path_shape_items", kOptional),
};
constexpr Attribute kRectangularClosedProfile[] = {
    row<&RectangularClosedProfile::profile_width>("profile_width", kRequired),
    row<&RectangularClosedProfile::profile_length>("profile_length", kRequired),
    plan_row<&RectangularClosedProfile::corner_radius>("corner_radius", kOptional),
};
constexpr Attribute kCircularClosedProfile[] = {
    row<&CircularClosedProfile::diameter>("diameter", kRequired),
};
constexpr Attribute kNgonClosedProfile[] = {
    row<&NgonClosedProfile::diameter>("diameter", kRequired),
    row<&NgonClosedProfile::number_of_sides>("number_of_sides", kRequired),
    row<&NgonClosedProfile::circumscribed>("circumscribed", kRequired),
    plan_row<&NgonClosedProfile::corner_radius>("corner_radius", kOptional),
};
constexpr Attribute kGeneralClosedProfile[] = {
    row<&GeneralClosedProfile::closed_profile_shape>("closed_profile_shape", kRequired),
    plan_row<&GeneralClosedProfile::path_shape_items>("path_shape_items", kOptional),
};
constexpr Attribute kTravelPath[] = {
    row<&TravelPath::placement>("placement", kOptional),
};
constexpr Attribute kGeneralPath[] = {
    row<&GeneralPath::swept_path>("swept_path", kRequired),
    plan_row<&GeneralPath::path_shape_items>("path_shape_items", kOptional),
};
constexpr Attribute kLinearPath[] = {
    row<&LinearPath::distance>("distance", kRequired),
    row<&LinearPath::its_direction>("its_direction", kRequired),
};
constexpr Attribute kCircularPath[] = {
    row<&CircularPath::radius>("radius", kRequired),
};
constexpr Attribute kPartialCircularPath[] = {
    row<&PartialCircularPath::sweep_angle>("sweep_angle", kRequired, Unit::kAngle),
};
constexpr Attribute kOpenProfile[] = {
    plan_row<&OpenProfile::profile_limit>("profile_limit", kOptional),
};
constexpr Attribute kPlanarPocketBottomCondition[] = {
    plan_row<&PlanarPocketBottomCondition::floor_location>("floor_location", kOptional),
    plan_row<&PlanarPocketBottomCondition::floor_normal>("floor_normal", kOptional),
};

constexpr NounRow kRows[] = {
    {TypeId::kPocketBottomCondition, "POCKET_BOTTOM_CONDITION", TypeId::kNone, true, true, {}},
    {TypeId::kThroughPocketBottomCondition,
     "THROUGH_POCKET_BOTTOM_CONDITION",
     TypeId::kPocketBottomCondition,
     false,
     true,
     {}},
    {TypeId::kPlanarPocketBottomCondition, "PLANAR_POCKET_BOTTOM_CONDITION", TypeId::kPocketBottomCondition,
     false, true, kPlanarPocketBottomCondition},
    {TypeId::kRadiusedPocketBottomCondition, "RADIUSED_POCKET_BOTTOM_CONDITION",
     TypeId::kPocketBottomCondition, false, true, kRadiusedPocketBottomCondition},
    {TypeId::kGeneralPocketBottomCondition, "GENERAL_POCKET_BOTTOM_CONDITION", TypeId::kPocketBottomCondition,
     false, true, kGeneralPocketBottomCondition},
    {TypeId::kSlotEndType, "SLOT_END_TYPE", TypeId::kNone, true, true, {}},
    {TypeId::kWoodruffSlotEndType, "WOODRUFF_SLOT_END_TYPE", TypeId::kSlotEndType, false, true,
     kWoodruffSlotEndType},
    {TypeId::kRadiusedSlotEndType, "RADIUSED_SLOT_END_TYPE", TypeId::kSlotEndType, false, true, {}},
    {TypeId::kFlatSlotEndType, "FLAT_SLOT_END_TYPE", TypeId::kSlotEndType, false, true, kFlatSlotEndType},
    {TypeId::kLoopSlotEndType, "LOOP_SLOT_END_TYPE", TypeId::kSlotEndType, false, true, {}},
    {TypeId::kOpenSlotEndType, "OPEN_SLOT_END_TYPE", TypeId::kSlotEndType, false, true, {}},
    {TypeId::kThroughProfileFloor, "THROUGH_PROFILE_FLOOR", TypeId::kNone, false, true, {}},
    {TypeId::kProfileFloor, "PROFILE_FLOOR", TypeId::kNone, true, true, kProfileFloor},
    {TypeId::kGeneralProfileFloor, "GENERAL_PROFILE_FLOOR", TypeId::kProfileFloor, false, true,
     kGeneralProfileFloor},
    {TypeId::kPlanarProfileFloor, "PLANAR_PROFILE_FLOOR", TypeId::kProfileFloor, false, true,
     kPlanarProfileFloor},
    {TypeId::kDiameterTaper, "DIAMETER_TAPER", TypeId::kNone, false, true, kDiameterTaper},
    {TypeId::kAngleTaper, "ANGLE_TAPER", TypeId::kNone, false, true, kAngleTaper},
    {TypeId::kHoleBottomCondition, "HOLE_BOTTOM_CONDITION", TypeId::kNone, true, true, {}},
    {TypeId::kThroughBottomCondition,
     "THROUGH_BOTTOM_CONDITION",
     TypeId::kHoleBottomCondition,
     false,
     true,
     {}},
    {TypeId::kBlindBottomCondition, "BLIND_BOTTOM_CONDITION", TypeId::kHoleBottomCondition, true, true, {}},
    {TypeId::kFlatHoleBottom, "FLAT_HOLE_BOTTOM", TypeId::kBlindBottomCondition, false, true, {}},
    {TypeId::kFlatWithRadiusHoleBottom, "FLAT_WITH_RADIUS_HOLE_BOTTOM", TypeId::kBlindBottomCondition, false,
     true, kFlatWithRadiusHoleBottom},
    {TypeId::kSphericalHoleBottom, "SPHERICAL_HOLE_BOTTOM", TypeId::kBlindBottomCondition, false, true,
     kSphericalHoleBottom},
    {TypeId::kConicalHoleBottom, "CONICAL_HOLE_BOTTOM", TypeId::kBlindBottomCondition, false, true,
     kConicalHoleBottom},
    {TypeId::kCircularOffset, "CIRCULAR_OFFSET", TypeId::kNone, false, true, kCircularOffset},
    {TypeId::kCircularOmit, "CIRCULAR_OMIT", TypeId::kNone, false, true, kCircularOmit},
    {TypeId::kRectangularOffset, "RECTANGULAR_OFFSET", TypeId::kNone, false, true, kRectangularOffset},
    {TypeId::kRectangularOmit, "RECTANGULAR_OMIT", TypeId::kNone, false, true, kRectangularOmit},
    {TypeId::kPartialAreaDefinition, "PARTIAL_AREA_DEFINITION", TypeId::kNone, false, true,
     kPartialAreaDefinition},
    {TypeId::kProfile, "PROFILE", TypeId::kNone, true, true, kProfile},
    {TypeId::kOpenProfile, "OPEN_PROFILE", TypeId::kProfile, true, true, kOpenProfile},
    {TypeId::kLinearProfile, "LINEAR_PROFILE", TypeId::kOpenProfile, false, true, kLinearProfile},
    {TypeId::kSquareUProfile, "SQUARE_U_PROFILE", TypeId::kOpenProfile, false, true, kSquareUProfile},
    {TypeId::kRoundedUProfile, "ROUNDED_U_PROFILE", TypeId::kOpenProfile, false, true, kRoundedUProfile},
    {TypeId::kTeeProfile, "TEE_PROFILE", TypeId::kOpenProfile, false, true, kTeeProfile},
    {TypeId::kVeeProfile, "VEE_PROFILE", TypeId::kOpenProfile, false, true, kVeeProfile},
    {TypeId::kPartialCircularProfile, "PARTIAL_CIRCULAR_PROFILE", TypeId::kOpenProfile, false, true,
     kPartialCircularProfile},
    {TypeId::kGeneralProfile, "GENERAL_PROFILE", TypeId::kOpenProfile, false, true, kGeneralProfile},
    {TypeId::kClosedProfile, "CLOSED_PROFILE", TypeId::kProfile, true, true, {}},
    {TypeId::kRectangularClosedProfile, "RECTANGULAR_CLOSED_PROFILE", TypeId::kClosedProfile, false, true,
     kRectangularClosedProfile},
    {TypeId::kCircularClosedProfile, "CIRCULAR_CLOSED_PROFILE", TypeId::kClosedProfile, false, true,
     kCircularClosedProfile},
    {TypeId::kNgonClosedProfile, "NGON_CLOSED_PROFILE", TypeId::kClosedProfile, false, true,
     kNgonClosedProfile},
    {TypeId::kGeneralClosedProfile, "GENERAL_CLOSED_PROFILE", TypeId::kClosedProfile, false, true,
     kGeneralClosedProfile},
    {TypeId::kTravelPath, "TRAVEL_PATH", TypeId::kNone, true, true, kTravelPath},
    {TypeId::kGeneralPath, "GENERAL_PATH", TypeId::kTravelPath, false, true, kGeneralPath},
    {TypeId::kLinearPath, "LINEAR_PATH", TypeId::kTravelPath, false, true, kLinearPath},
    {TypeId::kCircularPath, "CIRCULAR_PATH", TypeId::kTravelPath, true, true, kCircularPath},
    {TypeId::kCompleteCircularPath, "COMPLETE_CIRCULAR_PATH", TypeId::kCircularPath, false, true, {}},
    {TypeId::kPartialCircularPath, "PARTIAL_CIRCULAR_PATH", TypeId::kCircularPath, false, true,
     kPartialCircularPath},
};

}  // namespace

std::span<const NounRow> profile_rows() { return kRows; }

}  // namespace capstan::model
