#include "planner/model/plan/resources/shop_texts.h"

#include <algorithm>
#include <array>

#include "planner/ground/base/text.h"

namespace capstan::model {
namespace {

/// What the check reads of a program's comments, or holds against the plan (planner/controls/gcode/header.h).
constexpr std::array<std::string_view, 11> kMarks = {"capstan",   "machine:",     "part:",        "file:",
                                                     "material:", "time:",        "stock:",       "set-up",
                                                     "condemned", "not measured", "rest material"};

/// Comments that LinuxCNC acts on. Source  LinuxCNC 2.9, interp_convert.cc (convert_comment), emccanon.cc
/// (COMMENT).
constexpr std::array<std::string_view, 13> kActive = {
    "msg",       "debug",      "print", "log",   "logopen",  "logappend", "logclose",
    "probeopen", "probeclose", "py",    "pyrun", "pyreload", "abort"};

/// The word at the head of a comment, in small letters, that LinuxCNC acts on; empty: none.
std::string active_word(const std::string& lower) {
  const std::size_t end = std::min(lower.find_first_not_of("abcdefghijklmnopqrstuvwxyz"), lower.size());
  const std::string word = lower.substr(0, end);
  if (std::find(kActive.begin(), kActive.end(), word) == kActive.end()) return {};
  // "log, ..." and "logclose", but not "Log of changes".
  const std::size_t next = std::min(lower.find_first_not_of(' ', end), lower.size());
  const bool acts = next == lower.size() || lower[next] == ',' || word == "probeopen";
  return acts ? word : std::string();
}

}  // namespace

std::vector<std::string> shop_texts(const Plan& plan, std::string_view what) {
  std::vector<std::string> out;
  for (const Provenance& p : plan.provenance) {
    if (p.what == what) out.push_back(p.value);
  }
  return out;
}

bool is_shop_text(const Provenance& row) {
  return row.what == kSheetTitle || row.what == kProgramHeader || row.what == kProgramFooter;
}

std::string comment_fault(std::string_view text) {
  if (text.empty() || text.find_first_not_of(' ') != 0) return "it is empty or begins with a blank";
  if (text.size() > kLongestShopText)
    return "it has " + std::to_string(text.size()) + " characters of at most " +
           std::to_string(kLongestShopText);
  const auto bad = std::find_if(text.begin(), text.end(), [](char c) {
    return c < ' ' || c > '~' || std::string_view("();%\"{}").find(c) != std::string_view::npos;
  });
  if (bad != text.end())
    return "a comment has plain ASCII without ( ) ; % \" { }, for not every control reads more";
  const std::string lower = lower_text(text);
  for (const std::string_view mark : kMarks) {
    if (lower.starts_with(mark)) return "'" + std::string(mark) + "' at its head is a mark of Capstan's own";
  }
  if (const std::string word = active_word(lower); !word.empty())
    return "LinuxCNC acts on a comment that begins with " + std::string(text.substr(0, word.size()));
  return {};
}

}  // namespace capstan::model
