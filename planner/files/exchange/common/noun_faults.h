#pragma once

#include <array>
#include <functional>
#include <vector>

#include "planner/files/exchange/common/report.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

// Faults that a schema cannot find in a value alone, the same for every format: circles, endless workplans,
// B-splines, directions, sizes, empty sets; and which of them matter.

namespace capstan::exchange {

/// A fault that matters only where the project reaches the object: an error there, else a warning.
struct Doubt {
  model::AnyRef object;
  Diagnostic diagnostic;
  /// Name of the one attribute that the fault leaves unset; objects that need it are not planned
  /// (unreadable.h).
  std::string attribute = {};
};

/// Objects of a model, as a set.
class Marks {
 public:
  /// Needs   a model that does not grow while it is used.
  explicit Marks(const model::Model& m);
  [[nodiscard]] bool has(model::AnyRef a) const { return marks_[static_cast<std::size_t>(a.type)][a.index]; }
  void set(model::AnyRef a) { marks_[static_cast<std::size_t>(a.type)][a.index] = true; }
  /// Marks the root and everything it reaches; what is marked already is not walked again.
  void set_from(const model::Model& m, model::AnyRef root);

 private:
  std::array<std::vector<bool>, model::kTypeCount> marks_;
};

/// Every object that came from the file, in the file's order.
[[nodiscard]] std::vector<model::AnyRef> objects_in_file_order(
    const model::Model& m, const std::function<bool(model::TypeId)>& of_kind = {});

/// Circles of references, workplans that expand without end, B-splines that do not add up, directions
/// without length, sizes below zero, empty sets.
///
/// Codes   EXC-CYCLE, EXC-LIMIT, EXC-GEOMETRY, EXC-SIZE; warnings EXC-TOLERANCE, EXC-EMPTY.
void check_nouns(const model::Model& m, std::vector<Doubt>& doubts);

/// Reports the doubts in the order of instances: unchanged if `reached` has the object, else as warnings.
/// Unless `strict`, a doubt that leaves an attribute unset which only some features or workingsteps need is
/// an error, but the file is read: the plan's ledger records what is unknown.
void settle_doubts(model::Plan& plan, std::vector<Doubt>& doubts, const Marks& reached, bool strict,
                   Reporter& reporter);

}  // namespace capstan::exchange
