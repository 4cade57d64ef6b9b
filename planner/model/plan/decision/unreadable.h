#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// The reason, in the ledger, of an attribute that a file states wrongly: it refers to nothing, or to an
/// instance of a kind that the attribute does not take. The attribute is unset; the boss, boundary or depth
/// that the file meant is not known.
inline constexpr std::string_view kUnreadable = "given.unreadable";

struct Unreadable {
  DecisionKey key;
  std::string why;
};
/// Those of a plan that nobody has stated anew since.
[[nodiscard]] std::vector<Unreadable> unreadable(const Plan& plan);
/// Whether the attribute is of what every step rests on: the workpiece, its set-ups and which of them a
/// workplan is in. A plan can be read without it, and no program can be made of it.
[[nodiscard]] bool of_whole_plan(const DecisionKey& key);
/// Records one, as it is now.
void set_unreadable(Plan& plan, AnyRef object, std::string attribute, std::string why);

/// What may not be made while an attribute of an object is not known.
struct Touched {
  std::vector<AnyRef> features;  ///< that lead to the object; elements of such a compound, the base of such
                                 ///< a pattern
  std::vector<AnyRef> steps;     ///< workingsteps that lead to it otherwise than by their feature
};
/// Who leads to whom in a model, gathered once: as long as the model stays, and stays as it is.
class Leads {
 public:
  explicit Leads(const Model& m);
  ~Leads();
  /// Both empty: the object belongs to the whole plan, to nothing of it, or to a workplan.
  [[nodiscard]] Touched touched_by(AnyRef object) const;

 private:
  struct Referrers;
  const Model& m_;
  std::unique_ptr<const Referrers> all_;
};

}  // namespace capstan::model
