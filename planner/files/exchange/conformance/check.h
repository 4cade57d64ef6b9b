#pragma once

#include <cstddef>
#include <string_view>

#include "planner/files/p21/file.h"
#include "planner/ground/base/job.h"

namespace capstan::exchange {

/// Largest number of faults of one code that are reported singly; SCH-MORE gives the number of the others.
/// Default, unsourced.
inline constexpr std::size_t kReportedFaultsPerCode = 50;

/// Whether the schema is one that check_schema knows: MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA (ISO
/// 10303-238 editions 3 and 4) or INTEGRATED_CNC_SCHEMA (1 and 2). In any case, with or without an object
/// identifier.
[[nodiscard]] bool is_ap238_schema(std::string_view file_schema);

/// Whether the header of a Part 21 file names such a schema; a look at its first megabyte, without parsing.
[[nodiscard]] bool declares_ap238(std::string_view bytes);

/// Compares every instance with the EXPRESS dictionary of ISO 10303-238 and the rules of its machining
/// entities. Each fault is one error (SCH-OPEN: one warning) to `job` with file, line, instance, attribute
/// and what was expected:
///
///   SCH-SCHEMA     the file's schema is another; nothing else is looked at
///   SCH-ENTITY     no such entity                    SCH-COUNT      number of parameters
///   SCH-MANDATORY  $ where a value is due            SCH-DERIVED    * and what is derived do not agree
///   SCH-TYPE       a value or instance of another kind, an integer where Part 21 wants a real
///   SCH-ENUM       no such enumerator                SCH-BOUNDS     number of elements, an element twice, a
///   number
///                                                                   outside its type's range
///   SCH-COMPLEX    parts missing, repeated, unsorted, or abstract ones alone
///   SCH-REFERENCE  no such instance (numbers of an edition 3 REFERENCE section are not followed)
///   SCH-RULE       a WHERE rule of a machining entity, see rules.table
///   SCH-OPEN       such a rule wants a value, a tool, a technology that the file leaves open: a warning,
///   since
///                  plans may be open; a complete plan has none
///   SCH-LIMIT      the file shares its instances so much that rules would take too long; the rest was not
///   checked
///
/// User-defined instances (!NAME) are passed over.
///
/// Returns  the number of errors, those not reported one by one included.
/// Cost     linear in the file (inverse references are sorted: n log n).
/// Source   ISO 10303-21:2016 clause 12; ISO 10303-238:2020.
std::size_t check_schema(const p21::File& file, Job& job);

}  // namespace capstan::exchange
