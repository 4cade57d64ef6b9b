#pragma once

#include <string_view>

namespace capstan::model {

/// Whether that name (Cutter::holder_id) is of a holder that nobody stated: the generic library's.
[[nodiscard]] inline bool generic_holder(std::string_view holder_id) {
  return holder_id.starts_with("generic/");
}

}  // namespace capstan::model
