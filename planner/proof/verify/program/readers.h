#pragma once

#include <string_view>

#include "planner/proof/verify/program/linuxcnc/reader.h"
#include "planner/proof/verify/program/linuxcnc/tool_table.h"

namespace capstan::verify {

/// Who reads the programs of a control back for the check: written from the control's manual, without the
/// writer's code.
struct DialectReader {
  std::string_view dialect;  ///< as model::Control has it
  Program (*program)(std::string_view text);
  ToolTable (*tool_table)(std::string_view text);
};

/// The reader for programs of that control; null when there is none.
[[nodiscard]] const DialectReader* reader_of(std::string_view dialect);

}  // namespace capstan::verify
