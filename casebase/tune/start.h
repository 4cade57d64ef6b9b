#pragma once

#include <optional>
#include <span>

#include "casebase/casebase.h"
#include "casebase/recall/evidence.h"
#include "casebase/tune/evidence.h"

namespace capstan::casebase::tune {

/// Speed and feed that repeats have proven, for planning to start from.
struct ProvenStart {
  double vc_m_min = 0.0, fz_mm = 0.0;
  Repeats repeats;
  double probability =
      0.0;  ///< that the next part exceeds a limit that is watched, chatters or breaks the tool
};

/// The fastest speed and feed that measured good cuts have proven at the values asked, at most `kCaseReach`
/// times those; nothing where no such cut was repeated often enough (TuneOptions), or what is proven is
/// slower than `than`.
///
/// `near` and `told` are the same cases in the same order, `told` at the terms of `asked`. A cut less deep or
/// less wide than what is asked, or of unknown depth or width, proves nothing; nor does one of an unnamed
/// tool. Repeats count by the tools (tool_instance) that they were made with, never by their days, so that no
/// clock decides; copies of one observation are one. The limits of the mechanics are not asked here: whoever
/// takes the values holds them against those.
[[nodiscard]] std::optional<ProvenStart> proven_start(std::span<const Neighbour> near,
                                                      std::span<const casebase::Evidence> told,
                                                      const Question& question, const Values& asked,
                                                      const Values& than);

}  // namespace capstan::casebase::tune
