#pragma once

namespace capstan::optimise {

/// While it lives: whether a search of this thread ended, or did not begin, for its budget. Where none did,
/// the same work with a larger budget comes to the same. One inside another tells both.
///
/// Needs  all searches of the work on this thread; planning asks them so.
class SpentBudgetScope {
 public:
  SpentBudgetScope();
  ~SpentBudgetScope();
  SpentBudgetScope(const SpentBudgetScope&) = delete;
  SpentBudgetScope& operator=(const SpentBudgetScope&) = delete;
  [[nodiscard]] bool spent() const { return spent_; }

 private:
  friend void tell_budget_spent();
  SpentBudgetScope* around_;
  bool spent_ = false;
};

/// A search says that it ended for its budget; a backend, that a count of its own did that follows
/// Attempt::max_evaluations.
void tell_budget_spent();

}  // namespace capstan::optimise
