#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Properties of parts, surfaces, materials and processes (ISO 10303-238).
/// None of this is in ISO 14649. Lengths in mm, angles in rad, times in s.

namespace capstan::model {

/// What a property is, apart from whose it is.
struct GeneralProperty : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kGeneralProperty;
  Text its_id;
  Text name;
  Text description;  ///< optional
};

struct AssignedProperty : Noun {  // abstract, ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kAssignedProperty;
  Text name;
  Text description;                           ///< optional
  Ref<GeneralProperty> general_property;      ///< optional
  RefList<PropertyParameter> its_parameters;  ///< optional; its values: numbers with units, or texts
};

struct PartProperty : AssignedProperty {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kPartProperty;
  Ref<Workpiece> its_workpiece;  ///< optional
};

struct SurfaceProperty : AssignedProperty {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kSurfaceProperty;
  Ref<Workpiece> its_workpiece;                                               ///< optional
  OneOfList<ManufacturingFeature, MachinedSurface, ShapeElement> applied_to;  ///< optional
};

struct MaterialProperty : AssignedProperty {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kMaterialProperty;
};

struct ProcessProperty : AssignedProperty {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kProcessProperty;
  Ref<DateAndTime> property_date;  ///< optional
};

}  // namespace capstan::model
