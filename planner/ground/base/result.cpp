#include "planner/ground/base/result.h"

namespace capstan {

const char* to_text(Severity s) {
  switch (s) {
    case Severity::kNote:
      return "note";
    case Severity::kWarning:
      return "warning";
    case Severity::kError:
      return "error";
  }
  return "error";
}

std::string to_text(const Diagnostic& d) {
  std::string out;
  if (!d.file.empty()) {
    out += d.file;
    if (d.line != 0) out += ":" + std::to_string(d.line);
    out += ": ";
  }
  out += to_text(d.severity);
  out += ": ";
  if (d.instance != 0) out += "#" + std::to_string(d.instance) + " ";
  if (!d.path.empty()) out += d.path + ": ";
  out += d.message;
  // A message may end with a question: "Did you mean 'fanuc'?"
  const auto join = [&out] { out += out.ends_with('?') ? " " : "; "; };
  if (!d.expected.empty()) join(), out += "expected " + d.expected;
  if (!d.hint.empty()) join(), out += d.hint;
  if (!d.code.empty()) out += " [" + d.code + "]";
  return out;
}

}  // namespace capstan
