#include "planner/proof/verify/program/readers.h"

#include <array>

#include "planner/proof/verify/program/fanuc/reader.h"
#include "planner/proof/verify/program/grbl/reader.h"
#include "planner/proof/verify/program/heidenhain/reader.h"
#include "planner/proof/verify/program/linuxcnc/reader.h"
#include "planner/proof/verify/program/siemens/reader.h"
#include "planner/proof/verify/reader_options.h"

namespace capstan::verify {
namespace {

/// Its programs say all else that its reader must know.
Program read_linuxcnc(std::string_view text, const model::Machine& machine) {
  return linuxcnc::read_program(text, option(machine, "shop_codes"), option(machine, "through_coolant"));
}

// A new control is a folder beside linuxcnc/ and a row.
constexpr std::array kReaders{
    DialectReader{.dialect = "linuxcnc",
                  .name = "LinuxCNC",
                  .work_offsets = linuxcnc::kWorkOffsets,
                  .program = &read_linuxcnc,
                  .tool_table = &linuxcnc::read_tool_table,
                  .options = "shop_codes= through_coolant=",
                  .signs = linuxcnc::kSigns,
                  .shows_text = true},
    DialectReader{.dialect = "fanuc",
                  .name = "Fanuc",
                  .work_offsets = fanuc::kFanucOffsets,
                  .program = &fanuc::read_program,
                  .tool_table = nullptr,
                  .speed_decimals = 0,
                  .states_tolerance = false,
                  .options = fanuc::kFanucOptions,
                  .numbered_code = 541000,
                  .numbered_name = "G54.1P",
                  .signs = fanuc::kFanucSigns},
    DialectReader{.dialect = "haas",
                  .name = "Haas",
                  .work_offsets = fanuc::kHaasOffsets,
                  .program = &fanuc::read_program,
                  .tool_table = nullptr,
                  .speed_decimals = 0,
                  .options = fanuc::kHaasOptions,
                  .numbered_code = 1540000,
                  .numbered_name = "G154P",
                  .signs = fanuc::kHaasSigns},
    DialectReader{.dialect = "siemens",
                  .name = "Siemens 840D sl",
                  .work_offsets = siemens::kOffsets,
                  .program = &siemens::read_program,
                  .tool_table = nullptr,
                  .speed_decimals = 0,
                  .words = siemens::kWords,
                  .options = "prove_out=m1 line_length=200 shop_codes= through_coolant=",
                  .signs = siemens::kSigns,
                  .shows_text = true},
    DialectReader{.dialect = "heidenhain",
                  .name = "Heidenhain TNC 640",
                  .work_offsets = heidenhain::kOffsets,
                  .program = &heidenhain::read_program,
                  .tool_table = nullptr,
                  .speed_decimals = 0,
                  .words = heidenhain::kWords,
                  .options = "prove_out=m1 line_length=200 shop_codes= through_coolant= pecking_cycle=explicit",
                  .numbered_code = 2470000,
                  .numbered_name = "PRESET",
                  .signs = heidenhain::kSigns},
    DialectReader{.dialect = "grbl",
                  .name = "Grbl 1.1",
                  .work_offsets = grbl::kOffsets,
                  .program = &grbl::read_program,
                  .tool_table = nullptr,
                  .speed_decimals = 0,
                  .states_tolerance = false,
                  .words = grbl::kWords,
                  .options = "tool_change=m6 tool_length=touch_off mist=no"},
    DialectReader{.dialect = "mach3",
                  .name = "Mach3",
                  .work_offsets = linuxcnc::kMach3Offsets,
                  .program = &linuxcnc::read_mach3,
                  .tool_table = nullptr,
                  .speed_decimals = 0,
                  .states_tolerance = false,
                  .options = linuxcnc::kMach3Options,
                  .shows_text = true},
};

}  // namespace

std::span<const DialectReader> readers() { return kReaders; }

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
