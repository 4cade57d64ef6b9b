#include "planner/proof/verify/program/readers.h"

#include <array>

namespace capstan::verify {
namespace {

// A new control is a folder beside linuxcnc/ and a row.
constexpr std::array kReaders{
    DialectReader{"linuxcnc", &read_program, &read_tool_table},
};

}  // namespace

const DialectReader* reader_of(std::string_view dialect) {
  for (const DialectReader& reader : kReaders) {
    if (reader.dialect == dialect) return &reader;
  }
  return nullptr;
}

}  // namespace capstan::verify
