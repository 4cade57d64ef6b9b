#pragma once

#include "planner/model/attribute.h"
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
  Ref<PersonAndAddress> its_owner;  ///< optional
  Ref<DateAndTime> its_release;     ///< optional
  Ref<Approval> its_status;         ///< optional
};

struct Workpiece : Noun {
  static constexpr TypeId kType = TypeId::kWorkpiece;
  Text its_id;
  Ref<Material> its_material;                         ///< optional
  Real global_tolerance;                              ///< mm, optional
  Ref<Workpiece> its_rawpiece;                        ///< optional
  Ref<AdvancedBrepShapeRepresentation> its_geometry;  ///< optional
  OneOf<Block, RightCircularCylinder, AdvancedBrepShapeRepresentation> its_bounding_geometry;  ///< optional
  RefList<CartesianPoint> clamping_positions;
};

struct Material : Noun {
  static constexpr TypeId kType = TypeId::kMaterial;
  Text standard_identifier;
  Text material_identifier;
  RefList<PropertyParameter> material_property;
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
  Ref<OffsetVector> its_offset;  ///< optional
  OneOf<BoundedSurface, Block, RightCircularCylinder, AdvancedBrepShapeRepresentation>
      its_restricted_area;  ///< optional
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
  Text its_product;                           ///< optional
  Ref<Axis2Placement3d> mount_reference;      ///< optional
  Ref<Axis2Placement3d> workpiece_reference;  ///< optional
  Text description;                           ///< optional
};

}  // namespace capstan::model
