#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/features/shape.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/model/plan/resources/material.h"

/// Case base: finds earlier cuts near a question.
namespace capstan::casebase {

/// The key of a search: four categories, which a case must share exactly, and sizes, which it must be near
/// to.
///
/// Units   mm. Zero: the size does not apply (a face has no diameter; no tolerance is stated). If one
///         question has a diameter, a depth or a width and the other has none, they never match; no tolerance
///         counts as one of 1 mm.
/// Shape   categories are keywords: 1 to 80 of letters, digits and `_ . / + -`.
struct Question {
  std::string operation;       ///< keyword of the operation, e.g. "DRILLING"
  std::string material_group;  ///< as `material_group_of` gives it, e.g. "P/mild_steel"
  std::string tool_class;      ///< as `tool_class_of` gives it, e.g. "carbide/endmill"
  std::string machine_class;   ///< the machine's id
  double diameter_mm = 0.0, depth_mm = 0.0, width_mm = 0.0;
  double tolerance_mm = 0.0;  ///< width of the tolerance zone
  bool operator==(const Question&) const = default;
};

/// One executed or simulated workingstep: its question, the bound values, the results, and the origin of the
/// numbers.
///
/// Units   as the names say; zero among the results: not known.
struct Case {
  std::string id;  ///< given by `id_of`; a value set before `add` is ignored
  Question asked;

  double cutting_diameter_mm = 0.0;
  int teeth = 0;
  double vc_m_min = 0.0, fz_mm = 0.0;
  double ap_mm = 0.0, ae_mm = 0.0;  ///< as cut; zero: not known
  bool coolant = false;

  double cycle_s = 0.0, peak_force_n = 0.0, surface_ra_um = 0.0, deviation_mm = 0.0, wear_mm = 0.0;
  std::string verdict = "unknown";  ///< "good", "bad", "unknown"
  std::string provenance;           ///< "measured", "simulated", "entered"
  std::string source;  ///< who, which file, which part: repeats of a run differ here, or count once
  bool operator==(const Case&) const = default;
};

/// 32 hexadecimal digits of the SHA-256 (FIPS 180-4) of everything but the id: equal cases, equal ids.
[[nodiscard]] std::string id_of(const Case& c);

/// Why a case cannot be one (a number that is not finite, beyond what any machine does, an unknown
/// provenance); nothing when it can. Asked before writing and again after reading.
[[nodiscard]] std::optional<std::string> fault_of(const Case& c);
[[nodiscard]] std::optional<std::string> fault_of(const Question& q);

struct Neighbour {
  Case found;
  double distance = 0.0;  ///< by the fixed scales of normalisation.h
  friend bool operator==(const Neighbour&, const Neighbour&) = default;
};

/// Beyond this distance there is no precedent. One size apart by a factor of 2^0.5, or the tolerance by a
/// factor of 2, all else equal. Default, unsourced.
inline constexpr double kPrecedentDistance = 0.5;

/// Cases in one SQLite file, with an exact nearest-neighbour index per combination of categories that is
/// rebuilt from the store, never loaded.
///
/// Sees     the content of the file when it was opened, and what it added itself since.
/// Threads  the const members may be called from many threads; `add` from one, without readers at the same
///          time.
class CaseBase {
 public:
  /// Opens an existing file: "path" or "sqlite:path". Rows whose hash or limits do not hold are reported
  /// to `job` (CASE-ROW) and left out; then `add` refuses (CASE-DAMAGED).
  ///
  /// Fails   CASE-URI other stores; CASE-OPEN missing or unreadable; CASE-SCHEMA not a case base, or of a
  ///         newer version, or with a table, index, trigger or view that is not ours; CASE-BUSY;
  ///         CASE-DAMAGED SQLite cannot read it; CASE-LIMIT more than a million cases.
  [[nodiscard]] static Result<CaseBase> open(const std::string& uri, Job& job);
  /// The same; makes an empty base where there is no file.
  [[nodiscard]] static Result<CaseBase> open_or_create(const std::string& uri, Job& job);

  CaseBase(CaseBase&&) noexcept;
  CaseBase& operator=(CaseBase&&) noexcept;
  ~CaseBase();

  /// Retain. All cases are stored and synchronised to disk, or none. Cases that are stored already are
  /// skipped, so an `add` whose outcome is unknown may be repeated.
  ///
  /// Fails   CASE-INVALID a case that cannot be; CASE-READ-ONLY; CASE-BUSY another writer held the file for
  ///         5 s; CASE-DAMAGED; CASE-STORE no space, or another fault of the store.
  [[nodiscard]] Status add(const Case& c);
  [[nodiscard]] Status add(std::span<const Case> cases);

  /// The k nearest cases of the question's categories, nearest first, equal distances by id. Whatever
  /// their verdict and provenance: the caller sees both. Fails CASE-INVALID on a question that cannot be.
  [[nodiscard]] Result<std::vector<Neighbour>> nearest(const Question& q, std::size_t k) const;

  [[nodiscard]] std::size_t size() const;
  /// All cases by id.
  [[nodiscard]] const std::vector<Case>& cases() const;

 private:
  struct Impl;
  explicit CaseBase(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Substrate and class: speeds for one substrate say nothing about another.
[[nodiscard]] std::string tool_class_of(const model::Cutter& cutter);
/// ISO 513 letter and the material's id: within one letter speeds differ by more than a start value may.
[[nodiscard]] std::string material_group_of(const model::WorkMaterial& material);

/// The sizes of a question; zero if one does not apply.
struct Sizes {
  double diameter_mm = 0.0, depth_mm = 0.0, width_mm = 0.0, tolerance_mm = 0.0;
  friend bool operator==(const Sizes&, const Sizes&) = default;
};
/// The sizes of a feature, the same when asking and when retaining.
[[nodiscard]] Sizes sizes_of(const model::FeatureShape& shape);

[[nodiscard]] Question question_of(std::string_view operation, std::string_view material_group,
                                   std::string_view tool_class, std::string_view machine_id,
                                   const Sizes& sizes);
[[nodiscard]] Question question_of(model::TypeId operation, const model::WorkMaterial& material,
                                   const model::Cutter& cutter, const model::Machine& machine,
                                   const Sizes& sizes);

/// A planned step as a simulated case, verdict "unknown"; `source` names the plan's file and the step.
/// Without `asked` the sizes are those of the workingstep's feature.
///
/// Fails   CASE-STEP when the step is no machining step with a cutter, when its feature has no shape or
///         several of different sizes (a compound: say which was asked), or its numbers cannot be a case.
[[nodiscard]] Result<Case> case_of(const model::Plan& plan, const model::StepResult& step);
[[nodiscard]] Result<Case> case_of(const model::Plan& plan, const model::StepResult& step,
                                   const Sizes& asked);

/// Comma-separated values (RFC 4180), one case per row, the column names in the first; numbers read back to
/// the same bits.
[[nodiscard]] std::string to_csv(std::span<const Case> cases);
/// Reads what `to_csv` writes, columns in any order. An `id` column, where there is one, is checked.
///
/// Fails   CASE-CSV with file and line: a column missing or unknown, a field that is no number, a case that
///         cannot be, an id that does not fit. No row is taken then.
[[nodiscard]] Result<std::vector<Case>> from_csv(std::string_view text, const std::string& file);

}  // namespace capstan::casebase
