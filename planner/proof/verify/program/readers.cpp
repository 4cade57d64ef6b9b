#include "planner/proof/verify/program/readers.h"

#include <array>

#include "planner/proof/verify/program/linuxcnc/reader.h"

namespace capstan::verify {
namespace {

// A new control is a folder beside linuxcnc/ and a row.
constexpr std::array kReaders{
    DialectReader{"linuxcnc", "LinuxCNC", linuxcnc::kWorkOffsets, &linuxcnc::read_program,
                  &linuxcnc::read_tool_table},
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
