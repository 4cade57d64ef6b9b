#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/decision/decision.h"
#include "planner/model/plan/proposal.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/model/plan/resources/material.h"

namespace capstan::tooling {

/// Where cutting starts from with a cutter in a material on a machine.
///
///     n = 1000 vc / (pi D)      vf = fz z n
///
/// From the cutter's preset for the material (by id, by name, by ISO 513 group), else the material's vc and
/// the cutter's least feed. Then n is held within the machine's and the tool's speeds and vf within the axes'
/// feeds, and vc and fz follow; fz is kept within the cutter's range where the feed limit allows. A tap keeps
/// its pitch per turn.
struct StartValues {
  double vc_m_min = 0.0;
  double fz_mm = 0.0;
  double spindle_rpm = 0.0;
  double feed_mm_min = 0.0;
  double wanted_vc_m_min = 0.0;  ///< before any limit
  model::Reason why;  ///< id "tooling.start.<material>"; the text names what was clamped, and to what
};
/// Needs  cutting diameter > 0, teeth > 0.
[[nodiscard]] StartValues start_values(const model::Cutter& c, const model::WorkMaterial& material,
                                       const model::Machine& machine);

/// Why a cutter is not for this material at all: no speed is known for its substrate (0 in the material's
/// table), and the tool states none. A touch probe cuts nothing.
[[nodiscard]] std::optional<std::string> not_cut_with(const model::Cutter& c, const StartValues& start,
                                                      const model::WorkMaterial& material);

/// Seconds that it takes to assemble, measure and load a tool that the magazine does not hold. Default,
/// unsourced.
inline constexpr double kLoadingS = 180.0;

/// Facts of the plan around a step, and its removal. Zero: unknown.
struct Preferences {
  std::vector<std::string>
      used;               ///< ids of cutters that the plan uses already, each once: no further tool change
  std::size_t most = 12;  ///< candidates given
  std::size_t most_rejected = 12;  ///< near misses given one by one; the others are summed up
  double volume_mm3 = 0.0;         ///< milling: what is to be removed
  double depth_mm = 0.0;           ///< along the axis, in all
  double width_mm = 0.0;           ///< across the feed, at most
  double face_mm = 0.0;            ///< open faces, with the width: length of a pass, without its ways in and out
  double passes_mm2 = 0.0;         ///< balls: the surface that parallel passes cover, as seen from above
  double ridges_mm = 0.0;          ///< with it: height of what stays between two passes
  double pre_hole_mm = 0.0;        ///< drilling, tapping: the hole that is there
  double bore_mm = 0.0;     ///< milling along a helix: diameter of the bore's wall, or a thread's major one
  double pitch_mm = 0.0;    ///< with it: of a thread
  double bending_mm = 0.0;  ///< with it: what the tip may bend; 0: as in roughing
  double open_below_mm = 0.0;  ///< with it: the hole that is there to below the bore; 0: its floor is solid
  double floor_mm2 = 0.0;      ///< finishing: the floor that the same step goes over, too
  bool roughs = false;         ///< milling: levels as deep as the cutter stays quiet
  bool walled = false;         ///< with it: between upright walls, where each level begins with a slot
  int places = 1;              ///< members of a pattern made with it
  int batch = 1;               ///< pieces that loading is shared by
};

/// Adds an id to those in use, once: a plan of thousands of steps uses some ten cutters.
inline void use(std::vector<std::string>& used, const std::string& id) {
  if (std::find(used.begin(), used.end(), id) == used.end()) used.push_back(id);
}

/// The cutters of the library that meet the requirement on that machine, best first.
///
/// Hard limits: class; diameter; corner radius; point angle; taper; width of the cutting head; pitch, size,
/// form and hand of threads; neck; reach (`reach_of`); flute length for the depth of cut and for walls in one
/// depth; cutting to centre or a ramp; coolant through; the spindle's slowest speed; its torque for the least
/// useful cut; the magazine's pockets, largest diameter, length and mass. Each cutter of a wanted class that
/// fails says which limit, with both numbers. A boring tool that can be set to the wanted diameter is given
/// set to it.
///
/// Rank: estimated seconds, least first:
///
///     cutting     milling V / (ap ae vf), ap cut back to what power, torque and bending of the tip allow
///     (force
///                 coefficients with their uncertainty and a worn edge), in roughing also to the depth at
///                 which a slender cutter stays quiet and to that of a slot, and the ways down by its ramp;
///                 of an open face whole passes, each longer by the cutter's diameter;
///                 drilling L / (f n), f cut back likewise
///     tool        minutes of cutting x price / life, as machine time; edges beyond the life left, sisters'
///     included readiness   a tool change when the plan does not use it yet; loading when the magazine is
///     known and lacks it
///
/// and, as defaults: 600 s for each class that the rules like less and for each mm from the exact diameter, 2
/// s for each diameter that it sticks out beyond three, 1 s between the smallest and the largest. Ties by id.
/// When nothing fits, `would_fit` says what would, and of cutters that would but for the machine, what of it
/// stands in the way.
[[nodiscard]] model::Selection select(const model::ToolRequirement& requirement,
                                      const std::vector<model::Cutter>& library,
                                      const model::WorkMaterial& material, const model::Machine& machine,
                                      const Preferences& preferences = {});

/// Gives every cutter a tool number: those that have one keep it (the first to claim it), the others take the
/// lowest free ones in order.
void assign_pockets(std::vector<model::Cutter>& cutters);

}  // namespace capstan::tooling
