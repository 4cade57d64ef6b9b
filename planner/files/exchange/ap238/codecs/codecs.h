#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "planner/files/exchange/ap238/read/reader.h"
#include "planner/files/exchange/ap238/write/writer.h"

namespace capstan::exchange::ap238 {

/// Code of a row with `| codec NAME` at the end of its path, for values that no measure, text or reference
/// can hold.
struct Codec {
  std::string_view name;
  /// Sets the attribute; false, after a report, if it could not. Marks the instances that it read beyond the
  /// path.
  bool (*read)(Reader& reader, const Row& row, model::AnyRef at, const model::Attribute& a,
               const std::vector<Terminal>& found);
  /// Makes what the path needs; `owner` has the rows, `data` is the object that has the attribute.
  void (*write)(Writer& writer, const Row& row, model::AnyRef owner, const model::Attribute& a,
                const void* data, Id root);
};

/// Null if there is none of that name.
[[nodiscard]] const Codec* find_codec(std::string_view name);

}  // namespace capstan::exchange::ap238
