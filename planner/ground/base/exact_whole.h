#pragma once

namespace capstan {

/// 2^53: whole numbers up to it are exact as doubles; beyond, doubles are more than 1 apart (IEEE 754).
inline constexpr double kExactWhole = 9007199254740992.0;

}  // namespace capstan
