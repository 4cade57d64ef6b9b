#include <map>
#include <random>

#include "casebase/store/row.h"
#include "tests/casebase/postgres.h"
#include "tests/casebase/sample.h"
#include "tests/support/soak.h"

namespace capstan::casebase {
namespace {

using testing::HasSubstr;
using testing::Not;

class PostgresStore : public testing::Test {
 protected:
  void SetUp() override {
    place_ = PostgresPlace::make();
    if (!place_) GTEST_SKIP() << "there is no PostgreSQL on this machine";
  }
  std::string code_of_opening() const {
    Job job;
    const auto base = CaseBase::open(place_->uri(), job);
    return base ? "" : base.error().code;
  }
  std::unique_ptr<PostgresPlace> place_;
};

TEST_F(PostgresStore, RefusesADatabaseWithoutACaseBaseAndMakesNone) {
  EXPECT_EQ(code_of_opening(), "CASE-OPEN");
  EXPECT_EQ(place_->sql("SELECT count(*) FROM pg_namespace WHERE nspname = 'capstan'"), "0");
}

TEST_F(PostgresStore, RefusesASchemaThatIsNoCaseBaseAndANewerOne) {
  place_->sql("CREATE SCHEMA capstan");
  EXPECT_EQ(code_of_opening(), "CASE-SCHEMA");
  Job job;
  EXPECT_EQ(CaseBase::open_or_create(place_->uri(), job).error().code, "CASE-SCHEMA");
  place_->sql("DROP SCHEMA capstan");
  fill(place_->uri(), {sample()});
  place_->sql("COMMENT ON SCHEMA capstan IS 'Capstan case base, version 3'");
  const auto newer = CaseBase::open(place_->uri(), job);
  EXPECT_EQ(newer.error().code, "CASE-SCHEMA");
  EXPECT_THAT(newer.error().message, HasSubstr("version 3"));
}

TEST_F(PostgresStore, RefusesWhatItDidNotMake) {
  fill(place_->uri(), {sample()});
  Job job;
  auto open = CaseBase::open(place_->uri(), job).value();
  for (const auto& [spoil, mend] : std::initializer_list<std::pair<std::string, std::string>>{
           {"CREATE FUNCTION public.f() RETURNS trigger LANGUAGE plpgsql AS 'BEGIN RETURN NULL; END'; CREATE "
            "TRIGGER t BEFORE INSERT ON capstan.head FOR EACH ROW EXECUTE FUNCTION public.f()",
            "DROP TRIGGER t ON capstan.head"},
           {"CREATE RULE r AS ON INSERT TO capstan.head DO INSTEAD NOTHING", "DROP RULE r ON capstan.head"},
           {"CREATE VIEW capstan.v AS SELECT 1", "DROP VIEW capstan.v"},
           {"CREATE TABLE capstan.more(x integer)", "DROP TABLE capstan.more"},
           {"ALTER TABLE capstan.head ADD COLUMN more text", "ALTER TABLE capstan.head DROP COLUMN more"},
           {"ALTER TABLE capstan.body ENABLE ROW LEVEL SECURITY",
            "ALTER TABLE capstan.body DISABLE ROW LEVEL SECURITY"},
           {"CREATE FUNCTION capstan.encode(bytea, text) RETURNS text LANGUAGE sql AS 'SELECT ''00'''",
            "DROP FUNCTION capstan.encode"},
           {"CREATE TABLE public.child() INHERITS (capstan.head)", "DROP TABLE public.child"}}) {
    place_->sql(spoil);
    EXPECT_EQ(code_of_opening(), "CASE-SCHEMA") << spoil;
    EXPECT_EQ(open.add(sample(11.0)).error().code, "CASE-SCHEMA") << spoil;
    place_->sql(mend);
    // A dropped column leaves its place behind.
    if (mend.find("DROP COLUMN") != std::string::npos) {
      place_->sql("DROP SCHEMA capstan CASCADE");
      fill(place_->uri(), {sample()});
      open = CaseBase::open(place_->uri(), job).value();
    }
    EXPECT_EQ(code_of_opening(), "") << mend;
  }
  EXPECT_EQ(CaseBase::open(place_->uri(), job)->size(), 1u);
}

TEST_F(PostgresStore, IsReadWhereItMayNotBeWritten) {
  fill(place_->uri(), {sample()});
  place_->sql("ALTER DATABASE " + place_->sql("SELECT current_database()") +
              " SET default_transaction_read_only = on");
  Job job;
  auto base = CaseBase::open_or_create(place_->uri(), job);
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  EXPECT_TRUE(base->nearest(sample().asked, 1).has_value());
  EXPECT_EQ(base->add(sample(11.0)).error().code, "CASE-READ-ONLY");
}

TEST_F(PostgresStore, SaysThatAUserMayOnlyRead) {
  fill(place_->uri(), {sample()});
  place_->sql(
      "DROP ROLE IF EXISTS reader; CREATE ROLE reader LOGIN; GRANT USAGE ON SCHEMA capstan TO reader; GRANT "
      "SELECT "
      "ON ALL TABLES IN SCHEMA capstan TO reader");
  std::string uri = place_->uri();
  uri.replace(uri.find("shop@"), 5, "reader@");
  Job job;
  auto base = CaseBase::open_or_create(uri, job);
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  EXPECT_EQ(base->cases(), std::vector{sample()});
  EXPECT_EQ(base->add(sample(11.0)).error().code, "CASE-READ-ONLY");
  place_->sql("DROP OWNED BY reader");
}

/// Never an altered row; and where anything is missing, something is said.
void expect_honest(const std::string& uri, const std::map<std::string, Case>& originals,
                   const std::string& how, int& left_out) {
  Job job;
  const auto base = CaseBase::open(uri, job);
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  const std::vector<Case> given = base->cases();
  for (const Case& c : given) {
    const auto original = originals.find(c.id);
    ASSERT_NE(original, originals.end()) << how;
    EXPECT_EQ(c, original->second) << how;
  }
  const bool told = job.count(Severity::kWarning) != 0 || !base->take_faults().empty();
  EXPECT_TRUE(told) << how;
  if (given.size() != originals.size()) ++left_out;
}

TEST_F(PostgresStore, NeverGivesAnAlteredRowForAFlippedBit) {
  const std::vector<Case> cases = random_cases(30, 21);
  fill(place_->uri(), cases);
  std::map<std::string, Case> originals;
  for (const Case& c : cases) originals[c.id] = c;
  std::mt19937 random(7);
  int left_out = 0;
  const int flips = rounds(45, 150);
  for (int i = 0; i < flips && !HasFailure(); ++i) {
    const std::string column =
        std::vector<std::string>{"head", "body", "totals"}[static_cast<std::size_t>(i % 3)];
    const std::string table = "capstan." + (column == "totals" ? "total" : column);
    const std::string row =
        column == "totals" ? "one = 1" : "number = " + std::to_string(1 + random() % cases.size());
    const unsigned long bits =
        8 * std::stoul(place_->sql("SELECT octet_length(" + column + ") FROM " + table + " WHERE " + row));
    const std::string bit = std::to_string(random() % bits);
    const std::string flip = "UPDATE " + table + " SET " + column + " = set_bit(" + column + ", " + bit +
                             ", 1 - get_bit(" + column + ", " + bit + ")) WHERE " + row;
    place_->sql(flip);
    expect_honest(place_->uri(), originals, flip, left_out);
    place_->sql(flip);
  }
  EXPECT_GT(left_out, flips / 2);  // a head or a body: two of three
  Job job;
  EXPECT_EQ(CaseBase::open(place_->uri(), job)->size(), cases.size());
}

TEST_F(PostgresStore, NeverGivesAnAlteredRowForAFlippedBitInTheServersFiles) {
  const std::vector<Case> cases = random_cases(60, 22);
  fill(place_->uri(), cases);
  std::map<std::string, Case> originals;
  for (const Case& c : cases) originals[c.id] = c;
  std::mt19937 random(8);
  std::map<std::string, int> outcomes;
  constexpr int kRounds = 12;
  for (int i = 0; i < kRounds && !HasFailure(); ++i) {
    const std::string table = i % 2 == 0 ? "capstan.head" : "capstan.body";
    const std::string path = place_->server().data() + "/" +
                             place_->sql("CHECKPOINT; SELECT pg_relation_filepath('" + table + "')");
    place_->server().stop(SIGINT);
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    const std::string whole((std::istreambuf_iterator<char>(file)), {});
    ASSERT_FALSE(whole.empty()) << path;
    std::string broken = whole;
    // Rows fill a page from its end.
    const std::size_t page = 8192 * (random() % (whole.size() / 8192));
    const std::size_t at = page + (i % 4 < 2 ? 4096 + random() % 4096 : random() % 256);
    broken[at] = static_cast<char>(broken[at] ^ (1 << (random() % 8)));
    file.clear();
    file.seekp(0);
    file << broken << std::flush;
    ASSERT_TRUE(place_->server().start());
    Job job;
    const auto base = CaseBase::open(place_->uri(), job);
    if (base) {
      const std::vector<Case> given = base->cases();
      for (const Case& c : given) EXPECT_EQ(c, originals[c.id]) << table << ' ' << at;
      const bool told = job.count(Severity::kWarning) != 0 || !base->take_faults().empty();
      EXPECT_TRUE(given.size() == originals.size() || told) << table << ' ' << at;
      ++outcomes[given.size() == originals.size() ? "whole" : "left out"];
    } else {
      ++outcomes["refused"];
    }
    place_->server().stop(SIGINT);
    file.seekp(0);
    file << whole << std::flush;
    ASSERT_TRUE(place_->server().start());
  }
  EXPECT_GT(outcomes["refused"] + outcomes["left out"], 0);
  for (const auto& [outcome, n] : outcomes) RecordProperty(outcome, n);
}

TEST_F(PostgresStore, AddsNothingWhereRowsAreGone) {
  fill(place_->uri(), {sample(10.0), sample(20.0)});
  for (const std::string table : {"capstan.head", "capstan.total"}) {
    place_->sql("CREATE TABLE public.kept AS SELECT * FROM " + table + "; DELETE FROM " + table);
    Job job;
    auto base = CaseBase::open(place_->uri(), job).value();
    EXPECT_NE(job.count(Severity::kWarning), 0u);
    EXPECT_EQ(base.add(sample(30.0)).error().code, "CASE-DAMAGED");
    place_->sql("INSERT INTO " + table + " SELECT * FROM public.kept; DROP TABLE public.kept");
  }
}

TEST_F(PostgresStore, TellsNoPassword) {
  const std::string secret = "tr0ub4dor";
  Job job;
  const auto told = [&](const std::string& uri) {
    const auto base = CaseBase::open_or_create(uri, job);
    std::string out = base ? std::string() : to_text(base.error());
    for (const Diagnostic& d : job.diagnostics()) out += to_text(d);
    return out + name_of(uri);
  };
  const std::string nowhere = place_->beside().path().string();
  for (const std::string& uri :
       {"postgresql://shop:" + secret + "@/cases?host=" + nowhere,
        "postgresql://shop@/cases?password=" + secret + "&host=" + nowhere,
        "postgresql://shop:" + secret + "@127.0.0.1:1/cases",
        "postgresql://shop:" + secret + "/x@127.0.0.1:1/cases",
        "postgresql://shop:x@" + secret + "@127.0.0.1:1/cases",
        "postgresql://shop:x?" + secret + "@127.0.0.1:1/cases", "postgresql://shop:" + secret + "/cases",
        "postgresql:shop:" + secret + "@h/cases", "postgresql://shop:" + secret + "@[::1/cases",
        "mysql://shop:" + secret + "@h/cases",
        "postgresql://shop:" + secret + "@127.0.0.1:1/cases?what=" + secret,
        place_->uri(":" + secret) + "&sslmode=" + secret}) {
    const std::string said = told(uri);
    EXPECT_THAT(said, Not(HasSubstr(secret))) << uri;
    EXPECT_THAT(said, Not(testing::IsEmpty())) << uri;
  }
  EXPECT_EQ(name_of("postgresql://shop:" + secret + "@db.shop:5432/cases?sslmode=require&port=5433"),
            "postgresql://shop@db.shop:5432/cases?port=5433");
}

}  // namespace
}  // namespace capstan::casebase
