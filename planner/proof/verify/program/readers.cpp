#include "planner/proof/verify/program/readers.h"

#include <array>

#include "planner/proof/verify/program/fanuc/reader.h"
#include "planner/proof/verify/program/linuxcnc/reader.h"
#include "planner/proof/verify/program/siemens/reader.h"

namespace capstan::verify {
namespace {

/// Its programs say all that its reader must know.
Program read_linuxcnc(std::string_view text, const model::Machine& /*machine*/) {
  return linuxcnc::read_program(text);
}

// A new control is a folder beside linuxcnc/ and a row.
constexpr std::array kReaders{
    DialectReader{"linuxcnc", "LinuxCNC", linuxcnc::kWorkOffsets, &read_linuxcnc, &linuxcnc::read_tool_table},
    DialectReader{"fanuc", "Fanuc", fanuc::kFanucOffsets, &fanuc::read_program, nullptr, 0, false},
    DialectReader{"haas", "Haas", fanuc::kHaasOffsets, &fanuc::read_program, nullptr, 0, true},
    DialectReader{"siemens", "Siemens 840D sl", siemens::kOffsets, &siemens::read_program, nullptr, 0, true,
                  "G0 SUPA Z", " D0", "D1"},
};

}  // namespace

const DialectReader* reader_of(std::string_view dialect) {
  for (const DialectReader& reader : kReaders) {
    if (reader.dialect == dialect) return &reader;
  }
  return nullptr;
}

std::span<const std::string_view> work_offsets_of(std::string_view dialect) {
  const DialectReader* reader = reader_of(dialect);
  return reader != nullptr ? reader->work_offsets : kReaders.front().work_offsets;
}

}  // namespace capstan::verify
