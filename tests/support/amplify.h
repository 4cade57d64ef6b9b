#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace capstan::testing {

/// A large file made of a small real one: the data section of an ISO 14649 file, renumbered and repeated
/// until the text has about `bytes` bytes. PROJECT is kept once, and the main workplans of all copies
/// stand in the first one's list of elements, so that the whole hangs together. Works on text alone, so
/// that it says nothing about the reader that is measured with it.
///
/// Needs   one data section; comments and strings well formed.
[[nodiscard]] std::string amplify_part21(std::string_view file, std::size_t bytes);

}  // namespace capstan::testing
