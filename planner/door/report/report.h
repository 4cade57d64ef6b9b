#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

/// A plan as one page of HTML that people look at: verdict, set-ups, paths in three dimensions with the stock
/// as it is then, operations, loads along the path, tools, decisions, program. It loads nothing from
/// anywhere.
namespace capstan::report {

/// A finding of the check, and the file it is about.
struct Line {
  std::string file;
  bool program = false;  ///< then Finding::move is a line of the program, else a move of its step
  model::Finding finding;
};

/// What the file that was planned is called among the inputs.
inline constexpr const char* kPart = "part";

enum class Judged : std::uint8_t { kSafe, kNotSafe, kNotChecked };

/// What is known of a plan beside the plan.
struct About {
  Judged judged = Judged::kNotChecked;
  std::string verdict;                                     ///< one sentence, as the command ends with it
  std::vector<std::string> condemned;                      ///< why the program must not be run
  std::vector<Line> findings;                              ///< of the check
  std::vector<Diagnostic> told;                            ///< errors and warnings of reading and planning
  std::vector<std::pair<std::string, std::string>> marks;  ///< name and hash of what was planned and written
  /// SHA-256 of files that the plan was made from: what the row of Plan::provenance calls it, or kPart.
  std::vector<std::pair<std::string, std::string>> hashes;
  std::string program_name, program;  ///< its text, with a marker per workingstep; may be empty
  std::string explained;              ///< the decisions of the whole plan, text
  std::vector<std::string>
      explained_steps;  ///< of each step, in the plan's order; empty: the report has none
};

/// The page. Every text of the plan stands in it as text: no name or message is read as HTML or script.
///
/// Frame   what is drawn is in the set-up's frame, mm.
/// Shape   a row of the operations per step of the plan; loads of a step at 1500 places at most, the largest
/// of each piece
///         of the path (loads_along.h).
/// Determinism  same plan, same bytes.
[[nodiscard]] std::string html(const model::Plan& plan, const About& about);

/// True if the page draws in three dimensions: three.js was there when this program was built.
[[nodiscard]] bool draws_in_three_dimensions();

}  // namespace capstan::report
