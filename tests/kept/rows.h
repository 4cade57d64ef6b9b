#pragma once

#include <string>
#include <vector>

#include "tests/kept/measure.h"

namespace capstan::kept {

/// The pieces of work that are kept fast. `capstan` is the command, `own` this program (it does the pieces
/// that are no command), `examples` the folder of shipped parts, `scratch` one that may be written. `smoke`
/// leaves out those that take seconds.
[[nodiscard]] std::vector<Row> rows(const std::string& capstan, const std::string& own,
                                    const std::string& examples, const std::string& scratch, bool smoke);

/// Does the piece of work of this name, as `own --piece NAME FILE` asks; `file` is the plan of the piece
/// "json", the base of those of cases (case_pieces.h). Throws std::runtime_error where there is no such piece
/// or what it makes is wrong.
void piece(const std::string& name, const std::string& file);

}  // namespace capstan::kept
