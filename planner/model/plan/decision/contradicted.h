#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// The reason, in the ledger, of what a plan's file says in two ways, where nobody can tell which is meant:
/// no program is made of such a plan. It is of the file that was read, so it is not written.
inline constexpr std::string_view kContradicted = "given.contradicted";

struct Contradiction {
  DecisionKey key;
  std::string why;
};
[[nodiscard]] std::vector<Contradiction> contradictions(const Plan& plan);
void set_contradicted(Plan& plan, AnyRef object, std::string attribute, std::string why);
/// The caller names the material, or the raw piece: what the file says of it in two ways, or wrongly, decides
/// nothing.
void named_by_caller(Plan& plan, bool material, bool raw_piece);
[[nodiscard]] inline bool is_written(const Ledger& ledger, const Decision& d) {
  return ledger.reason(d.reason).id != kContradicted;
}

/// What a plan's file lists of what follows from its nouns: planning takes it from the nouns, or finds it
/// anew.
enum class Listed { kMaterial, kRawPiece, kCutters, kSetups, kSteps };
/// Who typed into one of these would be made what the nouns say: it is a contradiction. A raw piece that was
/// named to planning stands in no noun, so it counts as it is listed. `called`: what the file calls them.
void refuse_edited(Plan& plan, const std::set<Listed>& edited, std::string_view called);

}  // namespace capstan::model
