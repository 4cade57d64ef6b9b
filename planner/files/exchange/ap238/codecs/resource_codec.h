#pragma once

#include "planner/files/exchange/ap238/codecs/codecs.h"

/// @file Values of tools, workpieces and product data that no measure, text or reference holds.

namespace capstan::exchange::ap238 {

/// `said`: a text; a text without letters counts as none (the standard makes many texts mandatory).
extern const Codec kSaidCodec;
/// `twice`: the file's number is twice the model's: full angles for half angles, diameters for radii.
extern const Codec kTwiceCodec;
/// `other_kind`: the word of a tool of no kind that the standard names.
extern const Codec kOtherKindCodec;
/// `texts`: a list of texts in one attribute.
extern const Codec kTextsCodec;
/// `measure`: the instance itself is the measure.
extern const Codec kMeasureCodec;
/// `typed`: a text inside a typed parameter: IDENTIFIER('x').
extern const Codec kTypedCodec;
/// `library`: the same, for a class that must have a source even if none is known.
extern const Codec kLibraryCodec;
/// `parameter_value`, `parameter_unit`: a number in any unit, as the file has it, and the unit's name.
extern const Codec kParameterValueCodec, kParameterUnitCodec;
/// `role`: the role of an assignment; its entity depends on what is assigned.
extern const Codec kRoleCodec;
/// `transformation`: a placement of one representation put on a placement of another.
extern const Codec kTransformationCodec;

}  // namespace capstan::exchange::ap238
