#pragma once

#include "planner/files/exchange/ap238/codecs/codecs.h"

namespace capstan::exchange::ap238 {

/// A list object of ISO 14649 around what AP238 puts in order without one.
extern const Codec kToolpathListCodec;
/// TOOLPATH_SPEED around a bounded curve of plain numbers.
extern const Codec kToolpathSpeedCodec;
/// A curve whose points are directions: no lengths, whatever the units.
extern const Codec kDirectionsCodec;
/// A curve whose points are the seven cross-section parameters.
extern const Codec kSectionsCodec;
/// Curves that are named after axes.
extern const Codec kAxisCommandsCodec;
extern const Codec kAxisNamesCodec;

}  // namespace capstan::exchange::ap238
