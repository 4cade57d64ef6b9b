#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "casebase/key/metric.h"
#include "casebase/record/case.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/features/shape.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/model/plan/resources/material.h"

/// Case base: finds earlier cuts near a question.
namespace capstan::casebase {

struct Neighbour {
  Case found;
  double distance = 0.0;  ///< by the scales of key/normalisation.h
  friend bool operator==(const Neighbour&, const Neighbour&) = default;
};

/// Beyond this distance there is no precedent. One size apart by a factor of 2^0.5, or the tolerance by a
/// factor of 2, all else equal. Default, unsourced.
inline constexpr double kPrecedentDistance = 0.5;

/// Cases in a store, with an exact nearest-neighbour index per combination of categories that is rebuilt from
/// the store, never loaded. Nothing that is stored is ever altered: a verdict or a removal is a new row.
///
/// Sees     the content of the store when it was opened, and what it added itself since, with what others
///          added before that.
/// Threads  the const members may be called from many threads; the others from one, without readers at the
/// same
///          time.
class CaseBase {
 public:
  /// Opens an existing store: a file of SQLite ("path", "sqlite:path"), or a database of PostgreSQL
  /// ("postgresql://user@host:port/database"). While a server cannot be reached a local copy of it is read,
  /// and what is added waits for it (CASE-OFFLINE, or CASE-LIBRARY where what reaches servers is missing
  /// here: a warning to `job`; store/server.h). Rows that were
  /// altered or are gone are reported to `job` (CASE-ROW) and left out; then `add` refuses (CASE-DAMAGED).
  /// When it is opened, the heads of all rows are verified; the rest of a case is when it is used: what is
  /// found then is reported by `take_faults`.
  ///
  /// Fails   CASE-URI no such store; CASE-LIBRARY what reaches servers is missing or of another build, and
  ///         there is no local copy; CASE-OPEN missing or unreadable; CASE-SCHEMA not a case base, or of a
  ///         newer version, or with a table, index, trigger or view that is not ours; CASE-BUSY;
  ///         CASE-DAMAGED it cannot be read.
  [[nodiscard]] static Result<CaseBase> open(const std::string& uri, Job& job);
  /// The same; makes an empty base where there is none.
  [[nodiscard]] static Result<CaseBase> open_or_create(const std::string& uri, Job& job);

  CaseBase(CaseBase&&) noexcept;
  CaseBase& operator=(CaseBase&&) noexcept;
  ~CaseBase();

  /// Retain. All cases are stored for good (synchronised to disk), or none. Cases that are stored already, or
  /// were and are removed, are skipped, so an `add` whose outcome is unknown may be repeated.
  ///
  /// Fails   CASE-INVALID a case that cannot be; CASE-READ-ONLY; CASE-BUSY another writer held the store for
  ///         5 s; CASE-DAMAGED; CASE-LIMIT too many; CASE-STORE no space, or another fault of the store;
  ///         CASE-OFFLINE the server went away, and whether it is stored is unknown: repeat it.
  [[nodiscard]] Status add(const Case& c);
  [[nodiscard]] Status add(std::span<const Case> cases);
  /// Gives cases a verdict that supersedes the one before. `ids` as `find` gives them. Fails as `add` does,
  /// and CASE-UNKNOWN for an id that is not there.
  [[nodiscard]] Status judge(std::span<const std::string> ids, Verdict verdict, const Remark& remark);
  /// The cases count no more, and adding them again changes nothing. Fails as `judge` does.
  [[nodiscard]] Status remove(std::span<const std::string> ids, const Remark& remark);

  /// What each number of a question counts (key/metric.h): what was learned last before the base
  /// was opened or by itself; the fixed scales, where nothing was.
  [[nodiscard]] const Metric& metric() const;
  /// Learns it from the cases that went well and stores it. Nothing else ever learns it. Fails as `add` does,
  /// and CASE-UNKNOWN where no case went well.
  [[nodiscard]] Result<Metric> learn_metric();

  /// The id that begins with these digits. Fails CASE-UNKNOWN: none, or several.
  [[nodiscard]] Result<std::string> find(std::string_view digits) const;
  /// The case of an id. Fails CASE-UNKNOWN, and CASE-ROW if it is not what was stored.
  [[nodiscard]] Result<Case> get(std::string_view id) const;
  /// What persons recorded of a case later, in order: its verdicts after the recorded one, and its removal
  /// (no verdict).
  struct LaterVerdict {
    std::optional<Verdict> verdict;
    std::string by, time_utc, reason;
  };
  [[nodiscard]] std::vector<LaterVerdict> later_verdicts(std::string_view id) const;

  /// The k nearest cases of the question's categories, nearest first, equal distances by id. Whatever
  /// their verdict and origin: the caller sees both. Fails CASE-INVALID on a question that cannot be.
  [[nodiscard]] Result<std::vector<Neighbour>> nearest(const Question& q, std::size_t k) const;
  /// A case near a question that is not what was stored, as its head has it.
  struct Lost {
    std::string id;
    double distance = 0.0;
    Origin origin = Origin::kEntered;
    Verdict verdict = Verdict::kUnknown;
  };
  /// The same with what `nearest` leaves out, both in that order; k of them together.
  struct Look {
    std::vector<Neighbour> found;
    std::vector<Lost> lost;
  };
  [[nodiscard]] Result<Look> look(const Question& q, std::size_t k) const;
  /// All cases of the question's categories within a distance, in the same order.
  [[nodiscard]] Result<std::vector<Neighbour>> within(const Question& q, double distance) const;

  /// How many cases there are, without those that are removed.
  [[nodiscard]] std::size_t size() const;
  /// How many of them there are of each combination of categories. None where all cases of one were removed.
  struct Categories {
    std::string operation, material_group, tool_class, machine_class;
    std::size_t cases = 0;
  };
  [[nodiscard]] std::vector<Categories> categories() const;
  /// Whether all rows are there that the store's totals speak of, with the heads that were stored, and the
  /// metric. While they are not, any of them may have spoken against what the others say: what went well
  /// then raises no value and lowers no force (recall/advice.h, tune/card.h); what failed still binds. Of
  /// bodies it says nothing: `look` and the count of `state_of_measured` do, for the cases that are asked
  /// for.
  [[nodiscard]] bool whole() const;
  /// All of them by id, read and verified now; one that is not what was stored is left out, and `take_faults`
  /// reports it.
  [[nodiscard]] std::vector<Case> cases() const;
  /// Those that were cut, measured or entered, with a tool of this class; else as `cases`.
  [[nodiscard]] std::vector<Case> cut_with(std::string_view tool_class) const;
  /// Measured cases of a material group on a machine class; an empty name: of any. At most `most`, those of
  /// the least ids, which are a sample that neither time nor order chose; else as `cases`.
  [[nodiscard]] std::vector<Case> measured_in(std::string_view material_group, std::string_view machine_class,
                                              std::size_t most) const;
  /// What `measured_in` would read, without reading it: how many cases, and a sum of 32 hexadecimal digits
  /// over what the heads say of them (ids, sums of their bodies, verdicts), whatever their order, and over
  /// the bytes of `with`. While it stays, they do, but for a body that was altered on disk: its head stays,
  /// and reading the case finds it (CASE-ROW).
  struct MeasuredState {
    std::size_t cases = 0;
    std::string sum;
  };
  [[nodiscard]] MeasuredState state_of_measured(std::string_view material_group,
                                                std::string_view machine_class, std::string_view with) const;
  /// What was found altered or gone since this was asked last, as warnings (CASE-ROW).
  [[nodiscard]] std::vector<Diagnostic> take_faults() const;

 private:
  friend class Intake;
  struct Impl;
  explicit CaseBase(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// What texts call the base of a URI: without a password, nor anything that may be a part of one.
[[nodiscard]] std::string name_of(const std::string& uri);

/// Substrate and class: speeds for one substrate say nothing about another.
[[nodiscard]] std::string tool_class_of(const model::Cutter& cutter);
/// ISO 513 letter and the material's id: within one letter speeds differ by more than a start value may.
[[nodiscard]] std::string material_group_of(const model::WorkMaterial& material);

/// The sizes of a question; zero if one does not apply.
struct Sizes {
  double diameter_mm = 0.0, depth_mm = 0.0, width_mm = 0.0, tolerance_mm = 0.0;
  double middle_over_mm = 0.0;  ///< middle of the tolerance less the nominal size
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

/// What a plan decided, as 32 hexadecimal digits: the same whether it was read from JSON, ISO 14649 or AP238.
[[nodiscard]] std::string plan_hash_of(const model::Plan& plan);

/// A planned step as a simulated case, verdict unknown; `from` names the plan's file, its hash and the step.
/// Without `asked` the sizes are those of the workingstep's feature; of a feature with parts of several sizes
/// (a compound, a counterbored hole), those of the part that the step cuts.
///
/// Fails   CASE-STEP when the step is no machining step with a cutter, when its feature has no shape, or its
///         numbers cannot be a case.
[[nodiscard]] Result<Case> case_of(const model::Plan& plan, const model::StepResult& step);
[[nodiscard]] Result<Case> case_of(const model::Plan& plan, const model::StepResult& step,
                                   const Sizes& asked);

/// The cases of all steps of a plan. A step that makes none is reported as a note (CASE-STEP).
[[nodiscard]] std::vector<Case> cases_of(const model::Plan& plan, Job& job);

/// Comma-separated values (RFC 4180), one case per row, the column names in the first; numbers read back to
/// the same bits.
[[nodiscard]] std::string to_csv(std::span<const Case> cases);
/// Reads what `to_csv` writes, columns in any order. An `id` column, where there is one, is checked.
///
/// Fails   CASE-CSV with file and line: a column missing or unknown, a field that is no number, a case that
///         cannot be, an id that does not fit. No row is taken then.
[[nodiscard]] Result<std::vector<Case>> from_csv(std::string_view text, const std::string& file);

}  // namespace capstan::casebase
