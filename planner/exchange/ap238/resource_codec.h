#pragma once

#include "planner/exchange/ap238/codecs.h"

/// @file Values of tools, workpieces and product data that no measure, text or reference holds.

namespace capstan::exchange::ap238 {

/// `said`: a text; one without letters is as none (the standard makes many texts mandatory).
extern const Codec kSaidCodec;
/// `twice`: the file's number is twice the model's: full angles and half angles, diameters and radii.
extern const Codec kTwiceCodec;
/// `complement`: the file's angle and the model's make a right angle.
extern const Codec kComplementCodec;
/// `texts`: a list of texts in one attribute.
extern const Codec kTextsCodec;
/// `measure`: the instance itself is the measure.
extern const Codec kMeasureCodec;
/// `typed`: a text inside a typed parameter: IDENTIFIER('x').
extern const Codec kTypedCodec;
/// `parameter_value`, `parameter_unit`: a number in any unit, as the file has it, and the unit's name.
extern const Codec kParameterValueCodec, kParameterUnitCodec;
/// `role`: the role of an assignment; its entity depends on what is assigned.
extern const Codec kRoleCodec;
/// `transformation`: a placement of one representation put on a placement of another.
extern const Codec kTransformationCodec;

}  // namespace capstan::exchange::ap238
