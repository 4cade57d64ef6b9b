#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "planner/files/p21/file.h"

namespace capstan::exchange {

/// What some instances of a file say, as hashes; spacing and the spelling of numbers and texts do not count.
/// To what an instance says belong the names and texts of those that refer to it: the body of a tap is told
/// from that of another by the tool that has it.
[[nodiscard]] std::map<std::uint64_t, std::string> hashes_of(const p21::File& file,
                                                             const std::set<std::uint64_t>& numbers);

/// What a parameter says, spelled in one way.
[[nodiscard]] std::string spelled(const p21::Value& v);

}  // namespace capstan::exchange
