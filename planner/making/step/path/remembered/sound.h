#pragma once

#include "planner/model/plan/range/columns_agree.h"
#include "planner/physics/engagement/engagement.h"

namespace capstan::step {

/// Whether what was kept can be a measurement at all: columns of one length, with an engagement each.
[[nodiscard]] inline bool sound(const engagement::Measurement& m) {
  return model::columns_agree(m.sections) && model::of_one_length(m.sections, m.engagement);
}

}  // namespace capstan::step
