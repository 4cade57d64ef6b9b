#pragma once

/// From where on an observed figure says that a cut went badly.
namespace capstan::casebase {

/// Flank wear (VB, uniform, of end mills), mm. Source: ISO 8688-2:1989, 4.1, criterion of tool life.
inline constexpr double kWornMm = 0.3;
/// Of their range from 0 to 1. Defaults, unsourced.
inline constexpr double kHeavyChatter = 0.5, kBroken = 0.5;

}  // namespace capstan::casebase
