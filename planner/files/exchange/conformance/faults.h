#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "planner/files/p21/file.h"
#include "planner/ground/base/job.h"

namespace capstan::exchange::conformance {

/// Code of values that the schema requires and the file leaves open; a warning, not counted as an error.
inline constexpr const char* kOpenCode = "SCH-OPEN";

/// A fault of an instance.
struct Fault {
  const char* code = "";
  std::string message;
  std::string path = {};  ///< attribute
  std::string expected = {};
};

/// Reports the first faults of each code, and counts all.
class Faults {
 public:
  Faults(const p21::File& file, Job& job) : file_(file), job_(job) {}
  void add(const p21::Instance& at, Fault f);
  void add(Fault f);  ///< of the file
  /// "and N more" per code; call once at the end. Returns the number of errors.
  std::size_t finish();
  /// Whether another fault of this code would be reported; if not, its text need not be made.
  [[nodiscard]] bool wanted(const char* code) const;
  void count(const char* code) { ++counts_[code]; }

 private:
  const p21::File& file_;
  Job& job_;
  std::map<std::string, std::size_t, std::less<>> counts_;
};

}  // namespace capstan::exchange::conformance
