#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Profiles, travel paths, bottom conditions and slot ends (ISO 14649-10).
/// Lengths in mm, angles in rad, feeds in mm/min, spindle speeds in 1/min (negative is clockwise seen from
/// the spindle, as ISO 14649 signs it), times in s, ratios as fractions of one.

namespace capstan::model {

struct PocketBottomCondition : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kPocketBottomCondition;
};

struct ThroughPocketBottomCondition : PocketBottomCondition {
  static constexpr TypeId kType = TypeId::kThroughPocketBottomCondition;
};

struct PlanarPocketBottomCondition : PocketBottomCondition {
  static constexpr TypeId kType = TypeId::kPlanarPocketBottomCondition;
  Ref<CartesianPoint> floor_location;  ///< optional, not in ISO 14649
  Ref<Direction> floor_normal;         ///< optional, not in ISO 14649
};

struct RadiusedPocketBottomCondition : PocketBottomCondition {
  static constexpr TypeId kType = TypeId::kRadiusedPocketBottomCondition;
  Ref<CartesianPoint> floor_radius_center;
  Ref<TolerancedLengthMeasure> floor_radius;
};

struct GeneralPocketBottomCondition : PocketBottomCondition {
  static constexpr TypeId kType = TypeId::kGeneralPocketBottomCondition;
  Ref<Region> shape;
};

struct SlotEndType : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kSlotEndType;
};

struct WoodruffSlotEndType : SlotEndType {
  static constexpr TypeId kType = TypeId::kWoodruffSlotEndType;
  Ref<TolerancedLengthMeasure> radius;
};

struct RadiusedSlotEndType : SlotEndType {
  static constexpr TypeId kType = TypeId::kRadiusedSlotEndType;
};

struct FlatSlotEndType : SlotEndType {
  static constexpr TypeId kType = TypeId::kFlatSlotEndType;
  Ref<TolerancedLengthMeasure> corner_radius1;
  Ref<TolerancedLengthMeasure> corner_radius2;
};

struct LoopSlotEndType : SlotEndType {
  static constexpr TypeId kType = TypeId::kLoopSlotEndType;
};

struct OpenSlotEndType : SlotEndType {
  static constexpr TypeId kType = TypeId::kOpenSlotEndType;
};

struct ThroughProfileFloor : Noun {
  static constexpr TypeId kType = TypeId::kThroughProfileFloor;
};

struct ProfileFloor : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kProfileFloor;
  Ref<NumericParameter> floor_radius;  ///< optional
  Boolean start_or_end;
};

struct GeneralProfileFloor : ProfileFloor {
  static constexpr TypeId kType = TypeId::kGeneralProfileFloor;
  Ref<Face> floor;
};

struct PlanarProfileFloor : ProfileFloor {
  static constexpr TypeId kType = TypeId::kPlanarProfileFloor;
  Ref<Plane> floor;
};

struct DiameterTaper : Noun {
  static constexpr TypeId kType = TypeId::kDiameterTaper;
  Ref<TolerancedLengthMeasure> final_diameter;
};

struct AngleTaper : Noun {
  static constexpr TypeId kType = TypeId::kAngleTaper;
  Real angle;  ///< rad
};

struct HoleBottomCondition : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kHoleBottomCondition;
};

struct ThroughBottomCondition : HoleBottomCondition {
  static constexpr TypeId kType = TypeId::kThroughBottomCondition;
};

struct BlindBottomCondition : HoleBottomCondition {  // abstract
  static constexpr TypeId kType = TypeId::kBlindBottomCondition;
};

struct FlatHoleBottom : BlindBottomCondition {
  static constexpr TypeId kType = TypeId::kFlatHoleBottom;
};

struct FlatWithRadiusHoleBottom : BlindBottomCondition {
  static constexpr TypeId kType = TypeId::kFlatWithRadiusHoleBottom;
  Ref<TolerancedLengthMeasure> corner_radius;
};

struct SphericalHoleBottom : BlindBottomCondition {
  static constexpr TypeId kType = TypeId::kSphericalHoleBottom;
  Ref<TolerancedLengthMeasure> radius;
};

struct ConicalHoleBottom : BlindBottomCondition {
  static constexpr TypeId kType = TypeId::kConicalHoleBottom;
  Real tip_angle;                           ///< rad
  Ref<TolerancedLengthMeasure> tip_radius;  ///< optional
};

struct CircularOffset : Noun {
  static constexpr TypeId kType = TypeId::kCircularOffset;
  Real angular_offset;  ///< rad
  Integer index;
};

struct CircularOmit : Noun {
  static constexpr TypeId kType = TypeId::kCircularOmit;
  Integer index;
};

struct RectangularOffset : Noun {
  static constexpr TypeId kType = TypeId::kRectangularOffset;
  Ref<Direction> offset_direction;
  Real offset_distance;  ///< mm
  Integer row_index;
  Integer column_index;
};

struct RectangularOmit : Noun {
  static constexpr TypeId kType = TypeId::kRectangularOmit;
  Integer row_index;
  Integer column_index;
};

struct PartialAreaDefinition : Noun {
  static constexpr TypeId kType = TypeId::kPartialAreaDefinition;
  Real effective_length;  ///< mm
  Ref<Axis2Placement3d> placement;
  Real maximum_length;  ///< mm, optional
};

struct Profile : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kProfile;
  Ref<Axis2Placement3d> placement;  ///< optional
};

struct OpenProfile : Profile {  // abstract
  static constexpr TypeId kType = TypeId::kOpenProfile;
  Ref<Representation> profile_limit;  ///< optional, not in ISO 14649
};

struct LinearProfile : OpenProfile {
  static constexpr TypeId kType = TypeId::kLinearProfile;
  Ref<NumericParameter> profile_length;
};

struct SquareUProfile : OpenProfile {
  static constexpr TypeId kType = TypeId::kSquareUProfile;
  Ref<TolerancedLengthMeasure> width;
  Ref<TolerancedLengthMeasure> first_radius;
  Real first_angle;  ///< rad
  Ref<TolerancedLengthMeasure> second_radius;
  Real second_angle;                   ///< rad
  Ref<TolerancedLengthMeasure> depth;  ///< optional, not in ISO 14649
};

struct RoundedUProfile : OpenProfile {
  static constexpr TypeId kType = TypeId::kRoundedUProfile;
  Ref<TolerancedLengthMeasure> width;
  Ref<TolerancedLengthMeasure> depth;  ///< optional, not in ISO 14649
};

struct TeeProfile : OpenProfile {
  static constexpr TypeId kType = TypeId::kTeeProfile;
  Real first_angle;   ///< rad
  Real second_angle;  ///< rad
  Ref<TolerancedLengthMeasure> cross_bar_width;
  Ref<TolerancedLengthMeasure> cross_bar_depth;
  Ref<TolerancedLengthMeasure> radius;
  Ref<TolerancedLengthMeasure> width;
  Ref<TolerancedLengthMeasure> first_offset;
  Ref<TolerancedLengthMeasure> second_offset;
  Ref<TolerancedLengthMeasure> depth;  ///< optional, not in ISO 14649
};

struct VeeProfile : OpenProfile {
  static constexpr TypeId kType = TypeId::kVeeProfile;
  Ref<TolerancedLengthMeasure> profile_radius;
  Real profile_angle;                          ///< rad
  Real tilt_angle;                             ///< rad
  Ref<TolerancedLengthMeasure> first_length;   ///< optional, not in ISO 14649
  Ref<TolerancedLengthMeasure> second_length;  ///< optional, not in ISO 14649
};

struct PartialCircularProfile : OpenProfile {
  static constexpr TypeId kType = TypeId::kPartialCircularProfile;
  Ref<TolerancedLengthMeasure> radius;
  Real sweep_angle;  ///< rad
};

struct GeneralProfile : OpenProfile {
  static constexpr TypeId kType = TypeId::kGeneralProfile;
  Ref<BoundedCurve> its_profile;
  RefList<RepresentationItem> path_shape_items;  ///< optional, not in ISO 14649; beside its_profile, in order
};

struct ClosedProfile : Profile {  // abstract
  static constexpr TypeId kType = TypeId::kClosedProfile;
};

struct RectangularClosedProfile : ClosedProfile {
  static constexpr TypeId kType = TypeId::kRectangularClosedProfile;
  Ref<TolerancedLengthMeasure> profile_width;
  Ref<TolerancedLengthMeasure> profile_length;
  Ref<TolerancedLengthMeasure> corner_radius;  ///< optional, not in ISO 14649
};

struct CircularClosedProfile : ClosedProfile {
  static constexpr TypeId kType = TypeId::kCircularClosedProfile;
  Ref<TolerancedLengthMeasure> diameter;
};

struct NgonClosedProfile : ClosedProfile {
  static constexpr TypeId kType = TypeId::kNgonClosedProfile;
  Ref<TolerancedLengthMeasure> diameter;
  Integer number_of_sides;
  Boolean circumscribed;
  Ref<TolerancedLengthMeasure> corner_radius;  ///< optional, not in ISO 14649
};

struct GeneralClosedProfile : ClosedProfile {
  static constexpr TypeId kType = TypeId::kGeneralClosedProfile;
  Ref<BoundedCurve> closed_profile_shape;
  RefList<RepresentationItem>
      path_shape_items;  ///< optional, not in ISO 14649; beside closed_profile_shape, in order
};

struct TravelPath : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kTravelPath;
  Ref<Axis2Placement3d> placement;  ///< optional
};

struct GeneralPath : TravelPath {
  static constexpr TypeId kType = TypeId::kGeneralPath;
  Ref<BoundedCurve> swept_path;
  RefList<RepresentationItem> path_shape_items;  ///< optional, not in ISO 14649; beside swept_path, in order
};

struct LinearPath : TravelPath {
  static constexpr TypeId kType = TypeId::kLinearPath;
  Ref<TolerancedLengthMeasure> distance;
  Ref<Direction> its_direction;
};

struct CircularPath : TravelPath {  // abstract
  static constexpr TypeId kType = TypeId::kCircularPath;
  Ref<TolerancedLengthMeasure> radius;
};

struct CompleteCircularPath : CircularPath {
  static constexpr TypeId kType = TypeId::kCompleteCircularPath;
};

struct PartialCircularPath : CircularPath {
  static constexpr TypeId kType = TypeId::kPartialCircularPath;
  Real sweep_angle;  ///< rad
};

}  // namespace capstan::model
