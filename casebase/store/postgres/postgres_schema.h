#pragma once

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

#include "casebase/store/row.h"

// The tables of a case base on a server of PostgreSQL, by version; only postgres_store.cpp includes this.

namespace capstan::casebase {

inline constexpr int kVersion = 2;  // 2: the index of ids

/// What makes version n + 1 of version n; where there are rows, with the totals locked.
inline const std::array<std::string, kVersion> kSteps = {
    "CREATE SCHEMA capstan;"
    "CREATE TABLE capstan.head(number bigint PRIMARY KEY, head bytea NOT NULL);"
    "CREATE TABLE capstan.body(number bigint PRIMARY KEY, body bytea NOT NULL);"
    "CREATE TABLE capstan.total(one integer PRIMARY KEY CHECK(one = 1), totals bytea NOT NULL)",
    fmt::format("CREATE TABLE capstan.id(id bytea PRIMARY KEY, number bigint NOT NULL);"
                "INSERT INTO capstan.id SELECT substr(head, {0}, {1}), min(number) FROM capstan.head "
                "WHERE length(head) >= {2} AND get_byte(head, {3}) = {4} GROUP BY 1",
                kIdAt + 1, kIdBytes, kIdAt + kIdBytes, kIdAt - 1, static_cast<int>(RowKind::kCase))};

/// Whatever stands in the schema, as one text.
inline constexpr const char* kCatalogue = R"(
WITH ours AS (SELECT c.* FROM pg_class c JOIN pg_namespace n ON c.relnamespace = n.oid WHERE nspname = 'capstan')
SELECT coalesce(string_agg(what, E'\n' ORDER BY what COLLATE "C"), '') FROM (
  SELECT concat_ws(' ', 'relation', relkind, relname, relpersistence, relrowsecurity, relispartition) FROM ours
  UNION ALL SELECT concat_ws(' ', 'column', relname, attnum, attname, format_type(atttypid, atttypmod), attnotnull,
    atthasdef) FROM ours JOIN pg_attribute a ON attrelid = ours.oid WHERE relkind <> 'i' AND attnum > 0
  UNION ALL SELECT concat_ws(' ', 'constraint', relname, pg_get_constraintdef(k.oid))
    FROM ours JOIN pg_constraint k ON conrelid = ours.oid WHERE contype <> 'n'
  UNION ALL SELECT concat_ws(' ', 'trigger', tgname) FROM ours JOIN pg_trigger ON tgrelid = ours.oid
  UNION ALL SELECT concat_ws(' ', 'rule', rulename) FROM ours JOIN pg_rewrite ON ev_class = ours.oid
  UNION ALL SELECT concat_ws(' ', 'policy', polname) FROM ours JOIN pg_policy ON polrelid = ours.oid
  UNION ALL SELECT concat_ws(' ', 'child', inhrelid) FROM ours JOIN pg_inherits ON inhparent = ours.oid
  UNION ALL SELECT concat_ws(' ', 'function', proname) FROM pg_proc JOIN pg_namespace n ON pronamespace = n.oid
    WHERE nspname = 'capstan') AS all_of_it(what))";

/// What stands in it when it is ours, a line each; those of the index of ids are not in version 1.
inline constexpr const char* kOurs = R"(column body 1 number bigint t f
column body 2 body bytea t f
column head 1 number bigint t f
column head 2 head bytea t f
column id 1 id bytea t f
column id 2 number bigint t f
column total 1 one integer t f
column total 2 totals bytea t f
constraint body PRIMARY KEY (number)
constraint head PRIMARY KEY (number)
constraint id PRIMARY KEY (id)
constraint total CHECK ((one = 1))
constraint total PRIMARY KEY (one)
relation i body_pkey p f f
relation i head_pkey p f f
relation i id_pkey p f f
relation i total_pkey p f f
relation r body p f f
relation r head p f f
relation r id p f f
relation r total p f f
)";

/// The same of a version.
[[nodiscard]] inline std::string ours_of(int version) {
  std::string out;
  std::string_view left = kOurs;
  while (!left.empty()) {
    const std::string_view line = left.substr(0, left.find('\n') + 1);
    left.remove_prefix(line.size());
    const bool of_ids =
        line.find(" id ") != std::string_view::npos || line.find(" id_pkey ") != std::string_view::npos;
    if (version > 1 || !of_ids) out += line;
  }
  out.pop_back();  // the last line's end
  return out;
}

}  // namespace capstan::casebase
