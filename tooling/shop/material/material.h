#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/resources/material.h"

namespace capstan::tooling {

/// The material table that comes with the planner (tooling/data/materials.yaml), in file order.
/// Every number and every name has a source in WorkMaterial::sources ("kc11_n_mm2", "name ST-50", ...).
/// Measured sets that hold for some alloys only have them there, too ("set 0 for 6061"); find_material picks
/// by them.
[[nodiscard]] Result<std::vector<model::WorkMaterial>> shipped_materials();

/// As above from a text of the same form.
/// Fails  DATA-* (also a name of two materials, a citation that is not there), MATERIAL-RANGE for a value no
///        material has, MATERIAL-GROUP, MATERIAL-SUBSTRATE; each fault is reported to the job first.
[[nodiscard]] Result<std::vector<model::WorkMaterial>> read_materials(std::string_view text,
                                                                      const std::string& file, Job& job);

/// Before a name whose figures are to stand for a material that is not known.
inline constexpr std::string_view kLike = "like:";

/// Whether `--material` names a file rather than a material: it ends in .yaml, .yml or .json.
[[nodiscard]] bool names_a_material_file(std::string_view text);

/// A shop's own material: a file of the form of materials.yaml that holds one.
/// Fails  FILE-*, and as read_materials; MATERIAL-FILE when it holds several, or one with a shipped id.
[[nodiscard]] Result<model::WorkMaterial> load_material(const std::string& path,
                                                        const std::vector<model::WorkMaterial>& shipped,
                                                        Job& job);

/// Whether a family's word ("STEEL") may stand for a material.
enum class Families : bool { kTaken, kRefused };

struct ChosenMaterial {
  model::WorkMaterial material;
  std::string grade;         ///< the id of the card that the name alone means
  bool by_hardness = false;  ///< a hardness chose the card
};

/// The material that a file means by these texts, most telling first (standard_identifier before
/// material_identifier): an id or a name, letter case and punctuation aside; a name followed by a temper or
/// quality ("EN AW-6061-T6"); else a family's word ("STEEL"), which stands for its hardest card (warns
/// MATERIAL-FAMILY). When no text says anything, the shipped table's `unnamed` (warns MATERIAL-DEFAULT).
/// A hardness beside the name ("42CrMo4 50 HRC", "Rm 1100") picks the card that is as hard (hardness.h), a
/// state without a number ("case-hardened") is refused; of several texts, and of `properties`, the hardest
/// counts. A hardness in the texts that does not convert is said (warns MATERIAL-HARDNESS). With `kRefused`
/// "like:NAME" asks for the figures of NAME for a material that is not known.
/// WorkMaterial::sources then has "chosen": why it was taken; its measured sets are those of the alloy named.
/// Fails  NAME-UNKNOWN for a name that nobody knows: it is never guessed. MATERIAL-NONE when `materials` is
///        empty. MATERIAL-HARDNESS for one that is harder than its cards, MATERIAL-STATE for a state that is.
///        With `kRefused` it fails so for a family's word, too: whoever can choose a name must choose one.
///
/// properties   what the part says of its material beside the name: "tensile strength = 900 N/mm2"
[[nodiscard]] Result<ChosenMaterial> choose_material(const std::vector<std::string>& texts,
                                                     const std::vector<std::string>& properties,
                                                     const std::vector<model::WorkMaterial>& materials,
                                                     Job& job, Families families = Families::kTaken);
/// The same of a name alone.
[[nodiscard]] Result<model::WorkMaterial> find_material(const std::vector<std::string>& texts,
                                                        const std::vector<model::WorkMaterial>& materials,
                                                        Job& job, Families families = Families::kTaken);
[[nodiscard]] Result<model::WorkMaterial> find_material(const std::string& text,
                                                        const std::vector<model::WorkMaterial>& materials,
                                                        Job& job);

/// Where it has the value of a field from ("kc11_n_mm2", "name ST-50"), or null.
[[nodiscard]] const std::string* source_of(const model::WorkMaterial& m, std::string_view field);

/// Every id and name, in the table's order.
[[nodiscard]] std::vector<std::string> names_of(const std::vector<model::WorkMaterial>& materials);

}  // namespace capstan::tooling
