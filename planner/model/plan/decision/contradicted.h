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

/// The lists of a plan's file that follow from its nouns: planning takes them from the nouns, or computes
/// them anew.
enum class Listed { kMaterial, kRawPiece, kCutters, kSetups, kSteps };
/// Records a contradiction for each list that a user edited: planning would follow the nouns and not the
/// edit. No noun holds a raw piece that was named to planning, so the list of it counts. `called`: the file's
/// word for its lists.
void refuse_edited(Plan& plan, const std::set<Listed>& edited, std::string_view called);
/// Records that the path of a step was edited, which planning computes: it would drop the edit. `where`: the
/// file's word for where, and what is known of it. False where the step has no operation, or
/// its path is given: that is followed.
bool refuse_edited_path(Plan& plan, AnyRef step, const std::string& where);

}  // namespace capstan::model
