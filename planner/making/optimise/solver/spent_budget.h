#pragma once

#include <cstdint>

namespace capstan::optimise {

/// While it lives: whether a search of this thread ended, or did not begin, for its budget. Where none did,
/// the same work with a larger budget comes to the same. One inside another tells both.
///
/// Thread safety  made, asked and ended by one thread. Planning searches on that thread; a search on a thread
/// without a scope may be a helper's of this work, and so is told to every scope that lives: `spent` is then
/// true too often, never too seldom.
class SpentBudgetScope {
 public:
  SpentBudgetScope();
  ~SpentBudgetScope();
  SpentBudgetScope(const SpentBudgetScope&) = delete;
  SpentBudgetScope& operator=(const SpentBudgetScope&) = delete;
  [[nodiscard]] bool spent() const;

 private:
  friend void tell_budget_spent();
  SpentBudgetScope* around_;
  std::uint64_t elsewhere_;  ///< how often it was told by threads without a scope, before this one
  bool spent_ = false;
};

/// A search says that it ended for its budget; a backend, that a count of its own did that follows
/// Attempt::max_evaluations.
void tell_budget_spent();

}  // namespace capstan::optimise
