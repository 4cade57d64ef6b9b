#pragma once

#include "planner/files/exchange/ap238/codecs/codecs.h"

namespace capstan::exchange::ap238 {

// Tolerances (tolerance_codec.cpp)

/// The subject of a tolerance; several subjects form one COMPOSITE_GROUP_SHAPE_ASPECT.
extern const Codec kTolerancedCodecOfShape;
/// The workpiece behind a shape aspect or dimension; not written, since the statement belongs to it.
extern const Codec kWholePartCodec;
/// GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE; the older DATUM_REFERENCE lists are read as systems.
extern const Codec kToleranceDatumsCodec;
/// GEOMETRIC_TOLERANCE_WITH_MODIFIERS; MODIFIED_GEOMETRIC_TOLERANCE is read.
extern const Codec kToleranceModifiersCodec;
/// Numbers of the other forms that a tolerance may have besides its kind.
extern const Codec kToleranceMeasureCodec;
extern const Codec kToleranceAreaCodec;
extern const Codec kToleranceZoneCodec;
extern const Codec kProjectedLengthCodec;
/// Elements of a COMPOSITE_SHAPE_ASPECT.
extern const Codec kShapeElementsCodec;

// Datums (datum_codec.cpp)

/// The feature that establishes a datum; a manufacturing feature becomes a DATUM_FEATURE, too.
extern const Codec kEstablishedByCodec;
extern const Codec kDatumBaseCodec;
extern const Codec kCommonDatumCodec;
extern const Codec kDatumModifiersCodec;
extern const Codec kValuedModifierCodec;
/// The description of a target, unless it says which kind of target it is.
extern const Codec kTargetDescriptionCodec;

// Dimensions (dimension_codec.cpp)

/// An item of a dimension's representation, a length or an angle, and what qualifies it.
extern const Codec kDimensionValueCodec;
extern const Codec kDimensionQualifiersCodec;
extern const Codec kDimensionToleranceCodec;
extern const Codec kDimensionAngleLimitCodec;
/// DIRECTED_DIMENSIONAL_LOCATION, ANGULAR_SIZE, ANGULAR_LOCATION, …_WITH_PATH.
extern const Codec kDimensionKindCodec;
extern const Codec kMeasurementPathCodec;

// Surface texture and properties (property_codec.cpp)

extern const Codec kTextureValueCodec;
extern const Codec kTextureNameCodec;
extern const Codec kTextureSurfacesCodec;
/// The subject of a property: one aspect, or a group.
extern const Codec kPropertyOfCodec;
extern const Codec kPartPropertiesCodec;
extern const Codec kGeneralPropertyCodec;
/// The requirements of a workpiece, in the file's order.
extern const Codec kRequirementsCodec;

/// The codec of that name among these; null if there is none.
[[nodiscard]] const Codec* find_requirement_codec(std::string_view name);

// --- shared among them ---

/// The product definition of a shape aspect, a dimension or a shape; kNoNode if there is none.
[[nodiscard]] Node product_of(const Graph& g, Node n);
/// The shape of a workpiece: the instance that its own rows lead through.
[[nodiscard]] Id shape_of(Writer& writer, model::AnyRef workpiece);
/// Makes a new shape aspect part of the workpiece that the owner names in its_workpiece.
void in_shape(Writer& writer, Id aspect, model::AnyRef owner);
/// The owner's its_workpiece; unset if it has none.
[[nodiscard]] model::AnyRef workpiece_of(const model::Model& m, model::AnyRef owner);
/// Marks one instance as part of the owner's mapping.
void mark_one(Reader& reader, const Row& row, model::AnyRef owner, Node n, std::uint32_t ordinal);
/// The members of a group of shape aspects, or the aspect itself.
[[nodiscard]] std::vector<Node> members_of_group(Reader& reader, const Row& row, model::AnyRef owner, Node n);
/// One aspect for all items: the item itself, or a new group. kNoId for none.
[[nodiscard]] Id group_of(Writer& writer, model::AnyRef owner, const std::vector<model::AnyRef>& items);
[[nodiscard]] bool measures(Reader& reader, Node n, model::Unit unit);
[[nodiscard]] std::string enumerated(std::string_view word);  ///< ".WORD."

template <class T>
void assign_to(Reader& reader, model::AnyRef at, const model::Attribute& a, T value) {
  *static_cast<T*>(a.at(reader.plan().model.object(at))) = std::move(value);
}

}  // namespace capstan::exchange::ap238
