#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "planner/model/nouns/arena/attribute.h"

namespace capstan::model {

/// Open: somebody still has to choose. Bound: it has a value, and somebody who gave it.
enum class DecisionState : std::uint8_t { kOpen, kBound };

enum class Binder : std::uint8_t {
  kGiven,
  kRule,
  kToolSelection,
  kOptimiser,
  kCase,
  kOperator,
  kDefault,
  kRecognition,  ///< of features in the faces of a CAD part
};
[[nodiscard]] std::string_view to_text(Binder b);  ///< "given", "rule", "tool_selection", ...
[[nodiscard]] bool binder_from_text(std::string_view text, Binder& out);

/// Which decision: an attribute of an object of the model. `attribute` is a descriptor's name, or one of the
/// plan's own: "its_operation" with the feature as object (that a chain was chosen), "its_elements" with the
/// workplan (the order), "cutter" with the operation (which catalogue item).
struct DecisionKey {
  AnyRef object;
  std::string attribute;
  friend auto operator<=>(const DecisionKey&, const DecisionKey&) = default;
};

/// Why: the rule's id, the active constraint, the case, the default's name; and where that comes from.
struct Reason {
  std::string id;      ///< e.g. "hole.drill.it11", "limit.spindle_torque", "given"
  std::string text;    ///< one sentence for a person
  std::string source;  ///< standard, handbook, catalogue, file; "default, unsourced" said openly
  friend auto operator<=>(const Reason&, const Reason&) = default;
};
using ReasonId = std::uint32_t;

/// What else was considered, and why not.
struct Rejected {
  std::string what;
  std::string why;
  friend bool operator==(const Rejected&, const Rejected&) = default;
};

/// Everything about one decision except the value, which the object's attribute holds.
/// It exists per attribute, never per path point.
struct Decision {
  DecisionState state = DecisionState::kBound;
  Binder binder = Binder::kGiven;
  bool pinned = false;           ///< the operator holds it; nothing but the operator re-opens it
  ReasonId reason = 0;           ///< into Ledger::reasons(); 0 is "given in the file"
  std::string lexeme;            ///< the original spelling where it came from a file
  std::uint64_t value_hash = 0;  ///< of the value it speaks of: an edited value is *given* again
  std::vector<DecisionKey> depends_on;
  std::vector<Rejected> rejected;  ///< alternatives and their reasons
};

/// Who decided what, and why, for the whole plan. Attributes without an entry are given (or simply absent).
///
/// Order   entries iterate by key, so that output is the same whatever order they were made in.
class Ledger {
 public:
  Ledger();
  /// Interned: equal reasons share an id.
  ReasonId reason(Reason r);
  [[nodiscard]] const Reason& reason(ReasonId id) const { return reasons_.at(id); }
  [[nodiscard]] const std::vector<Reason>& reasons() const { return reasons_; }

  void set(DecisionKey key, Decision d);
  /// Shorthand: a bound decision with its reason.
  void bind(AnyRef object, std::string attribute, Binder binder, Reason why,
            std::vector<DecisionKey> depends_on = {}, std::vector<Rejected> rejected = {});
  /// Marks it open, and with it, transitively, every unpinned decision that depends on it.
  /// Gives all keys that were opened, in order; a pinned one is left as it is.
  std::vector<DecisionKey> reopen(const DecisionKey& key);
  [[nodiscard]] const Decision* find(AnyRef object, std::string_view attribute) const;
  [[nodiscard]] Decision* find(AnyRef object, std::string_view attribute);
  [[nodiscard]] bool is_open(AnyRef object, std::string_view attribute) const;
  [[nodiscard]] const std::map<DecisionKey, Decision>& entries() const { return entries_; }

 private:
  std::vector<Reason> reasons_;
  std::map<Reason, ReasonId> ids_;
  std::map<DecisionKey, Decision> entries_;
};

class Model;
/// A stable hash of one attribute's value (references by the hash of what they point to), for `value_hash`.
/// Gives 0 for an attribute that the object does not have.
[[nodiscard]] std::uint64_t hash_attribute(const Model& model, AnyRef object, std::string_view attribute);

}  // namespace capstan::model
