#pragma once

#include <string>
#include <string_view>

namespace capstan::model {

// What the value that a workpiece_probing measures is for; its name says it: a size is corrected at the tool,
// a place at the work offset.
inline constexpr std::string_view kMeasuredSize = "measured_size_";
inline constexpr std::string_view kProbedPlace = "probed_";

}  // namespace capstan::model
