#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/model/plan/plan.h"
#include "planner/proof/verify/volumes/number_text.h"

namespace capstan::verify {

/// Gathers what is wrong and folds what repeats: of all findings of one step with one code the worst stays,
/// with the number of the others.
class Findings {
 public:
  /// `badness` ranks equal findings; larger is worse. `order` sorts steps; kWhole for the plan.
  struct Where {
    std::size_t order = 0;
    std::string step;
    long move = -1;
  };
  static constexpr std::size_t kWhole = 0;

  void error(int property, std::string code, Where where, std::string message, double badness = 0.0);
  void warn(int property, std::string code, Where where, std::string message, double badness = 0.0);
  void note(int property, std::string code, Where where, std::string message);
  /// What could not be judged (Finding::unproved): a note, or a warning where more than usual hangs on it.
  void unproved(Severity severity, int property, std::string code, Where where, std::string message);

  /// One call of the above, but for the step that it is about.
  struct Reported {
    Severity severity = Severity::kError;
    int property = 0;
    std::string code;
    long move = -1;
    std::string message;
    double badness = 0.0;
    bool unproved = false;
  };
  /// Says again what was said of a step, in the same order: the findings are as if it had been found anew.
  void repeat(const std::vector<Reported>& said, std::size_t order, const std::string& step);
  /// While this lives, what is said goes to the tape as well. A stop leaves by an exception.
  class Recording {
   public:
    Recording(Findings& findings, std::vector<Reported>& tape) : findings_(findings) {
      findings.tape_ = &tape;
    }
    ~Recording() { findings_.tape_ = nullptr; }
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

   private:
    Findings& findings_;
  };

  [[nodiscard]] std::vector<model::Finding> take();

 private:
  struct Item {
    std::size_t order;
    double badness;
    std::size_t count;
    model::Finding finding;
  };
  void add(Severity severity, int property, std::string code, Where where, std::string message,
           double badness, bool unproved = false);
  std::vector<Item> items_;
  std::vector<Reported>* tape_ = nullptr;
};

}  // namespace capstan::verify
