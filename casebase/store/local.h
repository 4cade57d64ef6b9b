#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "casebase/store/row.h"
#include "casebase/store/store.h"

/// What stands beside a case base on a server: two files of SQLite, both case bases by themselves.
///
///   copy     the server's rows from the first to some row. It only grows, by rows that were verified and
///   that
///            the server has for good. It may be thrown away.
///   outbox   what was added while the server could not be reached, with row numbers of its own.
namespace capstan::casebase {

struct LocalFiles {
  std::string copy, outbox, lock;
};
/// Those of a store of this name: in `$CAPSTAN_CASES`, else `$XDG_DATA_HOME/capstan/cases`, else
/// `~/.local/share/capstan/cases`. Fails CASE-STORE: no such folder can be made.
[[nodiscard]] Result<LocalFiles> local_files(const std::string& name);

/// The lock between programs; the system opens it when a program ends, however it ends.
class FileLock {
 public:
  /// Waits for `kBusyMs`. Fails CASE-BUSY.
  [[nodiscard]] static Result<FileLock> take(const std::string& path);
  FileLock(FileLock&& o) noexcept : fd_(std::exchange(o.fd_, -1)) {}
  FileLock& operator=(FileLock&&) = delete;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  explicit FileLock(int fd) : fd_(fd) {}
  int fd_;
};

/// All rows of a file, and whether they are those that its totals speak of.
struct FileRows {
  std::vector<NewRow> rows;  ///< without their bodies
  Totals totals;             ///< of the rows
  std::string stated;
  bool whole = false;
};
[[nodiscard]] Result<FileRows> rows_of(Store& file);

/// The base as it is without the server: the rows of the copy and, behind them, those of the outbox. What is
/// added goes into the outbox. `copied` and `waiting` count the rows of now.
struct LocalBase {
  std::unique_ptr<Store> store;
  std::int64_t copied = 0, waiting = 0;
};
/// Fails as opening the files does.
[[nodiscard]] Result<LocalBase> open_local(const LocalFiles& files, const std::string& name);

}  // namespace capstan::casebase
