#pragma once

#include "planner/files/exchange/ap238/codecs/codecs.h"

namespace capstan::exchange::ap238 {

/// TOLERANCED_LENGTH_MEASURE: a length that is qualified by its limits or its significant digits, or a
/// dimension with a fit.
extern const Codec kTolerancedCodec;
/// NUMERIC_PARAMETER and DESCRIPTIVE_PARAMETER of ISO 14649: an item named by its role. A name or unit that
/// the role does not give goes along as the item's type_qualifier: 'PROFILE LENGTH [MM]'.
extern const Codec kParameterCodec;
extern const Codec kParameterTextCodec;

/// The workpiece by its shape, which all its features share.
extern const Codec kItsWorkpieceCodec;
/// Operations for a feature that belong to no workingstep of a plan.
extern const Codec kFeatureOperationsCodec;
/// Items of the part's shape that are the feature's.
extern const Codec kFacesInPartCodec;
/// The two ends of a slot, distinguished by name.
extern const Codec kSlotEndsCodec;
/// Elements drawn beside the curve of a profile or path.
extern const Codec kBesideCodec;
/// A polygon's diameter has its name by which of the two it is.
extern const Codec kAcrossFlatsCodec;
extern const Codec kNgonDiameterCodec;

}  // namespace capstan::exchange::ap238
