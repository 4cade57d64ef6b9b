#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

namespace capstan::casebase {

/// Whether a case base that is not there is made.
enum class Missing : std::uint8_t { kRefuse, kCreate };

/// A row to be stored: a head, which is read when the base is opened, and a body, which is read when the row
/// is used.
struct NewRow {
  std::int64_t number = 0;
  std::string head, body;
};

/// A place that keeps the rows of a case base: a file, a server. It moves bytes and knows no case; what they
/// mean, and whether they were altered, is the log's business (log.h). Rows are numbered from 1 without a
/// gap, are only appended, and never change. Beside them there is one short text, the totals.
///
/// Every implementation passes the contract's tests (tests/casebase/store).
///
/// Threads   one call at a time; the log sees to that.
/// Fails     CASE-BUSY another writer held the store for too long; CASE-DAMAGED the store cannot be read;
///           CASE-SCHEMA it is not a case base, or was altered to be none; CASE-READ-ONLY; CASE-STORE no
///           space, any other fault of the store; CASE-OFFLINE a server that went away.
class Store {
 public:
  using TakeHead = std::function<Status(std::int64_t number, std::string_view head)>;
  using TakeBody = std::function<void(std::size_t i, std::string_view body)>;
  /// What is to be appended, and the totals then; nothing to append: the transaction ends without a change.
  struct Appended {
    std::vector<NewRow> rows;
    std::string totals;
  };
  using Decide = std::function<Result<Appended>(const std::string& totals)>;

  Store() = default;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;
  virtual ~Store() = default;

  /// What diagnostics call it: the path of a file, a URI without its password.
  [[nodiscard]] virtual std::string name() const = 0;
  /// Gives the rows behind `after` by rising number, as one state of the store, and then its totals. Ends at
  /// the first fault of `take`.
  [[nodiscard]] virtual Result<std::string> read(std::int64_t after, const TakeHead& take) = 0;
  /// Gives the bodies of these rows, `i` counting `numbers`, in any order. A row that is not there is not
  /// given.
  [[nodiscard]] virtual Status bodies(std::span<const std::int64_t> numbers, const TakeBody& take) = 0;
  /// In one transaction, with no other writer between: gives the rows behind `after`, asks what to append,
  /// and appends it. When it returns well, all of it is stored for good; when it fails, nothing is, but where
  /// the connection was lost, or the disk failed in the commit itself, the outcome is unknown, and the same
  /// call may be made again.
  [[nodiscard]] virtual Status append(std::int64_t after, const TakeHead& take, const Decide& decide) = 0;
  /// Whether the store has an index of the cases by id, so that it could do as `append` does without giving
  /// the rows behind any: it gave those that these ids (`id_bytes_of`) have and the last one, in any order,
  /// and a row that the index speaks of and that is gone with an empty head. False: it has none, and nothing
  /// was asked or appended.
  [[nodiscard]] virtual Result<bool> append_found(std::span<const std::string> /*ids*/,
                                                  const TakeHead& /*take*/, const Decide& /*decide*/) {
    return false;
  }
  /// What happened since this was asked last that is no fault of a call: a copy that is not up to date, a
  /// server that went away.
  [[nodiscard]] virtual std::vector<Diagnostic> take_told() { return {}; }
};

/// Opens the store that a URI names: "path", "sqlite:path", or what open.cpp has a row for.
/// Fails CASE-URI when it names none, CASE-LIBRARY when what reaches servers is missing, CASE-OPEN when it is
/// missing or cannot be opened.
[[nodiscard]] Result<std::unique_ptr<Store>> open_store(const std::string& uri, Missing missing, Job& job);

/// One file of SQLite. Reads files of versions 1 and 2, too, and turns one into version 3 when it first adds
/// to it.
/// `busy_ms`: how long it waits for another writer.
inline constexpr int kBusyMs = 5000;
[[nodiscard]] Result<std::unique_ptr<Store>> open_sqlite(const std::string& path, Missing missing, Job& job,
                                                         int busy_ms = kBusyMs);

}  // namespace capstan::casebase
