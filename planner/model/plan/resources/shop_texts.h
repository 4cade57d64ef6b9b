#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "planner/model/plan/plan.h"

// The shop's own texts for a plan's papers and programs. They stand in its provenance, a row each, so that
// every form of a plan keeps them.

namespace capstan::model {

inline constexpr std::string_view kSheetTitle = "sheet title";       ///< of the report and set-up sheet
inline constexpr std::string_view kProgramHeader = "program header";  ///< a line of comment behind the head
inline constexpr std::string_view kProgramFooter = "program footer";  ///< one before the end

/// Characters of a line of comment at most: no control breaks it. Default, unsourced.
inline constexpr std::size_t kLongestShopText = 60;

/// The plan's texts of that kind, in the order in which the shop gives them.
[[nodiscard]] std::vector<std::string> shop_texts(const Plan& plan, std::string_view what);
/// Whether a row of a plan's provenance is such a text.
[[nodiscard]] bool is_shop_text(const Provenance& row);

/// What is wrong with a text as a comment of a program; empty: nothing. It is plain ASCII without what ends a
/// comment somewhere, no mark that the check reads, and none that LinuxCNC acts on.
[[nodiscard]] std::string comment_fault(std::string_view text);

}  // namespace capstan::model
