#include <string>
#include <utility>

#include "planner/files/p21/read/parser.h"

namespace capstan::p21::detail {

std::string name_of(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (byte >= 0x20 && byte < 0x7F) return std::string("'") + c + "'";
  return std::string("byte 0x") + "0123456789ABCDEF"[byte >> 4U] + "0123456789ABCDEF"[byte & 0xFU];
}

void Parser::report(Severity severity, std::uint32_t line, Fault f) {
  job_.report({.code = f.code,
               .severity = severity,
               .message = std::move(f.message),
               .file = store_.name,
               .line = line,
               .instance = id_,
               .expected = std::move(f.expected),
               .hint = std::move(f.hint)});
}

void Parser::fault(Fault f) { fault_at(at_.line, std::move(f)); }

void Parser::fault_at(std::uint32_t line, Fault f) {
  if (stop_) return;  // what follows from a fault that ended reading is not worth a line
  if (++errors_ == 1) first_error_ = {.code = f.code, .message = f.message, .line = line, .instance = id_};
  if (errors_ <= limits_.reported_faults) report(Severity::kError, line, std::move(f));
  if (errors_ >= limits_.faults) stop_ = true;
}

void Parser::warn(const char* code, std::string message, std::string hint) {
  if (++warnings_ > limits_.reported_faults) return;
  report(Severity::kWarning, at_.line,
         {.code = code, .message = std::move(message), .hint = std::move(hint)});
}

Status Parser::summary() {
  id_ = 0;
  const auto more = [this](Severity severity, std::size_t n, const char* what) {
    if (n <= limits_.reported_faults) return;
    report(severity, 0,
           {.code = "P21-MORE",
            .message = "and " + std::to_string(n - limits_.reported_faults) + " more " + what});
  };
  more(Severity::kWarning, warnings_, "warnings");
  more(Severity::kError, errors_, "errors");
  if (stopped_by_job_) {
    return fail(
        {.code = "P21-STOPPED", .message = "reading was stopped before its end", .file = store_.name});
  }
  if (errors_ == 0) return {};
  const std::string count = errors_ == 1 ? "1 fault" : std::to_string(errors_) + " faults";
  return fail(
      {.code = first_error_.code,
       .message = "the file cannot be read as Part 21: " + count +
                  (errors_ >= limits_.faults ? ", where reading stopped" : "") + "; the first: " +
                  (first_error_.instance != 0 ? "#" + std::to_string(first_error_.instance) + " " : "") +
                  first_error_.message,
       .file = store_.name,
       .line = first_error_.line,
       .hint = "correct the faults reported, or export the file anew"});
}

}  // namespace capstan::p21::detail
