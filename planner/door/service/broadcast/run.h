#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planner/door/service/broadcast/broadcast.h"

namespace capstan::service {

/// The broadcasts of one run of a plan, which is bound further while it runs.
class BroadcastRun {
 public:
  /// Another plan was brought: the run begins anew. `bound`: it is the same, bound further.
  void plan_changed(bool bound);

  /// The lines that an event makes due (`over`: the run is). `make` gives the broadcasts of the plan at hand,
  /// or nothing while they cannot be had: then those from before count.
  /// Fails  as Broadcasts; BROADCAST-PLAN: no plan is there.
  [[nodiscard]] Result<std::vector<BroadcastLine>> tell(
      const ControlEvent& event, bool over, const std::function<std::optional<Broadcasts>()>& make);

 private:
  std::optional<Broadcasts> broadcasts_;
  bool fresh_ = false, stale_ = true;  ///< a new run; the plan is not that of broadcasts_
};

/// Takes what was measured into an event: a value by its name of AP238, as JSON. `location` says where the
/// tool is, too. Fails  BROADCAST-VALUE: the text is no JSON, or a location that is not [x, y, z] in mm.
[[nodiscard]] Status take_measured(const std::string& name, const std::string& json, ControlEvent& event);

}  // namespace capstan::service
