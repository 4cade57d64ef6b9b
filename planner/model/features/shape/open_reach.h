#pragma once

namespace capstan::model::shape {

/// How far beyond an open side the reach of a feature goes: room for a cutter to enter, mm. A step is cut as
/// wide as this. Default, unsourced.
inline constexpr double kOpenReach = 100.0;

}  // namespace capstan::model::shape
