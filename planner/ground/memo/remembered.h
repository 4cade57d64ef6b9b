#pragma once

#include <string>
#include <utility>

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

/// The result of a stage: from the memo, or made and kept. `memo` may be null.
template <class T, class Make>
[[nodiscard]] T remembered(Memo* memo, Stage stage, const Key& key, Make&& make) {
  if (memo == nullptr) return make();
  if (const auto bytes = memo->find(stage, key)) {
    if (auto value = unpacked<T>(*bytes)) return *std::move(value);
    memo->reject(stage);
  }
  T out = make();
  std::string bytes;
  pack(bytes, out);
  memo->keep(stage, key, std::move(bytes));
  return out;
}

}  // namespace capstan::memo
