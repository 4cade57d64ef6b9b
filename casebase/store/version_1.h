#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "casebase/record/case.h"
#include "casebase/store/row.h"
#include "casebase/store/store.h"

/// Case bases of version 1: one table with a column per number, and a row of totals. They are read as if they
/// were of version 2, and become one when something is added to them.
namespace capstan::casebase {

/// A value of a row as the store gave it.
struct OldCell {
  enum class Type : std::uint8_t { kText, kReal, kInteger, kOther };
  Type type = Type::kOther;
  std::string text;
  double real = 0.0;
  std::int64_t integer = 0;
};

/// The totals of version 1: how many cases, and the exclusive or of their ids.
struct OldTotals {
  std::int64_t count = 0;
  std::string ids;
  bool operator==(const OldTotals&) const = default;
};

/// A file of version 1 as rows of version 2.
struct OldRows {
  OldTotals stated;
  std::vector<NewRow> rows;
  Totals totals;
  bool damaged = false;  ///< cases were altered or are gone
};

/// The text of the schema, to the letter; the tables in the order of their names.
[[nodiscard]] std::string old_case_table();
[[nodiscard]] std::string old_total_table();
/// Gives id and columns of all cases by id.
[[nodiscard]] std::string old_select();

/// Takes the rows of `old_select` one by one.
class OldReader {
 public:
  OldReader(std::string file, OldTotals stated) : file_(std::move(file)) { out_.stated = std::move(stated); }
  /// A row that cannot be a case, or was altered, is reported (CASE-ROW) and left out.
  void row(std::span<const OldCell> cells, Job& job);
  [[nodiscard]] std::size_t count() const { return read_; }
  [[nodiscard]] OldRows end(Job& job);

 private:
  void append(RowKind kind, const Case& c, std::string body);
  void keep(Case c);

  std::string file_;
  OldRows out_;
  std::size_t read_ = 0, refused_ = 0, trusted_ = 0;
  std::string last_id_;
  Sum ids_;
  std::map<Id, Verdict> kept_;
};

}  // namespace capstan::casebase
