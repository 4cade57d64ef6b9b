#pragma once

namespace capstan::mechanics {

/// Force that holds the piece against sliding, over the largest cutting force. Default, unsourced.
inline constexpr double kHoldingForceSafety = 2.0;

}  // namespace capstan::mechanics
