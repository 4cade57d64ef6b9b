#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/decision/decision.h"

namespace capstan::model {

class Model;

/// The reason's id of a value that stays although what it was chosen together with was edited.
inline constexpr std::string_view kKept = "kept";

/// A value that somebody changed in a written plan since it was decided.
struct Edited {
  DecisionKey key;
  bool was_open = false;
  Binder was = Binder::kGiven;
  /// The decisions that depended on it and are open again; one that two edits open is listed with the first.
  std::vector<DecisionKey> opened;
};

/// Holds each value against the record of who decided it (`Decision::value_hash`; 0: the file knows none). A
/// value unlike its record is an edit: it is given, or the operator's where it was pinned; one that was taken
/// away is open. What planning chose from it is open again, unless that was edited, too, or is pinned. What
/// it was chosen together with stays, and its reason says so, since the limits that were named held with the
/// old value. Gives the edits in order. To be called once, when the whole file is read.
/// Cost  n log n in the decisions and what they depend on.
[[nodiscard]] std::vector<Edited> take_edits(const Model& model, Ledger& ledger);

/// "was edited since it was bound by optimiser; it counts as given, and 2 values chosen from it are open".
[[nodiscard]] std::string text_of(const Edited& e);

/// Of a written plan's parts, by name with the hash of each: those that are not as `then` any more, those
/// that are "(new)", those that are "(gone)".
template <class Seal>
[[nodiscard]] std::vector<std::string> edited_parts(const std::map<std::string, Seal>& now,
                                                    std::map<std::string, Seal> then) {
  std::vector<std::string> out;
  for (const auto& [name, seal] : now) {
    const auto it = then.find(name);
    if (it == then.end()) {
      out.push_back(name + " (new)");
      continue;
    }
    if (it->second != seal) out.push_back(name);
    then.erase(it);
  }
  for (const auto& [name, seal] : then) out.push_back(name + " (gone)");
  return out;
}
/// The warning about them, by the code of its reader.
[[nodiscard]] Diagnostic parts_edited(std::string code, const std::vector<std::string>& parts,
                                      std::string file = {});

/// The codes of the readers' messages about edits: Part 21, of a value that was decided or of a part of the
/// file (a warning); JSON, of a part; and of two places of a file that disagree about steps.
inline constexpr std::string_view kEditedCode = "EXC-EDITED", kEditedJsonCode = "JSON-EDITED",
                                  kDisagreesCode = "EXC-ORDER";
/// What a diagnostic tells of edits. This is the one place that knows.
enum class ReportedEdit {
  kNothing,
  kValue,     ///< decided before, and given now: what follows from it is computed again
  kPart,      ///< what was computed before does not follow from the file any more
  kDisagrees  ///< the file says it twice, and otherwise
};
[[nodiscard]] ReportedEdit reported_edit_of(const Diagnostic& d);
/// The warning that the list of steps is not as the workplan says (workplan_order.h).
[[nodiscard]] Diagnostic steps_disagree(const std::string& how, std::string file = {});

/// What `hex64` wrote; nothing for any other text.
[[nodiscard]] std::optional<std::uint64_t> hash_from_text(std::string_view text);

}  // namespace capstan::model
