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

/// The result of a stage: from the memo, or made and, where `whole` says so, kept. `memo` may be null. A result that
/// depends on more than its question, such as that of a stage that was stopped, is not whole.
template <class T, class Make, class Whole>
[[nodiscard]] T remembered(Memo* memo, Stage stage, const Key& key, Make&& make, Whole&& whole) {
  if (memo == nullptr) return make();
  if (const auto bytes = memo->find(stage, key)) {
    if (auto value = unpacked<T>(*bytes)) return *std::move(value);
    memo->reject(stage);
  }
  T out = make();
  if (!whole()) return out;
  std::string bytes;
  pack(bytes, out);
  memo->keep(stage, key, std::move(bytes));
  return out;
}

template <class T, class Make>
[[nodiscard]] T remembered(Memo* memo, Stage stage, const Key& key, Make&& make) {
  return remembered<T>(memo, stage, key, std::forward<Make>(make), [] { return true; });
}

}  // namespace capstan::memo
