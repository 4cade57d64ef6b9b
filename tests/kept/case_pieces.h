#pragma once

#include <string>

namespace capstan::kept {

/// Pieces of work of a case base of 100,000 cases, which `file` is: "cases-fill" makes it, "cases-open" opens
/// it, "cases-add" adds one case as `capstan cases add` does, "cases-question" opens it and asks a thousand
/// questions. "cases-look-up" asks the index alone ten thousand times, among as many points in clusters;
/// "cases-import" reads a table of 100,000 rows of times, joins it with its sheet and adds the cases to a
/// base beside `file`. False: there is no such piece. Throws std::runtime_error where the outcome is wrong.
[[nodiscard]] bool case_piece(const std::string& name, const std::string& file);

}  // namespace capstan::kept
