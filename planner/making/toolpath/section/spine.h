#pragma once

#include <optional>
#include <vector>

#include "planner/making/toolpath/path_job.h"
#include "planner/making/toolpath/region/area/track.h"
#include "planner/making/toolpath/region/area/work_area.h"

namespace capstan::toolpath {

/// The middle of a section in the set-up's frame, as the cutter's centre may run it: into the air at open
/// ends, short of flat closed ends, to the point itself at round ones. Of a hole: its centre.
struct Spine {
  std::vector<geometry::Vec2> line;
  bool closed = false;
  bool air_first = false, air_last = false;      ///< the cutter is clear of the material there
  bool round_first = false, round_last = false;  ///< the section is swept around the end
  [[nodiscard]] bool from_air() const { return air_first || air_last; }
};

/// Spine of a slot; the end in the air comes first if there is one. `half_width_mm` of its upper edge.
/// Fails  TPA-UNSUPPORTED  the slot has no course.
[[nodiscard]] Result<Spine> spine_of_slot(const PathJob& task, const WorkArea& w, double half_width_mm);
[[nodiscard]] Spine spine_of_hole(const PathJob& task);

/// Closed tracks at a distance from the spine, on both its sides and around its ends. The wall is on their
/// right if `walls_right`. At distance 0: the spine itself, an open track (none for a point).
[[nodiscard]] std::vector<Track> tracks_at(const Spine& s, double distance_mm, bool walls_right);
/// The area within this distance of the spine.
[[nodiscard]] geometry::Region within(const Spine& s, double distance_mm);

}  // namespace capstan::toolpath
