#include "planner/model/nouns/feature.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kManufacturingFeature[] = {
    row<&ManufacturingFeature::its_id>("its_id", kRequired),
    row<&ManufacturingFeature::its_workpiece>("its_workpiece", kRequired),
    row<&ManufacturingFeature::its_operations>("its_operations", kRequired),
    plan_row<&ManufacturingFeature::explicit_representation>("explicit_representation", kOptional),
};
constexpr Attribute kRegion[] = {
    row<&Region::feature_placement>("feature_placement", kOptional),
};
constexpr Attribute kRegionProjection[] = {
    row<&RegionProjection::proj_curve>("proj_curve", kRequired),
    row<&RegionProjection::proj_dir>("proj_dir", kRequired),
    row<&RegionProjection::depth>("depth", kRequired),
};
constexpr Attribute kRegionSurfaceList[] = {
    row<&RegionSurfaceList::surface_list>("surface_list", kRequired),
};
constexpr Attribute kTopologicalRegion[] = {
    row<&TopologicalRegion::name>("name", kRequired),
    row<&TopologicalRegion::cfs_faces>("cfs_faces", kRequired),
};
constexpr Attribute kTwo5dManufacturingFeature[] = {
    row<&Two5dManufacturingFeature::feature_placement>("feature_placement", kRequired),
};
constexpr Attribute kMachiningFeature[] = {
    row<&MachiningFeature::depth>("depth", kRequired),
};
constexpr Attribute kPlanarFace[] = {
    row<&PlanarFace::course_of_travel>("course_of_travel", kRequired),
    row<&PlanarFace::removal_boundary>("removal_boundary", kRequired),
    row<&PlanarFace::face_boundary>("face_boundary", kOptional),
    row<&PlanarFace::its_boss>("its_boss", kRequired),
    plan_row<&PlanarFace::removal_depth>("removal_depth", kOptional),
    plan_row<&PlanarFace::removal_direction>("removal_direction", kOptional),
};
constexpr Attribute kPocket[] = {
    row<&Pocket::its_boss>("its_boss", kRequired),
    row<&Pocket::slope>("slope", kOptional, Unit::kAngle),
    row<&Pocket::bottom_condition>("bottom_condition", kRequired),
    row<&Pocket::planar_radius>("planar_radius", kOptional),
    row<&Pocket::orthogonal_radius>("orthogonal_radius", kOptional),
    plan_row<&Pocket::course_of_travel>("course_of_travel", kOptional),
    plan_row<&Pocket::bottom_at_path_end>("bottom_at_path_end", kOptional),
};
constexpr Attribute kClosedPocket[] = {
    row<&ClosedPocket::feature_boundary>("feature_boundary", kRequired),
};
constexpr Attribute kOpenPocket[] = {
    row<&OpenPocket::open_boundary>("open_boundary", kRequired),
    row<&OpenPocket::wall_boundary>("wall_boundary", kOptional),
};
constexpr Attribute kSlot[] = {
    row<&Slot::course_of_travel>("course_of_travel", kRequired),
    row<&Slot::swept_shape>("swept_shape", kRequired),
    row<&Slot::end_conditions>("end_conditions", kRequired),
};
constexpr Attribute kStep[] = {
    row<&Step::open_boundary>("open_boundary", kRequired),
    row<&Step::wall_boundary>("wall_boundary", kOptional),
    row<&Step::its_boss>("its_boss", kRequired),
};
constexpr Attribute kProfileFeature[] = {
    row<&ProfileFeature::profile_swept_shape>("profile_swept_shape", kRequired),
};
constexpr Attribute kGeneralOutsideProfile[] = {
    row<&GeneralOutsideProfile::feature_boundary>("feature_boundary", kRequired),
};
constexpr Attribute kShapeProfile[] = {
    row<&ShapeProfile::floor_condition>("floor_condition", kRequired),
    row<&ShapeProfile::removal_direction>("removal_direction", kRequired),
};
constexpr Attribute kGeneralShapeProfile[] = {
    row<&GeneralShapeProfile::profile_boundary>("profile_boundary", kRequired),
};
constexpr Attribute kPartialCircularShapeProfile[] = {
    row<&PartialCircularShapeProfile::open_boundary>("open_boundary", kRequired),
};
constexpr Attribute kCircularClosedShapeProfile[] = {
    row<&CircularClosedShapeProfile::closed_boundary>("closed_boundary", kRequired),
};
constexpr Attribute kRectangularOpenShapeProfile[] = {
    row<&RectangularOpenShapeProfile::open_boundary>("open_boundary", kRequired),
};
constexpr Attribute kRectangularClosedShapeProfile[] = {
    row<&RectangularClosedShapeProfile::closed_boundary>("closed_boundary", kRequired),
};
constexpr Attribute kRoundHole[] = {
    row<&RoundHole::diameter>("diameter", kRequired),
    row<&RoundHole::change_in_diameter>("change_in_diameter", kOptional),
    row<&RoundHole::bottom_condition>("bottom_condition", kRequired),
    plan_row<&RoundHole::course_of_travel>("course_of_travel", kOptional),
    plan_row<&RoundHole::bottom_at_path_end>("bottom_at_path_end", kOptional),
};
constexpr Attribute kBoss[] = {
    row<&Boss::its_boundary>("its_boundary", kRequired),
    row<&Boss::slope>("slope", kOptional, Unit::kAngle),
    plan_row<&Boss::height>("height", kOptional),
    plan_row<&Boss::top_fillet_radius>("top_fillet_radius", kOptional),
    plan_row<&Boss::fillet_radius>("fillet_radius", kOptional),
};
constexpr Attribute kSphericalCap[] = {
    row<&SphericalCap::internal_angle>("internal_angle", kRequired),
    row<&SphericalCap::radius>("radius", kRequired),
};
constexpr Attribute kRoundedEnd[] = {
    row<&RoundedEnd::course_of_travel>("course_of_travel", kRequired),
    row<&RoundedEnd::partial_circular_boundary>("partial_circular_boundary", kRequired),
};
constexpr Attribute kCompoundFeature[] = {
    row<&CompoundFeature::elements>("elements", kRequired),
};
constexpr Attribute kReplicateFeature[] = {
    row<&ReplicateFeature::replicate_base_feature>("replicate_base_feature", kRequired),
};
constexpr Attribute kCircularPattern[] = {
    row<&CircularPattern::angle_increment>("angle_increment", kRequired, Unit::kAngle),
    row<&CircularPattern::number_of_feature>("number_of_feature", kRequired),
    row<&CircularPattern::relocated_base_feature>("relocated_base_feature", kRequired),
    row<&CircularPattern::missing_base_feature>("missing_base_feature", kRequired),
    row<&CircularPattern::base_feature_diameter>("base_feature_diameter", kOptional),
    row<&CircularPattern::base_feature_rotation>("base_feature_rotation", kRequired, Unit::kAngle),
};
constexpr Attribute kRectangularPattern[] = {
    row<&RectangularPattern::spacing>("spacing", kRequired),
    row<&RectangularPattern::its_direction>("its_direction", kRequired),
    row<&RectangularPattern::number_of_rows>("number_of_rows", kOptional),
    row<&RectangularPattern::number_of_columns>("number_of_columns", kRequired),
    row<&RectangularPattern::row_spacing>("row_spacing", kOptional),
    row<&RectangularPattern::row_layout_direction>("row_layout_direction", kOptional),
    row<&RectangularPattern::relocated_base_feature>("relocated_base_feature", kRequired),
    row<&RectangularPattern::missing_base_feature>("missing_base_feature", kRequired),
};
constexpr Attribute kGeneralPattern[] = {
    row<&GeneralPattern::replicate_locations>("replicate_locations", kRequired),
};
constexpr Attribute kTransitionFeature[] = {
    row<&TransitionFeature::first_feature>("first_feature", kRequired),
    row<&TransitionFeature::second_feature>("second_feature", kRequired),
    plan_row<&TransitionFeature::transition_face>("transition_face", kOptional),
    plan_row<&TransitionFeature::first_face_shape>("first_face_shape", kOptional),
    plan_row<&TransitionFeature::second_face_shape>("second_face_shape", kOptional),
};
constexpr Attribute kChamfer[] = {
    row<&Chamfer::angle_to_plane>("angle_to_plane", kRequired, Unit::kAngle),
    row<&Chamfer::first_offset_amount>("first_offset_amount", kRequired),
    plan_row<&Chamfer::second_offset_amount>("second_offset_amount", kOptional),
};
constexpr Attribute kEdgeRound[] = {
    row<&EdgeRound::radius>("radius", kRequired),
    row<&EdgeRound::first_offset_amount>("first_offset_amount", kOptional),
    row<&EdgeRound::second_offset_amount>("second_offset_amount", kOptional),
};
constexpr Attribute kThread[] = {
    row<&Thread::partial_profile>("partial_profile", kRequired),
    row<&Thread::applied_shape>("applied_shape", kRequired),
    row<&Thread::inner_or_outer_thread>("inner_or_outer_thread", kRequired),
    row<&Thread::qualifier>("qualifier", kOptional),
    row<&Thread::fit_class>("fit_class", kRequired),
    row<&Thread::form>("form", kRequired),
    row<&Thread::major_diameter>("major_diameter", kRequired, Unit::kLength),
    row<&Thread::number_of_threads>("number_of_threads", kRequired),
    row<&Thread::thread_hand>("thread_hand", kRequired),
    plan_row<&Thread::fit_class_2>("fit_class_2", kOptional),
    plan_row<&Thread::nominal_size>("nominal_size", kOptional),
};
constexpr Attribute kCatalogueThread[] = {
    row<&CatalogueThread::documentation>("documentation", kRequired),
};
constexpr Attribute kSpecification[] = {
    row<&Specification::constraint>("constraint", kRequired),
    row<&Specification::specification_id>("specification_id", kRequired),
    row<&Specification::specification_description>("specification_description", kOptional),
    row<&Specification::specification_class>("specification_class", kOptional),
};
constexpr Attribute kSpecificationUsageConstraint[] = {
    row<&SpecificationUsageConstraint::element>("element", kRequired),
    row<&SpecificationUsageConstraint::class_id>("class_id", kRequired),
};
constexpr Attribute kDefinedThread[] = {
    row<&DefinedThread::pitch_diameter>("pitch_diameter", kRequired, Unit::kLength),
    row<&DefinedThread::minor_diameter>("minor_diameter", kOptional, Unit::kLength),
    row<&DefinedThread::crest>("crest", kOptional, Unit::kLength),
};
constexpr Attribute kMachinedSurface[] = {
    row<&MachinedSurface::its_machining_feature>("its_machining_feature", kRequired),
    row<&MachinedSurface::surface_element>("surface_element", kRequired),
};
constexpr Attribute kFillet[] = {
    plan_row<&Fillet::radius>("radius", kRequired),
    plan_row<&Fillet::first_offset_amount>("first_offset_amount", kOptional),
    plan_row<&Fillet::second_offset_amount>("second_offset_amount", kOptional),
};

constexpr NounRow kRows[] = {
    {TypeId::kManufacturingFeature, "MANUFACTURING_FEATURE", TypeId::kNone, true, true,
     kManufacturingFeature},
    {TypeId::kRegion, "REGION", TypeId::kManufacturingFeature, true, true, kRegion},
    {TypeId::kRegionProjection, "REGION_PROJECTION", TypeId::kRegion, false, true, kRegionProjection},
    {TypeId::kRegionSurfaceList, "REGION_SURFACE_LIST", TypeId::kRegion, false, true, kRegionSurfaceList},
    {TypeId::kTopologicalRegion, "TOPOLOGICAL_REGION", TypeId::kRegion, false, true, kTopologicalRegion},
    {TypeId::kTwo5dManufacturingFeature, "TWO5D_MANUFACTURING_FEATURE", TypeId::kManufacturingFeature, true,
     true, kTwo5dManufacturingFeature},
    {TypeId::kMachiningFeature, "MACHINING_FEATURE", TypeId::kTwo5dManufacturingFeature, true, true,
     kMachiningFeature},
    {TypeId::kPlanarFace, "PLANAR_FACE", TypeId::kMachiningFeature, false, true, kPlanarFace},
    {TypeId::kPocket, "POCKET", TypeId::kMachiningFeature, true, true, kPocket},
    {TypeId::kClosedPocket, "CLOSED_POCKET", TypeId::kPocket, false, true, kClosedPocket},
    {TypeId::kOpenPocket, "OPEN_POCKET", TypeId::kPocket, false, true, kOpenPocket},
    {TypeId::kSlot, "SLOT", TypeId::kMachiningFeature, false, true, kSlot},
    {TypeId::kStep, "STEP", TypeId::kMachiningFeature, false, true, kStep},
    {TypeId::kProfileFeature, "PROFILE_FEATURE", TypeId::kMachiningFeature, true, true, kProfileFeature},
    {TypeId::kGeneralOutsideProfile, "GENERAL_OUTSIDE_PROFILE", TypeId::kProfileFeature, false, true,
     kGeneralOutsideProfile},
    {TypeId::kShapeProfile, "SHAPE_PROFILE", TypeId::kProfileFeature, true, true, kShapeProfile},
    {TypeId::kGeneralShapeProfile, "GENERAL_SHAPE_PROFILE", TypeId::kShapeProfile, false, true,
     kGeneralShapeProfile},
    {TypeId::kPartialCircularShapeProfile, "PARTIAL_CIRCULAR_SHAPE_PROFILE", TypeId::kShapeProfile, false,
     true, kPartialCircularShapeProfile},
    {TypeId::kCircularClosedShapeProfile, "CIRCULAR_CLOSED_SHAPE_PROFILE", TypeId::kShapeProfile, false, true,
     kCircularClosedShapeProfile},
    {TypeId::kRectangularOpenShapeProfile, "RECTANGULAR_OPEN_SHAPE_PROFILE", TypeId::kShapeProfile, false,
     true, kRectangularOpenShapeProfile},
    {TypeId::kRectangularClosedShapeProfile, "RECTANGULAR_CLOSED_SHAPE_PROFILE", TypeId::kShapeProfile, false,
     true, kRectangularClosedShapeProfile},
    {TypeId::kRoundHole, "ROUND_HOLE", TypeId::kMachiningFeature, false, true, kRoundHole},
    {TypeId::kToolpathFeature, "TOOLPATH_FEATURE", TypeId::kMachiningFeature, false, true, {}},
    {TypeId::kBoss, "BOSS", TypeId::kMachiningFeature, false, true, kBoss},
    {TypeId::kSphericalCap, "SPHERICAL_CAP", TypeId::kMachiningFeature, false, true, kSphericalCap},
    {TypeId::kRoundedEnd, "ROUNDED_END", TypeId::kMachiningFeature, false, true, kRoundedEnd},
    {TypeId::kCompoundFeature, "COMPOUND_FEATURE", TypeId::kTwo5dManufacturingFeature, false, true,
     kCompoundFeature},
    {TypeId::kCounterboreHole, "COUNTERBORE_HOLE", TypeId::kCompoundFeature, false, true, {}},
    {TypeId::kCountersunkHole, "COUNTERSUNK_HOLE", TypeId::kCompoundFeature, false, true, {}},
    {TypeId::kReplicateFeature, "REPLICATE_FEATURE", TypeId::kTwo5dManufacturingFeature, true, true,
     kReplicateFeature},
    {TypeId::kCircularPattern, "CIRCULAR_PATTERN", TypeId::kReplicateFeature, false, true, kCircularPattern},
    {TypeId::kRectangularPattern, "RECTANGULAR_PATTERN", TypeId::kReplicateFeature, false, true,
     kRectangularPattern},
    {TypeId::kGeneralPattern, "GENERAL_PATTERN", TypeId::kReplicateFeature, false, true, kGeneralPattern},
    {TypeId::kTransitionFeature, "TRANSITION_FEATURE", TypeId::kManufacturingFeature, true, true,
     kTransitionFeature},
    {TypeId::kChamfer, "CHAMFER", TypeId::kTransitionFeature, false, true, kChamfer},
    {TypeId::kEdgeRound, "EDGE_ROUND", TypeId::kTransitionFeature, false, true, kEdgeRound},
    {TypeId::kThread, "THREAD", TypeId::kMachiningFeature, true, true, kThread},
    {TypeId::kCatalogueThread, "CATALOGUE_THREAD", TypeId::kThread, false, true, kCatalogueThread},
    {TypeId::kSpecification, "SPECIFICATION", TypeId::kNone, false, true, kSpecification},
    {TypeId::kSpecificationUsageConstraint, "SPECIFICATION_USAGE_CONSTRAINT", TypeId::kNone, false, true,
     kSpecificationUsageConstraint},
    {TypeId::kDefinedThread, "DEFINED_THREAD", TypeId::kThread, false, true, kDefinedThread},
    {TypeId::kMachinedSurface, "MACHINED_SURFACE", TypeId::kNone, false, true, kMachinedSurface},
    {TypeId::kFillet, "FILLET", TypeId::kTransitionFeature, false, false, kFillet},
};

}  // namespace

std::span<const NounRow> feature_rows() { return kRows; }

}  // namespace capstan::model
