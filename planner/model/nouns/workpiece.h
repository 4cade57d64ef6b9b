#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Project, workpiece, material and set-up (ISO 14649-10).
/// Lengths in mm, angles in rad, feeds in mm/min, spindle speeds in 1/min (negative is clockwise seen from
/// the spindle, as ISO 14649 signs it), times in s, ratios as fractions of one.

namespace capstan::model {

struct Project : Noun {
  static constexpr TypeId kType = TypeId::kProject;
  Text its_id;
  Ref<Workplan> main_workplan;
  RefList<Workpiece> its_workpieces;
  OneOf<PersonAndAddress, PersonAndOrganization> its_owner;  ///< optional
  Ref<DateAndTime> its_release;                              ///< optional
  Ref<Approval> its_status;                                  ///< optional
  Ref<LastModifiedTimestamp> last_modified_timestamp;        ///< optional, not in ISO 14649
};

struct Workpiece : Noun {
  static constexpr TypeId kType = TypeId::kWorkpiece;
  Text its_id;
  Ref<Material> its_material;                                                      ///< optional
  Real global_tolerance;                                                           ///< mm, optional
  Ref<Workpiece> its_rawpiece;                                                     ///< optional
  Ref<ShapeRepresentation> its_geometry;                                           ///< optional
  OneOf<Block, RightCircularCylinder, ShapeRepresentation> its_bounding_geometry;  ///< optional
  RefList<CartesianPoint> clamping_positions;
  RefList<Approval> its_approvals;                               ///< optional, not in ISO 14649
  TextList its_categories;                                       ///< optional, not in ISO 14649
  RefList<NextAssemblyUsage> its_components;                     ///< optional, not in ISO 14649
  RefList<DateTimeAssignment> its_datestamps;                    ///< optional, not in ISO 14649
  RefList<PersonOrganizationAssignment> its_orgs;                ///< optional, not in ISO 14649
  RefList<PersonOrganizationAssignment> its_people;              ///< optional, not in ISO 14649
  RefList<ShapeRepresentation> its_related_geometry;             ///< optional, not in ISO 14649
  RefList<DateTimeAssignment> its_timestamps;                    ///< optional, not in ISO 14649
  RefList<Approval> product_approvals;                           ///< optional, not in ISO 14649
  RefList<DateTimeAssignment> product_datestamps;                ///< optional, not in ISO 14649
  RefList<PersonOrganizationAssignment> product_orgs;            ///< optional, not in ISO 14649
  RefList<PersonOrganizationAssignment> product_people;          ///< optional, not in ISO 14649
  RefList<DateTimeAssignment> product_timestamps;                ///< optional, not in ISO 14649
  RefList<Approval> revision_approvals;                          ///< optional, not in ISO 14649
  RefList<DateTimeAssignment> revision_datestamps;               ///< optional, not in ISO 14649
  Text revision_id;                                              ///< optional, not in ISO 14649
  RefList<PersonOrganizationAssignment> revision_orgs;           ///< optional, not in ISO 14649
  RefList<PersonOrganizationAssignment> revision_people;         ///< optional, not in ISO 14649
  RefList<DateTimeAssignment> revision_timestamps;               ///< optional, not in ISO 14649
  RefList<SecurityClassification> its_security_classifications;  ///< optional, not in ISO 14649
  Ref<LastModifiedTimestamp> last_modified_timestamp;            ///< optional, not in ISO 14649
  RefList<Representation> its_styled_models;                     ///< optional, not in ISO 14649
  Ref<Workpiece> material_workpiece;         ///< what it is made from, optional, not in ISO 14649
  RefList<AssignedProperty> its_properties;  ///< optional, not in ISO 14649
  /// What is stated of this workpiece; each also names it in its_workpiece. Optional, not in ISO 14649.
  OneOfList<GeometricTolerance, ShapeDimension, Datum, DatumTarget, ShapeElement, SurfaceTextureParameter>
      its_requirements;
};

struct Material : Noun {
  static constexpr TypeId kType = TypeId::kMaterial;
  Text standard_identifier;
  Text material_identifier;
  RefList<PropertyParameter> material_property;
  RefList<MaterialProperty> its_properties;  ///< optional, not in ISO 14649
};

struct InProcessGeometry : Noun {
  static constexpr TypeId kType = TypeId::kInProcessGeometry;
  Ref<AdvancedBrepShapeRepresentation> as_is;    ///< optional
  Ref<AdvancedBrepShapeRepresentation> to_be;    ///< optional
  Ref<AdvancedBrepShapeRepresentation> removal;  ///< optional
};

struct OffsetVector : Noun {
  static constexpr TypeId kType = TypeId::kOffsetVector;
  RefList<NcVariable> translate;
  RefList<NcVariable> rotate;  ///< optional
};

struct Setup : Noun {
  static constexpr TypeId kType = TypeId::kSetup;
  Text its_id;
  Ref<Axis2Placement3d> its_origin;  ///< optional
  Ref<ElementarySurface> its_secplane;
  RefList<WorkpieceSetup> its_workpiece_setup;
  Ref<FixtureUsage> its_fixture_usage;  ///< optional, not in ISO 14649
};

struct WorkpieceSetup : Noun {
  static constexpr TypeId kType = TypeId::kWorkpieceSetup;
  Ref<Workpiece> its_workpiece;
  Ref<Axis2Placement3d> its_origin;
  Ref<OffsetVector> its_offset;                                                                  ///< optional
  OneOf<BoundedSurface, Block, RightCircularCylinder, ShapeRepresentation> its_restricted_area;  ///< optional
  RefList<SetupInstruction> its_instructions;
};

struct SetupInstruction : Noun {
  static constexpr TypeId kType = TypeId::kSetupInstruction;
  Text description;        ///< optional
  Text external_document;  ///< optional
};

struct MachineAxisTravel : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kMachineAxisTravel;
  Text axis_identifier;
  Real travel_distance;  ///< mm
  Real travel_angle;     ///< rad, optional; of a rotary axis
};

struct MachineParameters : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kMachineParameters;
  Real feedrate;                           ///< mm/min, optional
  Real spindle_speed;                      ///< 1/min, optional
  Real spindle_power;                      ///< W, optional
  Real spindle_torque;                     ///< Nm, optional
  Integer number_of_control_axis;          ///< optional
  Integer number_of_simultaneous_axis;     ///< optional
  Real positioning_accuracy;               ///< mm, optional
  Boolean table_indexing;                  ///< optional
  Real table_length;                       ///< mm, optional
  Real table_width;                        ///< mm, optional
  RefList<MachineAxisTravel> axis_travel;  ///< optional
  Real work_volume_length;                 ///< mm, optional
  Real work_volume_width;                  ///< mm, optional
  Real work_volume_height;                 ///< mm, optional
};

struct FixtureUsage : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kFixtureUsage;
  Text its_id;
  Ref<Workpiece> its_product;                 ///< optional
  Ref<Axis2Placement3d> mount_reference;      ///< optional
  Ref<Axis2Placement3d> workpiece_reference;  ///< optional
  Text description;                           ///< optional
};

/// A part of an assembly, seen from the assembly.
struct NextAssemblyUsage : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kNextAssemblyUsage;
  Text its_id;                ///< optional
  Text name;                  ///< optional
  Text reference_designator;  ///< optional
  Ref<Workpiece> child_workpiece;
  Ref<Axis2Placement3d> item_transform;         ///< optional; where it lies in the assembly
  Ref<Axis2Placement3d> item_transform_origin;  ///< optional; the placement in the child that is put there
};

struct MachineUsage : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kMachineUsage;
  Text its_id;
  Ref<Workpiece> its_product;  ///< optional
  Text description;            ///< optional
};

struct MachineWithKinematics : Workpiece {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kMachineWithKinematics;
  Text configuration;  ///< optional
  Ref<Representation> mechanism;
};

}  // namespace capstan::model
