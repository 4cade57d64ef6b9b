#include "casebase/store/local.h"
#include "tests/casebase/postgres.h"
#include "tests/casebase/sample.h"

namespace capstan::casebase {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A base on a server that is reached by TCP and asks for a password. What every store promises is tested of
/// it, too (contract_test.cpp).
class TcpStore : public testing::Test {
 protected:
  void SetUp() override {
    place_ = PostgresPlace::make(PostgresServer::Way::kTcp);
    if (!place_) GTEST_SKIP() << "there is no PostgreSQL on this machine";
  }
  Result<CaseBase> open(const std::string& password = "") {
    (void)job_.take_diagnostics();
    return CaseBase::open(place_->uri(password), job_);
  }
  std::unique_ptr<PostgresPlace> place_;
  Job job_;
};

TEST_F(TcpStore, IsNamedByHostAndPortAndIsNoSocket) {
  fill(place_->uri(), {sample()});
  const auto base = open();
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  EXPECT_EQ(base->cases(), std::vector{sample()});
  EXPECT_THAT(name_of(place_->uri()),
              testing::MatchesRegex("postgresql://shop@127.0.0.1:[0-9]+/cases[0-9]+"));
}

TEST_F(TcpStore, ThatRefusesThePasswordIsOneErrorWhetherThereIsACopyOrNot) {
  const std::string wrong = ":tr0ub4dor";
  for (const bool reached : {false, true}) {
    if (reached) {
      fill(place_->uri(), {sample()});
      ASSERT_TRUE(open().has_value());
      ASSERT_TRUE(std::filesystem::exists(local_files(name_of(place_->uri())).value().copy));
    }
    const auto base = open(wrong);
    ASSERT_FALSE(base.has_value());
    EXPECT_EQ(base.error().code, "CASE-OPEN");
    const std::string told = to_text(base.error());
    EXPECT_THAT(told, HasSubstr("password authentication failed for user \"shop\""));
    EXPECT_THAT(told, HasSubstr(name_of(place_->uri())));
    EXPECT_THAT(told, Not(HasSubstr(wrong.substr(1))));
    EXPECT_TRUE(job_.diagnostics().empty());
    // Nothing is taken that would wait for a server which is there.
    EXPECT_FALSE(CaseBase::open_or_create(place_->uri(wrong), job_).has_value());
    EXPECT_FALSE(std::filesystem::exists(local_files(name_of(place_->uri())).value().outbox));
  }
  const auto none = open(":");
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().code, "CASE-OPEN");
  EXPECT_THAT(none.error().message, HasSubstr("no password supplied"));
}

TEST_F(TcpStore, WhosePortIsClosedIsReadFromItsCopyAndWhatIsAddedWaits) {
  fill(place_->uri(), {sample(10.0)});
  ASSERT_TRUE(open().has_value());
  place_->server().stop(SIGINT);
  {
    auto base = open();
    ASSERT_TRUE(base.has_value()) << to_text(base.error());
    ASSERT_EQ(job_.diagnostics().size(), 1u);
    EXPECT_EQ(job_.diagnostics()[0].code, "CASE-OFFLINE");
    EXPECT_THAT(job_.diagnostics()[0].message, HasSubstr("Connection refused"));
    EXPECT_THAT(to_text(job_.diagnostics()[0]), Not(HasSubstr(PostgresServer::kPassword)));
    EXPECT_EQ(base->cases(), std::vector{sample(10.0)});
    ASSERT_TRUE(base->add(sample(11.0)).has_value());
  }
  ASSERT_TRUE(place_->server().start());
  EXPECT_EQ(open()->size(), 2u);
  ASSERT_EQ(job_.diagnostics().size(), 1u);
  EXPECT_EQ(job_.diagnostics()[0].code, "CASE-OUTBOX");
  EXPECT_EQ(place_->sql("SELECT count(*) FROM capstan.head"), "2");
}

TEST_F(TcpStore, WhosePortIsClosedAndThatWasNeverReachedIsOneError) {
  place_->server().stop(SIGINT);
  const auto base = open();
  ASSERT_TRUE(place_->server().start());
  ASSERT_FALSE(base.has_value());
  EXPECT_EQ(base.error().code, "CASE-OPEN");
  EXPECT_THAT(base.error().message, HasSubstr("Connection refused"));
  EXPECT_THAT(base.error().hint, HasSubstr("there is no local copy of it yet"));
  EXPECT_TRUE(job_.diagnostics().empty());
}

}  // namespace
}  // namespace capstan::casebase
