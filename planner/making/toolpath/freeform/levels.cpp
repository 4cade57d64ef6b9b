#include "planner/making/toolpath/freeform/levels.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace capstan::toolpath::freeform {

Levels levels_of(const FreeformJob& task, double lowest_mm, double margin_mm) {
  Levels made;
  std::vector<double>& out = made.z_mm;
  const double most = task.axial_depth_mm;
  if (task.floors_z_mm.empty()) {
    const int n = std::max(1, static_cast<int>(std::ceil((task.top_z_mm - lowest_mm) / most - 1e-9)));
    for (int k = 1; k < n; ++k) out.push_back(task.top_z_mm - k * most);
    out.push_back(lowest_mm);
    return made;
  }
  constexpr double kAbove = 1e-6;  // mm: a level just at a floor is not below it
  std::vector<double> stops = {lowest_mm};
  for (const double floor : task.floors_z_mm) {
    const double z = floor + task.allowance_mm + margin_mm + kAbove;
    if (z < lowest_mm + kAbove || z > task.top_z_mm - kNothing) continue;
    stops.push_back(z);
    made.floors_mm.push_back(z);
    // Walls first, down to what is left on the floor.
    if (task.left_mm && z + *task.left_mm < task.top_z_mm) stops.push_back(z + *task.left_mm);
  }
  std::sort(stops.begin(), stops.end(), std::greater<>());
  double from = task.top_z_mm;
  for (const double to : stops) {
    if (from - to < kNothing) continue;
    const int n = std::max(1, static_cast<int>(std::ceil((from - to) / most - 1e-9)));
    for (int k = 1; k < n; ++k) out.push_back(from - (from - to) * k / n);
    out.push_back(to);
    from = to;
  }
  return made;
}

}  // namespace capstan::toolpath::freeform
