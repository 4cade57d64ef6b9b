#pragma once

#include <set>
#include <vector>

#include "planner/making/draft/draft.h"

namespace capstan::piece {

/// `before` must be cut before `after`.
struct RestsOn {
  model::AnyRef before, after;
};
/// By geometry, as the order of steps has it: what begins within or at the floor of a feature, a thread in
/// its hole, an edge, and what lies in a face; but a plain hole only needs its drill to be long enough to
/// start above the face. Both are features as workingsteps name them.
[[nodiscard]] std::vector<RestsOn> what_rests(const model::Model& m,
                                              const std::vector<draft::SetupDraft>& setups);
/// Those that rest on one of `roots`, directly or through others.
[[nodiscard]] std::set<model::AnyRef> resting_on(const std::vector<RestsOn>& all,
                                                 const std::set<model::AnyRef>& roots);

}  // namespace capstan::piece
