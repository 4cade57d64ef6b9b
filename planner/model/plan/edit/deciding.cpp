#include "planner/model/plan/edit/deciding.h"

#include <algorithm>
#include <utility>

namespace capstan::model {

const Edit* deciding(const std::vector<Edit>& edits, EditOf of, const StepNames& step) {
  /// How closely a pattern names the step; letters count where it has * or ?.
  const auto closeness = [&](const std::string& pattern) -> std::pair<int, std::size_t> {
    if (pattern == "*") return {0, 0};
    if (pattern == step.step || pattern == step.id) return {3, 0};
    if (pattern == step.feature) return {2, 0};
    const auto any =
        std::count_if(pattern.begin(), pattern.end(), [](char c) { return c == '*' || c == '?'; });
    return {1, pattern.size() - static_cast<std::size_t>(any)};
  };
  const Edit* out = nullptr;
  for (const Edit& e : edits) {
    const bool sets = e.kind == EditKind::kSet || e.kind == EditKind::kPin;
    if (!sets || e.of != of || !names(e.where, step)) continue;
    if (out == nullptr || closeness(e.where) >= closeness(out->where)) out = &e;
  }
  return out;
}

bool is_tool_limit(const Edit& e) {
  return e.kind == EditKind::kLimit &&
         (e.of == EditOf::kToolDiameter || e.of == EditOf::kToolStickOut || e.of == EditOf::kToolTeeth);
}

bool says_the_same(const Edit& a, const Edit& b) { return a.kind == b.kind && text_of(a) == text_of(b); }

}  // namespace capstan::model
