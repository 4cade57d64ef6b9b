#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "planner/ground/base/tables/separated.h"
#include "tests/support/corpus.h"

namespace capstan::testing {

/// One row of a test's data file, by the names of its columns.
using DataRow = std::map<std::string, std::string>;

/// The rows of a file of this checkout with separated values (RFC 4180), whose first row names the columns;
/// `path` is relative to the root. Fails the running test where the file cannot be read, where a row has more
/// or fewer cells than there are columns, and where the last column, the reason, is empty.
inline std::vector<DataRow> data_rows(const std::string& path) {
  const auto rows =
      separated_rows(slurp(source_dir() + "/" + path), ',', path, "TEST-DATA", StrayQuotes::kRefused);
  EXPECT_TRUE(rows) << to_text(rows.error());
  std::vector<DataRow> out;
  if (!rows || rows->empty()) return out;
  const std::vector<std::string>& columns = rows->front().cells;
  for (std::size_t i = 1; i < rows->size(); ++i) {
    const SeparatedRow& row = (*rows)[i];
    EXPECT_EQ(row.cells.size(), columns.size()) << path << ":" << row.line;
    if (row.cells.size() != columns.size()) continue;
    EXPECT_FALSE(row.cells.back().empty()) << path << ":" << row.line << " has no reason";
    DataRow named;
    for (std::size_t k = 0; k < columns.size(); ++k) named.emplace(columns[k], row.cells[k]);
    out.push_back(std::move(named));
  }
  return out;
}

}  // namespace capstan::testing
