#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "planner/files/p21/file.h"

namespace capstan::exchange {

/// Hashes of the content of some instances of a file; spacing and the spelling of numbers and texts do not
/// count. The names and texts of referring instances belong to an instance's content: the bodies of two taps
/// differ by the tools that have them.
[[nodiscard]] std::map<std::uint64_t, std::string> hashes_of(const p21::File& file,
                                                             const std::set<std::uint64_t>& numbers);

/// A parameter's content in one spelling; `spell` appends it.
[[nodiscard]] std::string spelled(const p21::Value& v);
void spell(const p21::Value& v, std::string& out);

}  // namespace capstan::exchange
