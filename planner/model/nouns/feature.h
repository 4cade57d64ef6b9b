#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Manufacturing features (ISO 14649-10).
/// Lengths in mm, angles in rad, feeds in mm/min, spindle speeds in 1/min (negative is clockwise seen from
/// the spindle, as ISO 14649 signs it), times in s, ratios as fractions of one.

namespace capstan::model {

struct ManufacturingFeature : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kManufacturingFeature;
  Text its_id;
  Ref<Workpiece> its_workpiece;
  RefList<MachiningOperation> its_operations;
  RefList<RepresentationItem> explicit_representation;  ///< optional, not in ISO 14649; its faces in the part
};

struct Region : ManufacturingFeature {  // abstract
  static constexpr TypeId kType = TypeId::kRegion;
  Ref<Axis2Placement3d> feature_placement;  ///< optional
};

struct RegionProjection : Region {
  static constexpr TypeId kType = TypeId::kRegionProjection;
  Ref<BoundedCurve> proj_curve;
  Ref<Direction> proj_dir;
  Ref<TolerancedLengthMeasure> depth;
};

struct RegionSurfaceList : Region {
  static constexpr TypeId kType = TypeId::kRegionSurfaceList;
  RefList<BoundedSurface> surface_list;
};

struct TopologicalRegion : Region {
  static constexpr TypeId kType = TypeId::kTopologicalRegion;
  Text name;
  RefList<Face> cfs_faces;
};

struct Two5dManufacturingFeature : ManufacturingFeature {  // abstract
  static constexpr TypeId kType = TypeId::kTwo5dManufacturingFeature;
  Ref<Axis2Placement3d> feature_placement;
};

struct MachiningFeature : Two5dManufacturingFeature {  // abstract
  static constexpr TypeId kType = TypeId::kMachiningFeature;
  Ref<ElementarySurface> depth;
};

struct PlanarFace : MachiningFeature {
  static constexpr TypeId kType = TypeId::kPlanarFace;
  Ref<LinearPath> course_of_travel;
  Ref<LinearProfile> removal_boundary;
  Ref<ClosedProfile> face_boundary;  ///< optional
  RefList<Boss> its_boss;
  Ref<TolerancedLengthMeasure> removal_depth;  ///< optional, not in ISO 14649
  Ref<Direction> removal_direction;            ///< optional, not in ISO 14649
};

struct Pocket : MachiningFeature {  // abstract
  static constexpr TypeId kType = TypeId::kPocket;
  RefList<Boss> its_boss;
  Real slope;  ///< rad, optional
  Ref<PocketBottomCondition> bottom_condition;
  Ref<TolerancedLengthMeasure> planar_radius;      ///< optional
  Ref<TolerancedLengthMeasure> orthogonal_radius;  ///< optional
  Ref<TravelPath> course_of_travel;                ///< optional, not in ISO 14649; its distance is the depth
  Boolean bottom_at_path_end;                      ///< optional, not in ISO 14649
};

struct ClosedPocket : Pocket {
  static constexpr TypeId kType = TypeId::kClosedPocket;
  Ref<ClosedProfile> feature_boundary;
};

struct OpenPocket : Pocket {
  static constexpr TypeId kType = TypeId::kOpenPocket;
  Ref<OpenProfile> open_boundary;
  Ref<OpenProfile> wall_boundary;  ///< optional
};

struct Slot : MachiningFeature {
  static constexpr TypeId kType = TypeId::kSlot;
  Ref<TravelPath> course_of_travel;
  Ref<OpenProfile> swept_shape;
  RefList<SlotEndType> end_conditions;
};

struct Step : MachiningFeature {
  static constexpr TypeId kType = TypeId::kStep;
  Ref<LinearPath> open_boundary;
  Ref<VeeProfile> wall_boundary;  ///< optional
  RefList<Boss> its_boss;
};

struct ProfileFeature : MachiningFeature {  // abstract
  static constexpr TypeId kType = TypeId::kProfileFeature;
  Ref<LinearPath> profile_swept_shape;
};

struct GeneralOutsideProfile : ProfileFeature {
  static constexpr TypeId kType = TypeId::kGeneralOutsideProfile;
  Ref<Profile> feature_boundary;
};

struct ShapeProfile : ProfileFeature {  // abstract
  static constexpr TypeId kType = TypeId::kShapeProfile;
  OneOf<ThroughProfileFloor, ProfileFloor> floor_condition;
  Ref<Direction> removal_direction;
};

struct GeneralShapeProfile : ShapeProfile {
  static constexpr TypeId kType = TypeId::kGeneralShapeProfile;
  Ref<Profile> profile_boundary;
};

struct PartialCircularShapeProfile : ShapeProfile {
  static constexpr TypeId kType = TypeId::kPartialCircularShapeProfile;
  Ref<PartialCircularProfile> open_boundary;
};

struct CircularClosedShapeProfile : ShapeProfile {
  static constexpr TypeId kType = TypeId::kCircularClosedShapeProfile;
  Ref<CircularClosedProfile> closed_boundary;
};

struct RectangularOpenShapeProfile : ShapeProfile {
  static constexpr TypeId kType = TypeId::kRectangularOpenShapeProfile;
  Ref<SquareUProfile> open_boundary;
};

struct RectangularClosedShapeProfile : ShapeProfile {
  static constexpr TypeId kType = TypeId::kRectangularClosedShapeProfile;
  Ref<RectangularClosedProfile> closed_boundary;
};

struct RoundHole : MachiningFeature {
  static constexpr TypeId kType = TypeId::kRoundHole;
  Ref<TolerancedLengthMeasure> diameter;
  OneOf<DiameterTaper, AngleTaper> change_in_diameter;  ///< optional
  Ref<HoleBottomCondition> bottom_condition;
  Ref<TravelPath> course_of_travel;  ///< optional, not in ISO 14649; its distance is the depth
  Boolean bottom_at_path_end;        ///< optional, not in ISO 14649
};

struct ToolpathFeature : MachiningFeature {
  static constexpr TypeId kType = TypeId::kToolpathFeature;
};

struct Boss : MachiningFeature {
  static constexpr TypeId kType = TypeId::kBoss;
  Ref<ClosedProfile> its_boundary;
  Real slope;                                      ///< rad, optional
  Ref<TravelPath> height;                          ///< optional, not in ISO 14649; its distance is the height
  Ref<TolerancedLengthMeasure> top_fillet_radius;  ///< optional, not in ISO 14649
  Ref<TolerancedLengthMeasure> fillet_radius;      ///< optional, not in ISO 14649; where it meets the floor
};

struct SphericalCap : MachiningFeature {
  static constexpr TypeId kType = TypeId::kSphericalCap;
  Ref<NumericParameter> internal_angle;
  Ref<NumericParameter> radius;
};

struct RoundedEnd : MachiningFeature {
  static constexpr TypeId kType = TypeId::kRoundedEnd;
  Ref<LinearPath> course_of_travel;
  Ref<PartialCircularProfile> partial_circular_boundary;
};

struct CompoundFeature : Two5dManufacturingFeature {
  static constexpr TypeId kType = TypeId::kCompoundFeature;
  RefList<Noun> elements;
};

struct CounterboreHole : CompoundFeature {
  static constexpr TypeId kType = TypeId::kCounterboreHole;
};

struct CountersunkHole : CompoundFeature {
  static constexpr TypeId kType = TypeId::kCountersunkHole;
};

struct ReplicateFeature : Two5dManufacturingFeature {  // abstract
  static constexpr TypeId kType = TypeId::kReplicateFeature;
  Ref<Two5dManufacturingFeature> replicate_base_feature;
};

struct CircularPattern : ReplicateFeature {
  static constexpr TypeId kType = TypeId::kCircularPattern;
  Real angle_increment;  ///< rad
  Integer number_of_feature;
  RefList<CircularOffset> relocated_base_feature;
  RefList<CircularOmit> missing_base_feature;
  Ref<TolerancedLengthMeasure> base_feature_diameter;  ///< optional
  Real base_feature_rotation;                          ///< rad
};

struct RectangularPattern : ReplicateFeature {
  static constexpr TypeId kType = TypeId::kRectangularPattern;
  Ref<TolerancedLengthMeasure> spacing;
  Ref<Direction> its_direction;
  Integer number_of_rows;  ///< optional
  Integer number_of_columns;
  Ref<TolerancedLengthMeasure> row_spacing;  ///< optional
  Ref<Direction> row_layout_direction;       ///< optional
  RefList<RectangularOffset> relocated_base_feature;
  RefList<RectangularOmit> missing_base_feature;
};

struct GeneralPattern : ReplicateFeature {
  static constexpr TypeId kType = TypeId::kGeneralPattern;
  RefList<Axis2Placement3d> replicate_locations;
};

struct TransitionFeature : ManufacturingFeature {  // abstract
  static constexpr TypeId kType = TypeId::kTransitionFeature;
  Ref<MachiningFeature> first_feature;
  Ref<MachiningFeature> second_feature;
  Ref<Face> transition_face;    ///< optional, not in ISO 14649
  Ref<Face> first_face_shape;   ///< optional, not in ISO 14649
  Ref<Face> second_face_shape;  ///< optional, not in ISO 14649
};

struct Chamfer : TransitionFeature {
  static constexpr TypeId kType = TypeId::kChamfer;
  Real angle_to_plane;  ///< rad
  Ref<TolerancedLengthMeasure> first_offset_amount;
  Ref<TolerancedLengthMeasure>
      second_offset_amount;  ///< optional, not in ISO 14649; in place of angle_to_plane
};

struct EdgeRound : TransitionFeature {
  static constexpr TypeId kType = TypeId::kEdgeRound;
  Ref<TolerancedLengthMeasure> radius;
  Ref<TolerancedLengthMeasure> first_offset_amount;   ///< optional
  Ref<TolerancedLengthMeasure> second_offset_amount;  ///< optional
};

struct Thread : MachiningFeature {  // abstract
  static constexpr TypeId kType = TypeId::kThread;
  Ref<PartialAreaDefinition> partial_profile;
  RefList<MachiningFeature> applied_shape;
  Boolean inner_or_outer_thread;
  Ref<DescriptiveParameter> qualifier;  ///< optional
  Ref<DescriptiveParameter> fit_class;
  Ref<DescriptiveParameter> form;
  Real major_diameter;  ///< mm
  Ref<NumericParameter> number_of_threads;
  Ref<DescriptiveParameter> thread_hand;
  Ref<DescriptiveParameter> fit_class_2;  ///< optional, not in ISO 14649
  Ref<NumericParameter> nominal_size;     ///< optional, not in ISO 14649
};

struct CatalogueThread : Thread {
  static constexpr TypeId kType = TypeId::kCatalogueThread;
  Ref<Specification> documentation;
};

struct Specification : Noun {
  static constexpr TypeId kType = TypeId::kSpecification;
  RefList<SpecificationUsageConstraint> constraint;
  Text specification_id;
  Text specification_description;  ///< optional
  Text specification_class;        ///< optional
};

struct SpecificationUsageConstraint : Noun {
  static constexpr TypeId kType = TypeId::kSpecificationUsageConstraint;
  Text element;
  Text class_id;
};

struct DefinedThread : Thread {
  static constexpr TypeId kType = TypeId::kDefinedThread;
  Real pitch_diameter;  ///< mm
  Real minor_diameter;  ///< mm, optional
  Real crest;           ///< mm, optional
};

struct MachinedSurface : Noun {
  static constexpr TypeId kType = TypeId::kMachinedSurface;
  Ref<MachiningFeature> its_machining_feature;
  Enumerated<BottomOrSide> surface_element;
};

struct Fillet : TransitionFeature {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kFillet;
  Ref<TolerancedLengthMeasure> radius;
  Ref<TolerancedLengthMeasure> first_offset_amount;   ///< optional
  Ref<TolerancedLengthMeasure> second_offset_amount;  ///< optional
};

}  // namespace capstan::model
