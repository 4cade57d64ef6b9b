#pragma once

#include <string_view>

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::model {

/// Whether that name (Cutter::holder_id) is of a holder that nobody stated: the generic library's.
[[nodiscard]] inline bool generic_holder(std::string_view holder_id) {
  return holder_id.starts_with("generic/");
}

/// The name of a holder that somebody stated; empty: none is.
[[nodiscard]] inline std::string_view stated_holder(const Cutter& c) {
  return generic_holder(c.holder_id) ? std::string_view() : std::string_view(c.holder_id);
}

}  // namespace capstan::model
