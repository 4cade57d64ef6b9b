#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "casebase/key/metric.h"
#include "casebase/record/case.h"
#include "casebase/store/id_table.h"
#include "casebase/store/row.h"
#include "casebase/store/store.h"

namespace capstan::casebase {

/// A case as the base knows it before it is used.
struct Entry {
  Id id;
  std::int64_t number = 0;  ///< of its row
  Sum body;
  std::uint32_t categories = 0;  ///< `Log::category`
  Origin origin = Origin::kEntered;
  Verdict verdict = Verdict::kUnknown;  ///< the last one
  bool removed = false;
  Key key;
};

/// What was said of a case after it was stored: a judgement or a removal.
struct Note {
  RowKind kind = RowKind::kJudgement;
  std::uint32_t entry = 0;
  Verdict verdict = Verdict::kUnknown;
  std::int64_t number = 0;
  Sum body;
};

/// The rows of a store, and what they mean.
///
/// When a log is opened every head is read and its checksum, place and order are held against the totals. A
/// body is read when the case is used; then its bytes are held against the checksum in the head, its id and
/// limits are computed again, and the head is made of it again. So no altered number is ever given; a body
/// that was altered is noticed when it is used, or by `verify`. A case that stands in two rows, as it may
/// where a store's index of ids was damaged, counts once, as the first says.
///
/// Threads   the const members may be called from many threads; the others from one, without readers at that
/// time.
class Log {
 public:
  /// Rows that are altered or gone are reported (CASE-ROW) and left out; then `append` refuses
  /// (CASE-DAMAGED).
  [[nodiscard]] static Result<Log> open(std::unique_ptr<Store> store, Job& job);

  /// By the number of their rows. An entry stays at its place.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  /// The number of these categories (`categories_of`); nothing: no case has them.
  [[nodiscard]] std::optional<std::uint32_t> category(std::string_view categories) const;
  /// The categories of an entry.
  [[nodiscard]] const std::string& categories(const Entry& e) const { return categories_[e.categories]; }
  [[nodiscard]] const std::vector<Note>& notes() const { return notes_; }
  [[nodiscard]] std::size_t live() const { return entries_.size() - removed_; }
  [[nodiscard]] std::string name() const { return store_->name(); }
  [[nodiscard]] std::optional<std::uint32_t> find(const Id& id) const;
  /// Whether all rows that the totals speak of are there, with the heads and the metric that were stored.
  [[nodiscard]] bool whole() const;
  /// The metric that was stored last. The fixed scales where there is none, or where it is not what was
  /// stored, which is kept for `take_faults`. Fails as reading the store does, which says nothing of the row:
  /// by other scales the nearest cases may be others.
  [[nodiscard]] Result<Metric> metric() const;

  /// Appends those cases that are not there. Needs cases without fault, with their ids set. Rows that others
  /// appended since are taken in, too.
  [[nodiscard]] Status add(std::span<const Case> cases);
  /// Appends a judgement or a removal of these entries.
  [[nodiscard]] Status note(RowKind kind, std::span<const std::uint32_t> entries, Verdict verdict,
                            const Remark& remark);

  [[nodiscard]] Status add_metric(const Metric& metric);
  /// Appends, in one transaction, those rows of another log that say something new: a case that is not there,
  /// a judgement or a removal that nobody noted with the same words, a metric other than the last. Gives
  /// their number. Needs rows whose bodies fit their heads.
  [[nodiscard]] Result<std::size_t> adopt(std::span<const NewRow> rows);

  /// The cases of these entries, verified, with their last verdict; nothing in the place of one that is not
  /// what was stored. What was wrong is kept for `take_faults`.
  [[nodiscard]] std::vector<std::optional<Case>> load(std::span<const std::uint32_t> entries) const;
  /// The remark of a note; nothing when it is not what was stored. Fails as reading the store does.
  [[nodiscard]] Result<std::optional<Remark>> remark(const Note& note) const;
  /// What `load` found altered or gone since this was asked last, each row once, and why it could not read,
  /// once.
  [[nodiscard]] std::vector<Diagnostic> take_faults() const;

 private:
  struct Shared {
    std::mutex mutex;  // of the store, and of what follows
    std::vector<Diagnostic> faults;
    std::set<std::uint32_t> told;  // entries that `faults` speaks of
    bool damaged = false;          // a row, or its body
    bool lost_metric = false;
  };
  explicit Log(std::unique_ptr<Store> store)
      : store_(std::move(store)), shared_(std::make_unique<Shared>()) {}

  Status take(std::int64_t number, std::string_view head, Job* job);
  std::optional<std::string> take_in(std::int64_t number, const Head& head);
  Status append(const std::function<Status(Store::Appended&)>& make);
  void put(Store::Appended& to, Head head, std::string body) const;
  [[nodiscard]] Status room_for(const Store::Appended& more) const;
  [[nodiscard]] std::int64_t live_with(const Store::Appended& more) const;
  std::optional<Case> verified(const Entry& entry, std::string_view body, std::string& why) const;

  std::unique_ptr<Store> store_;
  std::vector<Entry> entries_;
  std::vector<std::string> categories_;
  struct HashText {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
  };
  std::unordered_map<std::string, std::uint32_t, HashText, std::equal_to<>> category_numbers_;
  std::vector<Note> notes_;
  std::optional<std::pair<std::int64_t, Sum>> metric_;  // its row and body
  std::size_t removed_ = 0, refused_ = 0;
  std::int64_t taken_ = 0;      // rows
  bool heads_damaged_ = false;  // or gone
  Totals totals_;
  IdTable by_id_;  // the entries
  std::unique_ptr<Shared> shared_;
};

/// The cases with their ids. Fails CASE-INVALID: one cannot be.
[[nodiscard]] Result<std::vector<Case>> with_ids(std::span<const Case> cases);
/// A case as the row of this number. Needs one without fault, with its id set.
[[nodiscard]] NewRow row_of_case(const Case& c, std::int64_t number);

/// Cases that a base holds at most. Default, unsourced: some 300 bytes of memory each.
inline constexpr std::size_t kMaxCases = 4'000'000;

}  // namespace capstan::casebase
