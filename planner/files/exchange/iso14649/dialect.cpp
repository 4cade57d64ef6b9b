#include "planner/files/exchange/iso14649/dialect.h"

#include <algorithm>
#include <array>
#include <utility>

#include "planner/model/nouns/forward.h"

namespace capstan::exchange {

using model::TypeId;

namespace {

struct Alias {
  std::string_view from, to;
};

// Keywords that changed between the 2001 draft and the published parts, and misspellings that a grammar of
// the published level carries.
constexpr std::array kAliases = {
    Alias{"TOOL_DIMENSION", "MILLING_TOOL_DIMENSION"},
    Alias{"BIDIRECTIONAL", "BIDIRECTIONAL_MILLING"},
    Alias{"UNIDIRECTIONAL", "UNIDIRECTIONAL_MILLING"},
    Alias{"EXPLICIT", "EXPLICIT_STRATEGY"},
    Alias{"THREADING_TOOL", "MILLING_THREADING_TOOL"},
    Alias{"MILLINGTHREADINGTOOL", "MILLING_THREADING_TOOL"},
    Alias{"NGON_PROFILE", "NGON_CLOSED_PROFILE"},
    Alias{"ELEMENTARY_SURFACE", "PLANE"},  // abstract since; draft files use it for nothing but planes
    Alias{"LIMITSANDFITS", "LIMITS_AND_FITS"},
    Alias{"RECTANGULAROMIT", "RECTANGULAR_OMIT"},
    Alias{"REPRESENTATIONCONTEXT", "REPRESENTATION_CONTEXT"},
    Alias{"COMPARISONEQUAL", "COMPARISON_EQUAL"},
    Alias{"COMBINED_DRILL_AND_TAPCOMPARISON_EQUAL", "COMBINED_DRILL_AND_TAP"},
    Alias{"WEEEK_OF_YEAR_AND_DAY_DATE", "WEEK_OF_YEAR_AND_DAY_DATE"},
    Alias{"WOORDRUFF_KEYSEAT_MILL", "WOODRUFF_KEYSEAT_MILL"},
};

struct Count {
  TypeId type;
  std::size_t count;
};
constexpr std::array kDraftCounts = {Count{TypeId::kCuttingComponent, 4}, Count{TypeId::kBoringTool, 6}};
constexpr std::array kDraftKinds = {TypeId::kEndmill, TypeId::kReamer};

}  // namespace

std::optional<Spelling> kind_of(std::string_view keyword) {
  const auto alias =
      std::find_if(kAliases.begin(), kAliases.end(), [&](const Alias& a) { return a.from == keyword; });
  const bool aliased = alias != kAliases.end();
  const auto type = model::find_noun(aliased ? alias->to : keyword);
  if (!type || *type == TypeId::kKeptInstance) return std::nullopt;
  const model::NounType& row = model::noun_type(*type);
  // Bodies of tools that AP238 adds are written by their own names: the standard's nearest kind is another
  // tool.
  const bool known = row.in_iso14649 || model::is_a(*type, TypeId::kMillingToolBody);
  if (row.abstract || !known) return std::nullopt;
  return Spelling{*type, aliased || is_draft_kind(*type)};
}

std::size_t parameter_count(TypeId type) {
  const auto attributes = model::noun_type(type).attributes;
  return static_cast<std::size_t>(
      std::count_if(attributes.begin(), attributes.end(), [](const auto& a) { return a.in_iso14649; }));
}

bool is_draft_count(TypeId type, std::size_t count) {
  return std::any_of(kDraftCounts.begin(), kDraftCounts.end(),
                     [&](const Count& c) { return c.type == type && c.count == count; });
}

bool is_draft_kind(TypeId type) {
  return std::find(kDraftKinds.begin(), kDraftKinds.end(), type) != kDraftKinds.end();
}

}  // namespace capstan::exchange
