#pragma once

#include <string>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/ground/memo/memo.h"
#include "planner/ground/memo/packed.h"

// Keys of questions and values of results, of any struct.

namespace capstan::memo {

/// The key of a stage's whole question.
template <class... Parts>
[[nodiscard]] Key key_of(Stage stage, const Parts&... parts) {
  std::string bytes;
  (pack(bytes, parts), ...);
  return key_of_bytes(stage, bytes);
}

/// The result of a stage: from the memo, or made and kept. `memo` may be null. A fault is not kept. `sound`
/// says whether a value can be a result at all: bytes are read for their length only, and what is not sound
/// is neither taken nor kept. `found`: whether it came from the memo.
template <class T, class Make, class Sound>
[[nodiscard]] Result<T> remembered(Memo* memo, Stage stage, const Key& key, Make&& make, Sound&& sound,
                                   bool* found = nullptr) {
  if (found != nullptr) *found = false;
  if (memo == nullptr) return make();
  if (const auto bytes = memo->find(stage, key)) {
    if (auto value = unpacked<T>(*bytes); value && sound(*value)) {
      if (found != nullptr) *found = true;
      return *std::move(value);
    }
    memo->reject(stage);
  }
  Result<T> out = make();
  if (!out || !sound(*out)) return out;
  std::string bytes;
  bytes.reserve(packed_size(*out));
  pack(bytes, *out);
  poll();
  memo->keep(stage, key, std::move(bytes));
  return out;
}

}  // namespace capstan::memo
