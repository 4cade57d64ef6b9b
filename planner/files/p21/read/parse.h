#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "planner/files/p21/file.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

namespace capstan::p21 {

/// What a file may cost before it is refused with P21-LIMIT. The values are defaults without a source:
/// far above any real file, far below what hurts.
struct Limits {
  std::size_t bytes = (std::size_t{2} << 30) - 1;    ///< at most 4 GiB - 2, a fact of the store
  std::size_t depth = 128;                           ///< lists and typed parameters in one another
  std::size_t string_bytes = std::size_t{16} << 20;  ///< at most 2^28 - 1
  std::size_t number_bytes = 1024;                   ///< digits of one number
  std::size_t instances = std::size_t{64} << 20;
  std::size_t list_elements = std::size_t{16} << 20;  ///< at most 2^28 - 1
  std::size_t reported_faults = 50;                   ///< errors, and likewise warnings; then "and N more"
  std::size_t faults = 1000;                          ///< errors after which reading stops
};

/// Reads an ISO 10303-21 exchange structure of edition 1, 2 or 3. No schema is consulted; spelling,
/// structure, number ranges and string escapes are verified, instance numbers are unique.
///
/// After a fault reading resumes behind the next ';', so that one call finds what it can.
///
/// Fails     one summary Diagnostic, after each fault went to `job` with file, line and instance:
///           P21-SYNTAX, P21-STRUCTURE (sections), P21-NUMBER, P21-STRING, P21-ID, P21-LIMIT,
///           P21-ENCODING, P21-UNSUPPORTED (edition 1 scopes, edition 3 value instances and constants).
/// Warns     the same codes: readable, yet not as the standard says.
/// Cost      linear in the bytes; memory about 2-3 times the bytes. Never recurses.
/// Source    ISO 10303-21:2016, clauses 5-14.
[[nodiscard]] Result<File> parse(std::string bytes, std::string file_name, const Limits& limits, Job& job);

/// Warns (P21-DANGLING) of each reference to an instance that the file neither holds nor binds in its
/// REFERENCE section; returns how many there are. Self-references and cycles are legal here.
std::size_t check_references(const File& file, Job& job, std::size_t reported = 50);

}  // namespace capstan::p21
