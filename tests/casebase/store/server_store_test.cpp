#include <set>
#include <thread>

#include "casebase/intake.h"
#include "casebase/store/local.h"
#include "tests/casebase/killed_writer.h"
#include "tests/casebase/postgres.h"
#include "tests/casebase/sample.h"

namespace capstan::casebase {
namespace {

using testing::HasSubstr;

/// A base on a server that comes and goes.
class ServerStore : public testing::Test {
 protected:
  void SetUp() override {
    place_ = PostgresPlace::make();
    if (!place_) GTEST_SKIP() << "there is no PostgreSQL on this machine";
  }
  void TearDown() override {
    if (place_) {
      ASSERT_TRUE(up());
    }
  }
  void down(int signal = SIGINT) {
    place_->server().stop(signal);
    up_ = false;
  }
  bool up() {
    if (!up_) up_ = place_->server().start();
    return up_;
  }
  /// Opens the base; `job_` has what was said then alone.
  Result<CaseBase> open() {
    (void)job_.take_diagnostics();
    return CaseBase::open(place_->uri(), job_);
  }
  std::vector<std::string> codes() const {
    std::vector<std::string> out;
    for (const Diagnostic& d : job_.diagnostics()) out.push_back(d.code);
    return out;
  }
  LocalFiles files() const { return local_files(name_of(place_->uri())).value(); }

  std::unique_ptr<PostgresPlace> place_;
  Job job_;
  bool up_ = true;
};

TEST_F(ServerStore, IsReadFromItsCopyWhileTheServerIsAway) {
  fill(place_->uri(), random_cases(50, 3));
  const std::vector<Case> cases = open()->cases();
  down();
  const auto base = open();
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  EXPECT_EQ(codes(), std::vector<std::string>{"CASE-OFFLINE"});
  EXPECT_THAT(job_.diagnostics()[0].message, HasSubstr("50 rows"));
  EXPECT_EQ(base->cases(), cases);
}

TEST_F(ServerStore, IsAddedToWithoutReadingAndItsCopyFollows) {
  fill(place_->uri(), random_cases(20, 3));
  (void)open();
  auto intake = Intake::open_or_create(place_->uri(), job_).value();
  const auto added = intake.add(std::vector{sample(30.0), sample(31.0)});
  ASSERT_TRUE(added.has_value() && *added);
  EXPECT_EQ((*added)->held, 22u);
  EXPECT_TRUE(intake.take_faults().empty());
  down();
  EXPECT_EQ(open()->size(), 22u);
}

TEST_F(ServerStore, IsReadFromItsCopyToBeAddedToWhileTheServerIsAway) {
  fill(place_->uri(), {sample(10.0)});
  down();
  (void)job_.take_diagnostics();
  auto intake = Intake::open_or_create(place_->uri(), job_).value();
  const auto added = intake.add(std::vector{sample(30.0)});
  ASSERT_TRUE(added.has_value());
  EXPECT_FALSE(added->has_value());
  ASSERT_TRUE(intake.read(job_)->add(sample(30.0)).has_value());
  EXPECT_EQ(codes(), std::vector<std::string>{"CASE-OFFLINE"});  // once
  ASSERT_TRUE(up());
  EXPECT_EQ(open()->size(), 2u);
}

TEST_F(ServerStore, WaitsInTheOutboxWhereTheServerWentAwayWhileItWasAddedTo) {
  fill(place_->uri(), {sample(10.0)});
  auto intake = Intake::open_or_create(place_->uri(), job_).value();
  down();
  const auto added = intake.add(std::vector{sample(30.0)});
  ASSERT_TRUE(added.has_value()) << to_text(added.error());
  EXPECT_FALSE(added->has_value());
  auto base = intake.read(job_);
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  ASSERT_TRUE(base->add(sample(30.0)).has_value());
  EXPECT_TRUE(std::filesystem::exists(files().outbox));
  ASSERT_TRUE(up());
  EXPECT_EQ(open()->size(), 2u);
}

TEST_F(ServerStore, RefusesAServerThatItNeverReached) {
  down();
  EXPECT_EQ(open().error().code, "CASE-OPEN");
}

TEST_F(ServerStore, KeepsInTheOutboxWhatIsAddedMeanwhileAndSendsItAtTheNextOpening) {
  fill(place_->uri(), {sample(10.0), sample(11.0)});
  const std::string judged = sample(10.0).id, gone = sample(11.0).id;
  Metric learned;
  down();
  {
    auto base = open().value();
    ASSERT_TRUE(base.add(std::vector{sample(12.0), sample(13.0)}).has_value());
    ASSERT_TRUE(base.judge(std::vector{judged}, Verdict::kBad, {"A. Smith", "", "chatter"}).has_value());
    ASSERT_TRUE(base.remove(std::vector{gone}, {"A. Smith", "", "wrong part"}).has_value());
    ASSERT_TRUE(
        base.judge(std::vector{sample(12.0).id}, Verdict::kBad, {"A. Smith", "", "worn"}).has_value());
    learned = base.learn_metric().value();
  }
  const std::vector<Case> away = open()->cases();  // another program, while the server is away
  EXPECT_EQ(away.size(), 3u);
  ASSERT_TRUE(up());
  const auto base = open().value();
  EXPECT_EQ(codes(), std::vector<std::string>{"CASE-OUTBOX"});
  EXPECT_THAT(job_.diagnostics()[0].message, HasSubstr("6 rows"));
  EXPECT_EQ(base.cases(), away);
  EXPECT_EQ(base.metric(), learned);
  ASSERT_EQ(base.later_verdicts(judged).size(), 1u);
  EXPECT_EQ(base.later_verdicts(judged)[0].reason, "chatter");
  EXPECT_FALSE(std::filesystem::exists(files().outbox));
  EXPECT_EQ(place_->sql("SELECT count(*) FROM capstan.head"), "8");
  (void)open();
  EXPECT_EQ(codes(), std::vector<std::string>{});
}

TEST_F(ServerStore, SendsAnOutboxTwiceWithoutCountingTwice) {
  fill(place_->uri(), {sample(10.0)});
  down();
  {
    auto base = open().value();
    ASSERT_TRUE(base.add(sample(12.0)).has_value());
    ASSERT_TRUE(
        base.judge(std::vector{sample(10.0).id}, Verdict::kBad, {"A. Smith", "", "chatter"}).has_value());
  }
  // Killed when the server had committed and the outbox was not yet gone; meanwhile somebody judged again.
  const std::string kept = files().outbox + ".kept";
  std::filesystem::copy_file(files().outbox, kept);
  ASSERT_TRUE(up());
  ASSERT_TRUE(open()
                  ->judge(std::vector{sample(10.0).id}, Verdict::kGood, {"B. Jones", "", "measured again"})
                  .has_value());
  std::filesystem::copy_file(kept, files().outbox);
  const auto base = open().value();
  EXPECT_THAT(job_.diagnostics().at(0).message, HasSubstr("0 of them new"));
  EXPECT_EQ(base.size(), 2u);
  EXPECT_EQ(base.get(sample(10.0).id)->observed.verdict, Verdict::kGood);
  EXPECT_EQ(base.later_verdicts(sample(10.0).id).size(), 2u);
}

TEST_F(ServerStore, LosesNothingWhenTheServerIsKilledBeneathAWriter) {
  fill(place_->uri(), {sample(10.0)});
  auto base = open().value();
  down(SIGKILL);
  ASSERT_TRUE(base.add(sample(11.0)).has_value());
  const auto said = base.take_faults();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].code, "CASE-OFFLINE");
  EXPECT_EQ(base.cases().size(), 2u);
  ASSERT_TRUE(up());
  EXPECT_EQ(open()->size(), 2u);
}

TEST_F(ServerStore, LosesNothingThatWasAcknowledgedWhenTheServerIsKilledWhileWritersWrite) {
  fill(place_->uri(), {});
  constexpr std::size_t kWriters = 8;
  std::vector<std::set<std::string>> acknowledged(kWriters);
  for (unsigned round = 0; round < 2; ++round) {
    std::vector<std::thread> writers;
    for (std::size_t w = 0; w < kWriters; ++w) {
      writers.emplace_back([&, w] {
        for (unsigned i = 0; i < 8; ++i) {
          Job job;
          auto mine = CaseBase::open(place_->uri(), job);
          const std::vector<Case> cases =
              random_cases(3, 10'000 * (round + 1) + static_cast<unsigned>(100 * w) + i);
          if (!mine || !mine->add(cases)) continue;
          for (const Case& c : cases) acknowledged[w].insert(c.id);
        }
      });
    }
    usleep(300'000);
    down(SIGKILL);
    for (std::thread& t : writers) t.join();
    ASSERT_TRUE(up());
  }
  const auto base = open();
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  EXPECT_EQ(job_.count(Severity::kWarning), 0u);
  std::set<std::string> given;
  for (const Case& c : base->cases()) given.insert(c.id);
  std::size_t expected = 0;
  for (const auto& ids : acknowledged) {
    expected += ids.size();
    EXPECT_TRUE(std::includes(given.begin(), given.end(), ids.begin(), ids.end()));
  }
  EXPECT_GT(expected, 0u);
}

TEST_F(ServerStore, TakesEightWritersWhileTheServerIsAway) {
  fill(place_->uri(), {sample()});
  down();
  constexpr std::size_t kWriters = 8, kEach = 5;
  std::vector<std::string> faults(kWriters);
  std::vector<std::thread> writers;
  const std::vector<Case> cases = random_cases(kWriters * kEach, 61);
  for (std::size_t w = 0; w < kWriters; ++w) {
    writers.emplace_back([&, w] {
      Job job;
      auto mine = CaseBase::open(place_->uri(), job);
      for (std::size_t i = 0; i < kEach && mine; ++i) {
        if (const Status s = mine->add(cases[w * kEach + i]); !s) faults[w] = to_text(s.error());
      }
      if (!mine) faults[w] = to_text(mine.error());
    });
  }
  for (std::thread& t : writers) t.join();
  EXPECT_EQ(faults, std::vector<std::string>(kWriters));
  EXPECT_EQ(open()->size(), cases.size() + 1);
  ASSERT_TRUE(up());
  EXPECT_EQ(open()->size(), cases.size() + 1);
}

TEST_F(ServerStore, AcknowledgesNothingToOneWhoMissedThatTheServerCameBack) {
  fill(place_->uri(), {sample()});
  down();
  auto away = open().value();
  ASSERT_TRUE(away.add(sample(11.0)).has_value());
  ASSERT_TRUE(up());
  EXPECT_EQ(open()->size(), 2u);
  down();
  EXPECT_EQ(away.add(sample(12.0)).error().code, "CASE-BUSY");
  auto again = open().value();
  EXPECT_TRUE(again.add(sample(12.0)).has_value());
  EXPECT_EQ(again.size(), 3u);
}

TEST_F(ServerStore, KeepsTheCopyOfABaseThatWasDamagedAndRenewsOneThatIsNot) {
  fill(place_->uri(), random_cases(20, 5));
  const std::vector<Case> cases = open()->cases();
  place_->sql("UPDATE capstan.head SET head = set_bit(head, 9, 1 - get_bit(head, 9)) WHERE number = 3");
  EXPECT_EQ(open()->size(), cases.size() - 1);
  EXPECT_NE(job_.count(Severity::kWarning), 0u);
  down();
  EXPECT_EQ(open()->cases(), cases);
  ASSERT_TRUE(up());
  // The copy is altered: the next opening makes it again.
  place_->sql("UPDATE capstan.head SET head = set_bit(head, 9, 1 - get_bit(head, 9)) WHERE number = 3");
  tamper(files().copy, "UPDATE capstan_head SET head = x'00' WHERE number = 2");
  EXPECT_EQ(open()->cases(), cases);
  down();
  EXPECT_EQ(open()->cases(), cases);
  EXPECT_EQ(codes(), std::vector<std::string>{"CASE-OFFLINE"});
}

TEST_F(ServerStore, BelievesNothingAlteredInTheOutboxAndKeepsItAside) {
  fill(place_->uri(), {sample(10.0)});
  down();
  {
    auto base = open().value();
    ASSERT_TRUE(base.add(std::vector{sample(11.0), sample(12.0)}).has_value());
  }
  tamper(files().outbox, "UPDATE capstan_body SET body = CAST(body || x'00' AS BLOB) WHERE number = 1");
  std::vector<Case> unaltered = {sample(10.0), sample(12.0)};
  std::sort(unaltered.begin(), unaltered.end(), [](const Case& a, const Case& b) { return a.id < b.id; });
  EXPECT_EQ(open()->cases(), unaltered);
  ASSERT_TRUE(up());
  const std::vector<Case> sent = open()->cases();
  EXPECT_EQ(codes(), (std::vector<std::string>{"CASE-DAMAGED", "CASE-OUTBOX"}));
  EXPECT_EQ(sent, unaltered);
  EXPECT_FALSE(std::filesystem::exists(files().outbox));
  EXPECT_TRUE(std::filesystem::exists(files().outbox + ".damaged-1"));
}

TEST_F(ServerStore, IsWholeAfterAWriterToTheOutboxWasKilled) {
  fill(place_->uri(), {});
  down();
  constexpr std::size_t kOffline = 1;  // the warning of each opening
  const std::size_t kept = expect_whole_after_killed_writers(place_->uri(), kOffline);
  ASSERT_TRUE(up());
  EXPECT_EQ(open()->size(), kept);
}

}  // namespace
}  // namespace capstan::casebase
