#include "planner/door/service/edits/known_names.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/text.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/edit/cycles.h"
#include "planner/model/plan/edit/restrictions.h"

namespace capstan::service {
namespace {

using model::Edit;
using model::EditKind;
using model::EditOf;

std::vector<std::string> operation_words() {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < model::kTypeCount; ++i) {
    const auto type = static_cast<model::TypeId>(i);
    if (!model::is_a(type, model::TypeId::kMachiningOperation)) continue;
    if (!model::noun_type(type).keyword.empty()) out.push_back(lower_text(model::noun_type(type).keyword));
  }
  return out;
}

std::vector<std::string> strategy_words() {
  std::vector<std::string> out;
  for (int k = 1; k <= static_cast<int>(model::StrategyKind::kCenterMilling); ++k)
    out.emplace_back(model::word_of(static_cast<model::StrategyKind>(k)));
  out.emplace_back(model::kConstantEngagementWord);
  return out;
}

bool is_number(std::string_view value) {
  return value.size() > 1 && value.front() == 'T' &&
         std::all_of(value.begin() + 1, value.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// `exact`: the value is one of the words as they stand; else it may be a pattern of them, in any case.
Status known_word(const Edit& e, std::string_view what, const std::vector<std::string>& words,
                  bool exact = false) {
  const std::string value = lower_text(e.value);
  if (std::any_of(words.begin(), words.end(),
                  [&](const std::string& w) { return exact ? e.value == w : model::names(value, w); }))
    return {};
  Diagnostic d = unknown_name(what, e.value, words, "capstan plan --help");
  d.message = model::words_of(e) + ": " + d.message;
  for (const std::string& w : words) d.expected += (d.expected.empty() ? "" : ", ") + w;
  return fail(std::move(d));
}

Status known_tool(const Edit& e, const std::vector<model::Cutter>& library, const model::Plan& plan) {
  if (e.value.empty()) return {};
  std::vector<std::string> known;
  bool numbers = false;
  for (const auto* cutters : {&library, &plan.cutters}) {
    for (const model::Cutter& c : *cutters) {
      known.push_back(c.id);
      if (c.pocket <= 0) continue;
      numbers = true;
      known.push_back("T" + std::to_string(c.pocket));
    }
  }
  const auto means = [&](const std::string& k) {
    return k == e.value || (e.kind == EditKind::kForbid && model::names(e.value, k));
  };
  if (std::any_of(known.begin(), known.end(), means)) return {};
  if (is_number(e.value) && !numbers) {
    // The numbers of a plan are known when it is planned without what is set.
    if (e.kind != EditKind::kForbid) return {};
    return fail(
        {.code = "EDIT-NUMBER",
         .message = model::words_of(e) + ": the library gives its tools no numbers",
         .hint = "forbid the tool by its name (capstan tools list), or name a list with tool numbers"});
  }
  Diagnostic d = unknown_name("tool", e.value, known, "capstan tools list");
  d.message = model::words_of(e) + ": " + d.message;
  return fail(std::move(d));
}

}  // namespace

Status known_names(const std::vector<Edit>& edits, const std::vector<model::Cutter>& library,
                   const model::Plan& plan) {
  for (const Edit& e : edits) {
    if (e.kind == EditKind::kLimit || e.kind == EditKind::kOrder) continue;
    Status ok;
    if (e.of == EditOf::kTool) ok = known_tool(e, library, plan);
    if (e.of == EditOf::kOperation) ok = known_word(e, "kind of operation", operation_words());
    if (e.of == EditOf::kStrategy) ok = known_word(e, "strategy", strategy_words());
    if (e.of == EditOf::kCycles)
      ok = known_word(e, "cycles",
                      {std::string(model::kFeatureCycles), std::string(model::kPocketCycles),
                       std::string(model::kExplicitMoves)},
                      true);
    if (!ok) return ok;
  }
  return {};
}

std::vector<Edit> with_tool_names(std::vector<Edit> edits, const std::vector<model::Cutter>& library,
                                  const model::Plan& plan) {
  for (Edit& e : edits) {
    if (e.kind != EditKind::kForbid || e.of != EditOf::kTool || !is_number(e.value)) continue;
    const auto first = [&](const auto& means) -> const model::Cutter* {
      for (const auto* cutters : {&library, &plan.cutters}) {
        const auto at = std::find_if(cutters->begin(), cutters->end(), means);
        if (at != cutters->end()) return &*at;
      }
      return nullptr;
    };
    if (first([&](const model::Cutter& c) { return c.id == e.value; }) != nullptr) continue;
    const model::Cutter* of_number = first(
        [&](const model::Cutter& c) { return c.pocket > 0 && e.value == "T" + std::to_string(c.pocket); });
    if (of_number == nullptr) continue;
    e.from += (e.from.empty() ? "" : " ") + ("(" + e.value + ")");
    e.value = of_number->id;
  }
  return edits;
}

}  // namespace capstan::service
