#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

// The tables of a case base in a file of SQLite, to the letter; only sqlite_store.cpp includes this.

namespace capstan::casebase {

inline constexpr int kApplicationId = 0x43415053;  // "CAPS"
inline constexpr int kSchemaVersion = 3;
inline constexpr const char* kHeadTable =
    "CREATE TABLE capstan_head(number INTEGER PRIMARY KEY, head BLOB NOT NULL) STRICT";
inline constexpr const char* kBodyTable =
    "CREATE TABLE capstan_body(number INTEGER PRIMARY KEY, body BLOB NOT NULL) STRICT";
inline constexpr const char* kTotalTable =
    "CREATE TABLE capstan_total(one INTEGER PRIMARY KEY CHECK(one = 1), totals BLOB NOT NULL) STRICT";

/// The number of the row of each case.
inline constexpr const char* kIdTable =
    "CREATE TABLE capstan_id(id BLOB PRIMARY KEY, number INTEGER NOT NULL) STRICT, WITHOUT ROWID";

/// Each table: its name, and the text that makes it. Version 2 had all but the last.
[[nodiscard]] inline std::array<std::pair<std::string_view, std::string>, 4> sqlite_tables() {
  return {{{"capstan_head", kHeadTable},
           {"capstan_body", kBodyTable},
           {"capstan_total", kTotalTable},
           {"capstan_id", kIdTable}}};
}

}  // namespace capstan::casebase
