#pragma once

#include <string>
#include <vector>

#include "planner/model/cutter.h"
#include "planner/model/decision.h"
#include "planner/model/machine.h"
#include "planner/model/material.h"
#include "planner/model/proposal.h"

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

/// What a plan would rather have, all else being near equal.
struct Preferences {
  std::vector<std::string> used;   ///< ids of cutters that the plan uses already: no further tool change
  std::size_t most = 8;            ///< candidates given
  std::size_t most_rejected = 12;  ///< near misses given one by one; the others are summed up
};

/// The cutters of the library that meet the requirement on that machine, best first.
///
/// Hard limits: class; diameter; corner radius; point angle; pitch; reach (usable length); flute length;
/// cutting to centre or a ramp; the spindle's slowest speed; the magazine's largest diameter and length. Each
/// cutter of a wanted class that fails says which limit, with both numbers. A boring tool that can be set to
/// the wanted diameter is given set to it.
///
/// Rank: order of the wanted classes; nearness to the exact diameter, or else the larger cutter; loaded ones
/// before others, then those in use; stick-out over diameter; substrate and teeth for the material; speed the
/// spindle cannot reach. The weights are defaults, unsourced. Ties by id.
/// When nothing fits, `would_fit` says what would.
[[nodiscard]] model::Selection select(const model::ToolRequirement& requirement,
                                      const std::vector<model::Cutter>& library,
                                      const model::WorkMaterial& material, const model::Machine& machine,
                                      const Preferences& preferences = {});

/// "a 6 mm end mill with 22 mm reach, cutting to centre"
[[nodiscard]] std::string words_of(const model::ToolRequirement& requirement);

/// "end mill", "twist drill", ...
[[nodiscard]] std::string_view words_of(model::CutterClass c);

/// Gives every cutter a tool number: those that have one keep it (the first to claim it), the others take the
/// lowest free ones in order.
void assign_pockets(std::vector<model::Cutter>& cutters);

}  // namespace capstan::tooling
