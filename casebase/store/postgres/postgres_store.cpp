#include <fmt/format.h>
#include <libpq-fe.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <pqxx/pqxx>

#include "casebase/store/postgres/postgres_library.h"
#include "casebase/store/postgres/postgres_schema.h"
#include "casebase/store/row.h"

// One schema of a PostgreSQL database: a table of heads, a table of bodies, a row of totals, and since
// version 2 the row of each case by its id, as in a file of SQLite. The schema's comment states its version.
// It has to be ours by the catalogue: the same columns and constraints, and no trigger, rule, policy,
// function or further table. Every transaction sets its own search path, so that nothing of the database
// stands for a name of ours.
//
// A writer locks the totals against other writers (EXCLUSIVE; readers go on), reads what was appended
// meanwhile, and commits with at least the server's local disk written. Readers see one snapshot.
//
// Source: PostgreSQL 15 documentation, 13.2 (transaction isolation), 13.3 (explicit locking), 20.5 (write
// ahead log), 34.1 (connection strings); error classes of appendix A.

namespace capstan::casebase {
namespace {

constexpr std::string_view kComment = "Capstan case base, version ";
constexpr std::int64_t kLockKey = 0x43415053;  // "CAPS": makers of the tables wait for each other
constexpr std::size_t kHeadBytes = 1 << 14;  // above what a head may hold: four texts of 80 letters, numbers
constexpr std::size_t kBodyBytes = 1 << 20;  // as sqlite_store.cpp
constexpr std::size_t kPage = 1024;          // rows of heads asked for at a time
constexpr std::size_t kBodyPage = 256;       // the same of bodies
constexpr std::size_t kInsertBytes = 4 << 20;  // of a statement, about
constexpr const char* kWaitS = "5";            // for a server that does not answer. Default, unsourced

using Reading = pqxx::transaction<pqxx::repeatable_read, pqxx::read_only>;
using Writing = pqxx::transaction<pqxx::read_committed, pqxx::read_write>;

std::string hex(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  out.reserve(2 * bytes.size());
  for (const char c : bytes) {
    out += kDigits[static_cast<unsigned char>(c) >> 4U];
    out += kDigits[static_cast<unsigned char>(c) & 15U];
  }
  return out;
}

/// Four bytes of eight hexadecimal digits, the first in the lowest byte: '0' to '9' end in 0 to 9, 'a' to 'f'
/// in 1 to 6 with bit 6 set. A base of 100,000 cases has 25 million digits.
std::uint64_t unhexed(std::uint64_t digits) {
  const std::uint64_t values = (digits & 0x0f0f0f0f0f0f0f0fU) + 9U * (digits >> 6U & 0x0101010101010101U);
  std::uint64_t out = (values << 4U | values >> 8U) & 0x00ff00ff00ff00ffU;
  out = (out | out >> 8U) & 0x0000ffff0000ffffU;
  return (out | out >> 16U) & 0xffffffffU;
}

/// The bytes of a field that the server was asked for as hexadecimal digits.
std::string unhex(const pqxx::field& field) {
  static_assert(std::endian::native == std::endian::little);
  const char* digits = field.c_str();
  std::string out(field.size() / 2, '\0');
  for (std::size_t i = 0; i < out.size(); i += 4) {
    const std::size_t bytes = std::min<std::size_t>(4, out.size() - i);
    std::uint64_t eight = 0;
    if (bytes == 4) {
      std::memcpy(&eight, digits + 2 * i, 8);
    } else {
      std::memcpy(&eight, digits + 2 * i, 2 * bytes);
    }
    const std::uint64_t four = unhexed(eight);
    std::memcpy(out.data() + i, &four, bytes);
  }
  return out;
}

/// An array of bytea, or of bigint, as a literal.
void add_to(std::string& array, std::string_view element) {
  array += array.empty() ? "{" : ",";
  array += element;
}

class PostgresStore final : public Store {
 public:
  PostgresStore(std::string uri, std::string name, std::vector<std::string> secrets)
      : uri_(std::move(uri)), name_(std::move(name)), secrets_(std::move(secrets)) {}

  Status connect(Missing missing, Job& job);

  std::string name() const override { return name_; }
  Result<std::string> read(std::int64_t after, const TakeHead& take) override;
  Status bodies(std::span<const std::int64_t> numbers, const TakeBody& take) override;
  Status append(std::int64_t after, const TakeHead& take, const Decide& decide) override;
  Result<bool> append_found(std::span<const std::string> ids, const TakeHead& take,
                            const Decide& decide) override;

 private:
  std::string uri_, name_;
  std::vector<std::string> secrets_;
  std::unique_ptr<pqxx::connection> connection_;
  std::unique_ptr<pqxx::quiet_errorhandler> quiet_;

  Diagnostic fault(std::string code, std::string message, std::string hint = {}) const {
    return {.code = std::move(code), .message = std::move(message), .file = name_, .hint = std::move(hint)};
  }
  std::string told(std::string_view why) const;
  Diagnostic sql_fault(std::string_view doing, const pqxx::sql_error& e) const;
  template <class Do>
  Status guarded(std::string_view doing, const Do& act);
  /// Gives what the decision is made by; false: nothing is to be appended.
  using ReadHeads = std::function<Result<bool>(pqxx::transaction_base& t, int version)>;
  Status append_within(const ReadHeads& read, const Decide& decide);

  static void set_up(pqxx::transaction_base& t);
  Result<int> version(pqxx::transaction_base& t) const;
  Result<int> check(pqxx::transaction_base& t) const;
  Status make();
  static std::string totals(pqxx::transaction_base& t);
  static Status heads(pqxx::transaction_base& t, std::int64_t after, const TakeHead& take);
  static Status found(pqxx::transaction_base& t, std::span<const std::string> ids, const TakeHead& take);
  static void insert(pqxx::transaction_base& t, const Appended& appended, int version);
};

/// The first line of what the library says, without any secret.
std::string PostgresStore::told(std::string_view why) const {
  std::string out(why.substr(0, why.find('\n')));
  for (const std::string& secret : secrets_) {
    for (std::size_t at = out.find(secret); at != std::string::npos; at = out.find(secret, at + 3))
      out.replace(at, secret.size(), "...");
  }
  return out;
}

/// What the server reports, in our codes.
Diagnostic PostgresStore::sql_fault(std::string_view doing, const pqxx::sql_error& e) const {
  const std::string why = fmt::format("cannot {}: {}", doing, told(e.what())), state = e.sqlstate();
  const auto of_class = [&](std::string_view prefix) { return state.starts_with(prefix); };
  if (!connection_->is_open() || of_class("08") || of_class("57P"))
    return fault("CASE-OFFLINE", why, "the server went away; try again");
  if (state == "55P03" || state == "57014" || of_class("40"))
    return fault("CASE-BUSY", why, "another program is writing to it; try again");
  // The library gives some errors a class of its own, and then no state.
  const auto is = [&](auto* kind) { return dynamic_cast<decltype(kind)>(&e) != nullptr; };
  if (state == "25006" || is(static_cast<const pqxx::insufficient_privilege*>(nullptr)))
    return fault("CASE-READ-ONLY", why);
  if (of_class("XX") || is(static_cast<const pqxx::data_exception*>(nullptr)) ||
      is(static_cast<const pqxx::integrity_constraint_violation*>(nullptr)) ||
      is(static_cast<const pqxx::syntax_error*>(nullptr)))
    return fault("CASE-DAMAGED", why, "restore the database from a backup");
  return fault("CASE-STORE", why);
}

template <class Do>
Status PostgresStore::guarded(std::string_view doing, const Do& act) {
  try {
    return act();
  } catch (const pqxx::sql_error& e) {
    return fail(sql_fault(doing, e));
  } catch (const pqxx::transaction_rollback& e) {
    return fail(fault(connection_->is_open() ? "CASE-BUSY" : "CASE-OFFLINE",
                      fmt::format("cannot {}: {}", doing, told(e.what())), "try again"));
  } catch (const pqxx::failure& e) {  // the connection is lost, before or while it was committed
    return fail(fault("CASE-OFFLINE", fmt::format("cannot {}: {}", doing, told(e.what())),
                      "the server went away; try again"));
  } catch (const std::exception& e) {
    return fail(fault("CASE-STORE", fmt::format("cannot {}: {}", doing, told(e.what()))));
  }
}

void PostgresStore::set_up(pqxx::transaction_base& t) {
  // An acknowledged commit must be on the server's disk; a stricter setting of the server stays.
  t.exec("SET LOCAL search_path = pg_catalog; SET LOCAL row_security = off; SET LOCAL lock_timeout = " +
         std::to_string(kBusyMs) +
         "; SELECT set_config('synchronous_commit', 'local', true) "
         "WHERE current_setting('synchronous_commit') = 'off'");
}

/// 0 where there is no case base.
Result<int> PostgresStore::version(pqxx::transaction_base& t) const {
  const pqxx::result r =
      t.exec("SELECT obj_description(oid, 'pg_namespace') FROM pg_namespace WHERE nspname = 'capstan'");
  if (r.empty()) return 0;
  const std::string_view comment = r[0][0].is_null() ? "" : r[0][0].c_str();
  int of = 0;
  if (comment.starts_with(kComment)) of = std::atoi(comment.substr(kComment.size()).data());
  if (of < 1) return fail(fault("CASE-SCHEMA", "its schema 'capstan' is no case base"));
  if (of > kVersion) {
    return fail(fault("CASE-SCHEMA",
                      fmt::format("the case base is of version {}, this program knows {}", of, kVersion),
                      "use the newer program that made it"));
  }
  return of;
}

/// The version.
Result<int> PostgresStore::check(pqxx::transaction_base& t) const {
  const Result<int> of = version(t);
  if (!of) return of;
  if (*of == 0) return fail(fault("CASE-OPEN", "there is no case base", "`cases add` makes one"));
  const std::string there = t.exec1(kCatalogue)[0].c_str(), ours = ours_of(*of);
  if (there == ours) return of;
  // The first line that the one has and the other has not.
  const auto at = static_cast<std::size_t>(
      std::mismatch(there.begin(), there.end(), ours.begin(), ours.end()).first - there.begin());
  const std::size_t from = at == 0 ? 0 : there.rfind('\n', at - 1) + 1;
  return fail(
      fault("CASE-SCHEMA", fmt::format("it is not as it was made, at '{}'",
                                       there.substr(from, there.find('\n', from) - from).substr(0, 100))));
}

/// The tables, where there are none; those of an older version become ours.
Status PostgresStore::make() {
  return guarded("make the case base", [&]() -> Status {
    Writing t(*connection_);
    set_up(t);
    t.exec("SELECT pg_advisory_xact_lock(" + std::to_string(kLockKey) + ")");
    const Result<int> of = version(t);
    if (!of) return fail(of.error());
    if (*of == kVersion) return {};
    if (*of > 0) t.exec("LOCK TABLE capstan.total IN EXCLUSIVE MODE");
    for (auto step = static_cast<std::size_t>(*of); step < kSteps.size(); ++step) t.exec(kSteps[step]);
    t.exec(fmt::format("COMMENT ON SCHEMA capstan IS '{}{}'", kComment, kVersion));
    if (*of == 0)
      t.exec("INSERT INTO capstan.total VALUES(1, decode('" + hex(bytes_of(Totals{}, 0)) + "', 'hex'))");
    t.commit();
    return {};
  });
}

Status PostgresStore::connect(Missing missing, Job& job) {
  try {
    connection_ = std::make_unique<pqxx::connection>(uri_);
  } catch (const std::exception& e) {
    // One that answers and does not let us in is there: nothing waits for it.
    const bool there = PQping(uri_.c_str()) == PQPING_OK;
    return fail(fault(there ? "CASE-OPEN" : "CASE-OFFLINE", "cannot connect: " + told(e.what())));
  }
  quiet_ = std::make_unique<pqxx::quiet_errorhandler>(*connection_);
  bool lasting = true;
  if (missing == Missing::kCreate) {
    const Status made = make();
    // Who may not write may still read what is there.
    if (!made && made.error().code != "CASE-READ-ONLY") return made;
  }
  const Status checked = guarded("read it", [&]() -> Status {
    Reading t(*connection_);
    set_up(t);
    lasting = std::string_view(t.exec1("SHOW fsync")[0].c_str()) != "off";
    const Result<int> of = check(t);
    return of ? Status() : fail(of.error());
  });
  if (checked && !lasting) {
    job.report(
        Diagnostic{.code = "CASE-STORE",
                   .severity = Severity::kWarning,
                   .message = "the server runs without fsync: what it stored may be lost with its power",
                   .file = name_});
  }
  return checked;
}

std::string PostgresStore::totals(pqxx::transaction_base& t) {
  const pqxx::result r =
      t.exec("SELECT encode(substr(totals, 1, 200), 'hex') FROM capstan.total WHERE one = 1");
  return r.empty() ? std::string() : unhex(r[0][0]);
}

Status PostgresStore::heads(pqxx::transaction_base& t, std::int64_t after, const TakeHead& take) {
  while (true) {
    // One byte more than a head may have: what is longer is altered, and fails by its seal.
    const pqxx::result r = t.exec(
        fmt::format("SELECT number, encode(substr(head, 1, {}), 'hex') FROM capstan.head WHERE number > {} "
                    "ORDER BY number LIMIT {}",
                    kHeadBytes + 1, after, kPage));
    for (const pqxx::row& row : r) {
      after = row[0].as<std::int64_t>();
      if (Status taken = take(after, unhex(row[1])); !taken) return taken;
    }
    if (r.size() < kPage) return {};
  }
}

Result<std::string> PostgresStore::read(std::int64_t after, const TakeHead& take) {
  std::string stated;
  const Status done = guarded("read its cases", [&]() -> Status {
    Reading t(*connection_);
    set_up(t);
    if (const Result<int> of = check(t); !of) return fail(of.error());
    stated = totals(t);
    return heads(t, after, take);
  });
  if (!done) return fail(done.error());
  return stated;
}

Status PostgresStore::bodies(std::span<const std::int64_t> numbers, const TakeBody& take) {
  return guarded("read a case", [&]() -> Status {
    Reading t(*connection_);
    set_up(t);
    for (std::size_t from = 0; from < numbers.size(); from += kBodyPage) {
      std::string asked;
      const std::size_t to = std::min(from + kBodyPage, numbers.size());
      for (std::size_t i = from; i < to; ++i) add_to(asked, std::to_string(numbers[i]));
      const pqxx::result r = t.exec(
          fmt::format("SELECT i, encode(substr(body, 1, {}), 'hex') FROM unnest('{}}}'::bigint[]) WITH "
                      "ORDINALITY AS asked(n, i) JOIN capstan.body ON number = n",
                      kBodyBytes + 1, asked));
      for (const pqxx::row& row : r) take(from + row[0].as<std::size_t>() - 1, unhex(row[1]));
    }
    return {};
  });
}

/// The heads of the rows that have these ids, and of the last row.
Status PostgresStore::found(pqxx::transaction_base& t, std::span<const std::string> ids,
                            const TakeHead& take) {
  std::string asked;
  for (const std::string& id : ids) add_to(asked, '"' + hex(id) + '"');
  const std::string head = fmt::format("encode(substr(head, 1, {}), 'hex')", kHeadBytes + 1);
  const pqxx::result r = t.exec(
      fmt::format("SELECT i.number, coalesce({0}, '') FROM unnest('{1}}}'::text[]) AS asked(d) "
                  "JOIN capstan.id AS i ON i.id = decode(d, 'hex') LEFT JOIN capstan.head USING(number) "
                  "UNION ALL (SELECT number, {0} FROM capstan.head ORDER BY number DESC LIMIT 1)",
                  head, asked.empty() ? "{" : asked));
  for (const pqxx::row& row : r) {
    if (Status taken = take(row[0].as<std::int64_t>(), unhex(row[1])); !taken) return taken;
  }
  return {};
}

void PostgresStore::insert(pqxx::transaction_base& t, const Appended& appended, int version) {
  std::string numbers, heads, bodies, ids, cases;
  const auto put = [&] {
    if (numbers.empty()) return;
    for (const auto& [table, values] : {std::pair{"head", &heads}, {"body", &bodies}}) {
      t.exec(
          fmt::format("INSERT INTO capstan.{} SELECT n, decode(b, 'hex') FROM unnest('{}}}'::bigint[], "
                      "'{}}}'::text[]) AS new(n, b)",
                      table, numbers, *values));
    }
    if (!ids.empty()) {
      t.exec(
          fmt::format("INSERT INTO capstan.id SELECT decode(d, 'hex'), n FROM unnest('{}}}'::text[], "
                      "'{}}}'::bigint[]) AS new(d, n) ON CONFLICT DO NOTHING",
                      ids, cases));
    }
    ids.clear();
    cases.clear();
    numbers.clear();
    heads.clear();
    bodies.clear();
  };
  for (const NewRow& row : appended.rows) {
    add_to(numbers, std::to_string(row.number));
    add_to(heads, '"' + hex(row.head) + '"');
    add_to(bodies, '"' + hex(row.body) + '"');
    if (const auto id = case_id_in(row.head); id && version > 1) {
      add_to(ids, '"' + hex(*id) + '"');
      add_to(cases, std::to_string(row.number));
    }
    if (bodies.size() > kInsertBytes) put();
  }
  put();
  // Programs that know version 1 alone read totals without the number of cases.
  const auto stated = version > 1 ? std::nullopt : totals_of(appended.totals);
  t.exec("UPDATE capstan.total SET totals = decode('" + hex(stated ? bytes_of(*stated) : appended.totals) +
         "', 'hex') WHERE one = 1");
}

Status PostgresStore::append_within(const ReadHeads& read, const Decide& decide) {
  return guarded("add a case", [&]() -> Status {
    Writing t(*connection_);
    set_up(t);
    t.exec("LOCK TABLE capstan.total IN EXCLUSIVE MODE");
    const Result<int> of = check(t);
    if (!of) return fail(of.error());
    const std::string stated = totals(t);
    const Result<bool> go_on = read(t, *of);
    if (!go_on) return fail(go_on.error());
    if (!*go_on) return {};
    const Result<Appended> appended = decide(stated);
    if (!appended) return fail(appended.error());
    if (appended->rows.empty()) return {};
    insert(t, *appended, *of);
    t.commit();
    return {};
  });
}

Status PostgresStore::append(std::int64_t after, const TakeHead& take, const Decide& decide) {
  return append_within(
      [&](pqxx::transaction_base& t, int) -> Result<bool> {
        if (Status s = heads(t, after, take); !s) return fail(s.error());
        return true;
      },
      decide);
}

Result<bool> PostgresStore::append_found(std::span<const std::string> ids, const TakeHead& take,
                                         const Decide& decide) {
  bool indexed = false;
  const Status done = append_within(
      [&](pqxx::transaction_base& t, int version) -> Result<bool> {
        indexed = version > 1;
        if (!indexed) return false;
        if (Status s = found(t, ids, take); !s) return fail(s.error());
        return true;
      },
      decide);
  if (!done) return fail(done.error());
  return indexed;
}

struct FreeOptions {
  void operator()(PQconninfoOption* o) const { PQconninfoFree(o); }
};

tl::unexpected<Diagnostic> no_uri(std::string name) {
  // What stands there may hold a password, so that it is not repeated.
  return fail(Diagnostic{.code = "CASE-URI",
                         .message = "this is no URI of PostgreSQL",
                         .file = std::move(name),
                         .expected = "postgresql://user@host:port/database, other signs percent-encoded"});
}

/// As `connect_postgres` (server.h).
Result<std::unique_ptr<Store>> connected(const std::string& uri, const std::string& name, Missing missing,
                                         Job& job) {
  const std::unique_ptr<PQconninfoOption, FreeOptions> options(PQconninfoParse(uri.c_str(), nullptr));
  if (!options) return no_uri(name);
  std::vector<std::string> secrets;
  std::string whole = uri;
  const auto add_option = [&](std::string_view key, std::string_view value) {
    whole += whole.find('?') == std::string::npos ? '?' : '&';
    whole.append(key).append("=").append(value);
  };
  for (const PQconninfoOption* o = options.get(); o->keyword != nullptr; ++o) {
    const std::string_view key = o->keyword, value = o->val == nullptr ? "" : o->val;
    if (key.ends_with("password") && !value.empty()) secrets.emplace_back(value);
    const bool misread = (key == "host" || key == "dbname") && value.find('@') != std::string_view::npos;
    if (misread || (key == "port" && value.find_first_not_of("0123456789,") != std::string_view::npos))
      return no_uri(name);
    if (key == "connect_timeout" && value.empty()) add_option(key, kWaitS);
    if (key == "tcp_user_timeout" && value.empty()) add_option(key, std::to_string(2 * kBusyMs));
  }
  auto store = std::make_unique<PostgresStore>(whole, name, std::move(secrets));
  if (Status s = store->connect(missing, job); !s) return fail(s.error());
  return store;
}

}  // namespace
}  // namespace capstan::casebase

void capstan_connect_postgres(const std::string& uri, const std::string& name,
                              capstan::casebase::Missing missing, capstan::Job& job,
                              capstan::Result<std::unique_ptr<capstan::casebase::Store>>& to) {
  to = capstan::casebase::connected(uri, name, missing, job);
}

const char* capstan_postgres_identity() { return CAPSTAN_POSTGRES_IDENTITY; }
