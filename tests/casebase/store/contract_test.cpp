#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <thread>

#include "casebase/casebase.h"
#include "casebase/intake.h"
#include "casebase/store/row.h"
#include "casebase/store/store.h"
#include "tests/casebase/killed_writer.h"
#include "tests/casebase/postgres.h"
#include "tests/casebase/sample.h"

namespace capstan::casebase {
namespace {

/// A place where a store of one kind is made, empty, and gone with it.
class Where {
 public:
  Where() = default;
  Where(const Where&) = delete;
  Where& operator=(const Where&) = delete;
  virtual ~Where() = default;
  [[nodiscard]] virtual std::string uri() const = 0;
};

class InAFile final : public Where {
 public:
  std::string uri() const override { return "sqlite:" + folder_.file(); }

 private:
  Folder folder_;
};

class OnAServer final : public Where {
 public:
  explicit OnAServer(std::unique_ptr<PostgresPlace> place) : place_(std::move(place)) {}
  template <PostgresServer::Way kWay>
  static std::unique_ptr<Where> make() {
    auto place = PostgresPlace::make(kWay);
    return place ? std::make_unique<OnAServer>(std::move(place)) : nullptr;
  }
  std::string uri() const override { return place_->uri(); }

 private:
  std::unique_ptr<PostgresPlace> place_;
};

/// A kind of store: its name, and a place for one; null where the machine has none, and the test is skipped.
struct StoreKind {
  std::string name;
  std::function<std::unique_ptr<Where>()> make;
};
std::ostream& operator<<(std::ostream& to, const StoreKind& kind) { return to << kind.name; }

/// What every store promises, whatever it keeps its rows in.
class StoreContract : public testing::TestWithParam<StoreKind> {
 protected:
  void SetUp() override {
    where_ = GetParam().make();
    if (!where_) GTEST_SKIP() << "there is no " << GetParam().name << " on this machine";
  }
  std::unique_ptr<Store> store() { return open_store(where_->uri(), Missing::kCreate, job_).value(); }
  CaseBase base() { return CaseBase::open_or_create(where_->uri(), job_).value(); }
  void TearDown() override { EXPECT_EQ(job_.count(Severity::kWarning), 0u); }

  std::unique_ptr<Where> where_;
  Job job_;
};

/// The rows behind `after`, as "number:head".
std::vector<std::string> rows_of(Store& store, std::int64_t after = 0) {
  std::vector<std::string> out;
  const auto read = store.read(after, [&](std::int64_t number, std::string_view head) -> Status {
    out.push_back(std::to_string(number) + ':' + std::string(head));
    return {};
  });
  EXPECT_TRUE(read.has_value());
  return out;
}

Status append(Store& store, std::int64_t number, const std::string& head, const std::string& body) {
  return store.append(
      number - 1, [&](std::int64_t, std::string_view) -> Status { return {}; },
      [&](const std::string&) -> Result<Store::Appended> {
        return Store::Appended{{{number, head, body}}, bytes_of(Totals{number, {}})};
      });
}

/// A row that the store may hold against its totals.
std::string head_for(std::int64_t number, const std::string& body) {
  Head head;
  head.body = sum_of(body);
  return bytes_of(head, number);
}

TEST_P(StoreContract, GivesRowsByNumberAndBodiesByRow) {
  const auto s = store();
  std::vector<std::string> expected;
  for (std::int64_t i = 1; i <= 3; ++i) {
    const std::string body = "body \x01 " + std::to_string(i), head = head_for(i, body);
    ASSERT_TRUE(append(*s, i, head, body).has_value());
    expected.push_back(std::to_string(i) + ':' + head);
  }
  EXPECT_EQ(rows_of(*s), expected);
  EXPECT_EQ(rows_of(*s, 2), std::vector{expected[2]});
  const std::vector<std::int64_t> numbers = {3, 7, 1};
  std::map<std::size_t, std::string> bodies;
  ASSERT_TRUE(
      s->bodies(numbers, [&](std::size_t i, std::string_view body) { bodies[i] = body; }).has_value());
  EXPECT_EQ(bodies, (std::map<std::size_t, std::string>{{0, "body \x01 " + std::to_string(3)},
                                                        {2, "body \x01 " + std::to_string(1)}}));
}

TEST_P(StoreContract, AppendsNothingWhenTheDecisionFails) {
  const auto s = store();
  ASSERT_TRUE(append(*s, 1, head_for(1, "a"), "a").has_value());
  const Status refused = s->append(
      0, [](std::int64_t, std::string_view) -> Status { return {}; },
      [](const std::string&) -> Result<Store::Appended> { return fail("CASE-LIMIT", "no"); });
  EXPECT_EQ(refused.error().code, "CASE-LIMIT");
  const Status broken = s->append(
      0, [](std::int64_t, std::string_view) -> Status { return fail("CASE-DAMAGED", "no"); },
      [](const std::string&) -> Result<Store::Appended> { return Store::Appended{}; });
  EXPECT_EQ(broken.error().code, "CASE-DAMAGED");
  EXPECT_EQ(rows_of(*s).size(), 1u);
}

TEST_P(StoreContract, RefusesARowWhoseNumberIsTaken) {
  const auto s = store();
  ASSERT_TRUE(append(*s, 1, head_for(1, "a"), "a").has_value());
  EXPECT_FALSE(append(*s, 1, head_for(1, "b"), "b").has_value());
  EXPECT_EQ(rows_of(*s), std::vector{"1:" + head_for(1, "a")});
}

TEST_P(StoreContract, TellsAWriterWhatOthersAppended) {
  const auto mine = store(), other = store();
  ASSERT_TRUE(append(*mine, 1, head_for(1, "a"), "a").has_value());
  std::vector<std::int64_t> seen;
  const Status done = other->append(
      0,
      [&](std::int64_t number, std::string_view) -> Status {
        seen.push_back(number);
        return {};
      },
      [](const std::string&) -> Result<Store::Appended> { return Store::Appended{}; });
  EXPECT_TRUE(done.has_value());
  EXPECT_EQ(seen, std::vector<std::int64_t>{1});
}

TEST_P(StoreContract, GivesTheRowsOfTheseIdsAndTheLastOneAlone) {
  const std::vector<Case> cases = random_cases(200, 7);
  ASSERT_TRUE(base().add(cases).has_value());
  const std::vector<std::string> ids = {id_bytes_of(*id_of_digits(cases[3].id)),
                                        id_bytes_of(*id_of_digits(sample(99.0).id)),
                                        id_bytes_of(*id_of_digits(cases[150].id))};
  std::vector<std::int64_t> given;
  const auto s = store();
  const Result<bool> indexed = s->append_found(
      ids,
      [&](std::int64_t number, std::string_view head) -> Status {
        EXPECT_TRUE(head_of(head, number).has_value());
        given.push_back(number);
        return {};
      },
      [](const std::string& totals) -> Result<Store::Appended> {
        EXPECT_EQ(stated_of(totals)->held, 200);
        return Store::Appended{};
      });
  ASSERT_TRUE(indexed.has_value());
  EXPECT_TRUE(*indexed);
  std::sort(given.begin(), given.end());
  EXPECT_EQ(given, (std::vector<std::int64_t>{4, 151, 200}));  // rows count from 1
}

TEST_P(StoreContract, AddsWithoutReadingAndCountsAsOneWhoReads) {
  const std::vector<Case> cases = random_cases(60, 11);
  std::vector<Case> expected;
  // Who reads, who does not, who removes: each begins where the others ended.
  ASSERT_TRUE(base().add(std::span(cases).first(20)).has_value());
  auto intake = Intake::open_or_create(where_->uri(), job_).value();
  Case silent = cases[5];
  silent.observed.verdict = Verdict::kUnknown;
  const std::vector<Case> some = {cases[20], silent, cases[21], cases[20]};
  const auto added = intake.add(some);
  ASSERT_TRUE(added.has_value() && *added) << (added ? "" : to_text(added.error()));
  EXPECT_EQ((*added)->added, 2u);
  EXPECT_EQ((*added)->held, 22u);
  ASSERT_TRUE(base().remove(std::vector{cases[0].id}, {"A. Smith", "", "wrong part"}).has_value());
  // One that was removed stays away, and counts no more.
  Case removed = cases[0];
  removed.observed.verdict = Verdict::kUnknown;
  const auto again = intake.add(std::vector{removed, cases[22]});
  ASSERT_TRUE(again.has_value() && *again);
  EXPECT_EQ((*again)->added, 1u);
  EXPECT_EQ((*again)->held, 22u);
  for (std::size_t i = 1; i <= 22; ++i) expected.push_back(cases[i]);
  std::sort(expected.begin(), expected.end(), [](const Case& a, const Case& b) { return a.id < b.id; });
  EXPECT_EQ(base().cases(), expected);
  EXPECT_EQ(base().size(), 22u);
}

TEST_P(StoreContract, LeavesACaseThatIsThereAndStatesAVerdictToOneWhoReads) {
  ASSERT_TRUE(base().add(sample()).has_value());
  auto intake = Intake::open_or_create(where_->uri(), job_).value();
  Case other = sample();
  other.observed.verdict = Verdict::kBad;
  const auto added = intake.add(std::vector{sample(11.0), other});
  ASSERT_TRUE(added.has_value());
  EXPECT_FALSE(added->has_value());
  EXPECT_EQ(intake.read(job_)->size(), 1u);
}

TEST_P(StoreContract, RefusesWithoutReadingACaseThatCannotBe) {
  auto intake = Intake::open_or_create(where_->uri(), job_).value();
  Case wrong = sample();
  wrong.bound.fz_mm = -1.0;
  EXPECT_EQ(intake.add(std::vector{sample(11.0), wrong}).error().code, "CASE-INVALID");
  EXPECT_EQ(base().size(), 0u);
}

TEST_P(StoreContract, TakesEightWritersWhoDoNotReadAtATime) {
  constexpr std::size_t kWriters = 8;
  std::vector<Case> cases = random_cases(100, 37);
  for (Case& c : cases) c.observed.verdict = Verdict::kUnknown;
  ASSERT_TRUE(base().add(cases[0]).has_value());
  std::vector<std::string> faults(kWriters);
  std::vector<std::thread> writers;
  for (std::size_t w = 0; w < kWriters; ++w) {
    writers.emplace_back([&, w] {
      Job job;
      auto mine = Intake::open_or_create(where_->uri(), job);
      if (!mine) faults[w] = to_text(mine.error());
      for (std::size_t i = w * 10; i < w * 10 + 30 && faults[w].empty(); ++i) {  // others add twenty, too
        const auto added = mine->add(std::span(&cases[i], 1));
        if (!added || !*added) faults[w] = added ? "has to read it" : to_text(added.error());
      }
    });
  }
  for (std::thread& t : writers) t.join();
  EXPECT_EQ(faults, std::vector<std::string>(kWriters));
  EXPECT_EQ(base().size(), cases.size());
}

TEST_P(StoreContract, KeepsWhatWasAdded) {
  std::vector<Case> cases = random_cases(100, 1);
  ASSERT_TRUE(base().add(cases).has_value());
  std::sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.id < b.id; });
  EXPECT_EQ(base().cases(), cases);
}

TEST_P(StoreContract, AddsEqualCasesOnce) {
  auto one = base(), other = base();
  ASSERT_TRUE(one.add(std::vector{sample(), sample(), sample(11.0)}).has_value());
  ASSERT_TRUE(other.add(std::vector{sample(), sample(12.0)}).has_value());
  EXPECT_EQ(other.size(), 3u);
  EXPECT_EQ(base().size(), 3u);
}

TEST_P(StoreContract, KeepsASeriesOfTheGreatestLength) {
  Case c = sample();
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    c.observed.wear_series_mm.samples.push_back(
        {60.0 * static_cast<double>(i), 1e-4 * static_cast<double>(i)});
    c.observed.load_series_percent.samples.push_back({static_cast<double>(i), 50.0});
  }
  c.id = id_of(c);
  ASSERT_TRUE(base().add(c).has_value());
  EXPECT_EQ(base().get(c.id).value(), c);
}

TEST_P(StoreContract, TakesEightWritersAtATime) {
  constexpr std::size_t kWriters = 8;
  const std::vector<Case> cases = random_cases(100, 31);
  ASSERT_TRUE(base().add(cases[0]).has_value());
  std::vector<std::string> faults(kWriters);
  std::vector<std::thread> writers;
  for (std::size_t w = 0; w < kWriters; ++w) {
    writers.emplace_back([&, w] {
      Job job;
      auto mine = CaseBase::open(where_->uri(), job);
      if (!mine) {
        faults[w] = to_text(mine.error());
        return;
      }
      for (std::size_t i = w * 10; i < w * 10 + 30 && faults[w].empty();
           ++i) {  // twenty of them others add, too
        if (const Status s = mine->add(cases[i]); !s) faults[w] = to_text(s.error());
      }
    });
  }
  for (std::thread& t : writers) t.join();
  EXPECT_EQ(faults, std::vector<std::string>(kWriters));
  EXPECT_EQ(base().size(), cases.size());
}

TEST_P(StoreContract, IsWholeAfterItsWriterWasKilled) {
  fill(where_->uri(), {});
  expect_whole_after_killed_writers(where_->uri(), 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, StoreContract,
    testing::Values(StoreKind{"sqlite", [] { return std::make_unique<InAFile>(); }},
                    StoreKind{"postgresql", OnAServer::make<PostgresServer::Way::kSocket>},
                    StoreKind{"postgresql_over_tcp", OnAServer::make<PostgresServer::Way::kTcp>}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace capstan::casebase
