#pragma once

namespace capstan::model {

// What stays free around a cutter's head and neck inside of a narrow hole or the mouth of a slot, on each
// side: rules ask for such cutters, paths lead them. Defaults, unsourced.

inline constexpr double kHeadClearMm = 0.2;  ///< between the head and the narrow hole's wall
inline constexpr double kNeckClearMm = 0.1;  ///< between the neck and the wall while the head cuts beyond it

}  // namespace capstan::model
