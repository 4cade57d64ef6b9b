#pragma once

#include <array>
#include <string_view>

#include "planner/model/plan/resources/machine.h"

namespace capstan::verify {

/// What the readers take where a machine's file states nothing, a row per control: a copy on purpose of
/// `kControlDefaults` (ground/vocabulary/control_options.h), of the options that a reader asks for, since a
/// wrong default must not pass both the writer and the check. tests/proof/verify/copies_test.cpp holds it
/// against that table.
struct ReaderDefaults {
  std::string_view control, options;  ///< "tap=m29 dwell=milliseconds"
};
inline constexpr std::array kReaderDefaults{
    ReaderDefaults{"fanuc",
                   "tap=m29 dwell=milliseconds extended_offsets=0 arcs=half largest_radius_mm=99999.999 "
                   "helices=yes prove_out=m1 line_length=200 peck_clearance_mm= codes="},
    ReaderDefaults{"haas",
                   "tap=g84 dwell=seconds extended_offsets=99 arcs=half largest_radius_mm=15404.000 "
                   "helices=yes prove_out=m1 line_length=200 peck_clearance_mm= codes="},
    ReaderDefaults{"siemens", "prove_out=m1 line_length=200"},
};

/// The default of that option for that control; "-": it is not in the table.
[[nodiscard]] std::string_view reader_default(std::string_view control, std::string_view name);

/// The machine's value of that option, else the default of its control; empty where nothing is stated.
/// Throws std::logic_error for a name that is not in the table: our own mistake.
[[nodiscard]] std::string_view option(const model::Machine& machine, std::string_view name);
/// The same as a number; 0 where there is none.
[[nodiscard]] double option_number(const model::Machine& machine, std::string_view name);

}  // namespace capstan::verify
