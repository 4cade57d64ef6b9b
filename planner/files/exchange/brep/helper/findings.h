#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/files/exchange/brep/message.h"

namespace capstan::exchange {

/// What is met while a shape is taken apart: each kind once, how often, and where first.
class Findings {
 public:
  /// `what` and `hint` live on. `instance` is `#id` of the file, 0 where there is none.
  void add(Severity severity, const char* code, const char* what, const char* hint, std::int64_t instance);
  /// A remark for each kind; an error takes the brep back.
  void tell(BrepMessage& message) const;

 private:
  struct Finding {
    Severity severity;
    const char* code;
    const char* what;
    const char* hint;
    std::int64_t instance;
    std::size_t count;
  };
  std::vector<Finding> found_;
};

/// A remark without a place.
[[nodiscard]] Diagnostic remark(Severity severity, const char* code, std::string text, const char* hint);

/// Adds remarks on sheets (BREP-SHEET) and on bodies that are placed many times (BREP-PLACED).
void tell_bodies(BrepMessage& message);

/// Refuses a solid whose triangles leave a gap (BREP-MESH), or hold another volume than its faces
/// (BREP-VOLUME): one of the two must be wrong then.
void judge_volumes(BrepMessage& message);

/// Whether each number of a shape is finite.
[[nodiscard]] bool finite(const Brep& brep);

}  // namespace capstan::exchange
