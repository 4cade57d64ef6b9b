#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "casebase/store/row.h"
#include "casebase/store/store.h"
#include "casebase/store/version_1.h"
#include "tests/casebase/sample.h"

namespace capstan::casebase {

/// A file as the last program of version 1 left it: two cases, their ids and totals included. `more`: SQL
/// that is run then.
inline std::string file_of_version_1(const Folder& folder, const std::string& more = "") {
  const std::string path = folder.file("old.db");
  tamper(
      path,
      old_case_table() + "; " + old_total_table() +
          "; INSERT INTO capstan_case VALUES('b91149ff5f6cbe84627d125213b26e6d', 'DRILLING', 'P/mild_steel', "
          "'hss/twist_drill', 'generic_vmc', 'good', 'measured', 'part 1', 20.0, 20.0, 0.0, 0.0, 20.0, 30.0, "
          "0.1, 0.0, 0.0, 6.5, 0.0, 0.0, 0.0, 0.0, 2, 1); "
          "INSERT INTO capstan_case VALUES('c5a12ec56cacf3ea2d1ecfe28f4c43b8', 'DRILLING', 'P/mild_steel', "
          "'hss/twist_drill', 'generic_vmc', 'good', 'measured', 'part 1', 10.0, 20.0, 0.0, 0.0, 10.0, 30.0, "
          "0.1, 0.0, 0.0, 6.5, 0.0, 0.0, 0.0, 0.0, 2, 1); "
          "INSERT INTO capstan_total VALUES(1, 2, '7cb0673a33c04d6e4f63ddb09cfe2dd5'); "
          "PRAGMA application_id = 1128353875; PRAGMA user_version = 1;" +
          more);
  return path;
}

/// The totals of a store as hexadecimal digits, without the number of cases that version 2 did not state.
inline std::string totals_of_version_2(const std::string& uri) {
  Job job;
  const auto store = open_store(uri, Missing::kRefuse, job).value();
  const std::string stated =
      store->read(0, [](std::int64_t, std::string_view) -> Status { return {}; }).value();
  std::string out;
  for (const char c : bytes_of(*totals_of(stated))) {
    char digits[3];
    std::snprintf(digits, sizeof(digits), "%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    out += digits;
  }
  return out;
}

/// A file as the last program of version 2 left it, with these cases.
inline std::string file_of_version_2(const Folder& folder, const std::vector<Case>& cases) {
  const std::string path = folder.file("old.db");
  fill(path, cases);
  const std::string totals = totals_of_version_2(path);
  tamper(path, "DROP TABLE capstan_id; UPDATE capstan_total SET totals = x'" + totals +
                   "'; PRAGMA user_version = 2; VACUUM");
  return path;
}

}  // namespace capstan::casebase
