#pragma once

#include <array>
#include <string_view>

#include "planner/model/plan/resources/machine.h"

namespace capstan::verify::fanuc {

/// What the reader takes where a machine's file states nothing: a copy on purpose of the defaults of
/// ground/vocabulary/control_options.h, for a wrong default must not pass both the writer and the check.
/// tests/proof/verify/copies_test.cpp holds it against that table.
struct OptionDefault {
  std::string_view name, of_fanuc, of_haas;
};
inline constexpr std::array kOptionDefaults{
    OptionDefault{"tap", "m29", "g84"},
    OptionDefault{"dwell", "milliseconds", "seconds"},
    OptionDefault{"extended_offsets", "0", "99"},
    OptionDefault{"arcs", "half", "half"},
    OptionDefault{"largest_radius_mm", "99999.999", "15404.000"},
    OptionDefault{"helices", "yes", "yes"},
    OptionDefault{"prove_out", "m1", "m1"},
    OptionDefault{"line_length", "200", "200"},
    OptionDefault{"peck_clearance_mm", "", ""},
    OptionDefault{"codes", "", ""},
};

/// The machine's value of that option, else the default of its control; empty where nothing is stated.
/// Throws std::logic_error for a name that is not in the table: our own mistake.
[[nodiscard]] std::string_view option(const model::Machine& machine, std::string_view name);
/// The same as a number; 0 where there is none.
[[nodiscard]] double option_number(const model::Machine& machine, std::string_view name);

}  // namespace capstan::verify::fanuc
