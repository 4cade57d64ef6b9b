// The library for servers of PostgreSQL where it is missing, cannot be opened or is of another build. No
// server is needed.

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "casebase/casebase.h"
#include "casebase/store/local.h"
#include "casebase/store/postgres/postgres_library.h"
#include "casebase/store/server.h"
#include "planner/ground/base/loading/beside.h"
#include "tests/casebase/sample.h"

namespace capstan::casebase {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kNotThere = "/nonexistent/capstan-postgres.so";
constexpr const char* kAgain = "start it again";

std::string other_build() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "other_build.so";
}

Diagnostic fault_of(const std::vector<std::string>& places) {
  const auto connect = connector_of(places);
  return connect ? Diagnostic{} : connect.error();
}

TEST(PostgresLibrary, ThatIsNotThereIsAFaultOfTheInstallationAndNotOfTheUri) {
  const Diagnostic d = fault_of({kNotThere, "/nonexistent/too.so"});
  EXPECT_EQ(d.code, "CASE-LIBRARY");
  EXPECT_THAT(d.message, AllOf(HasSubstr(kNotThere), HasSubstr("/nonexistent/too.so")));
  EXPECT_THAT(d.hint, AllOf(HasSubstr("install Capstan with it"), HasSubstr(kAgain)));
}

TEST(PostgresLibrary, ThatCannotBeOpenedIsNamedWithWhatTheLoaderSays) {
  const Folder folder;
  const std::string file = folder.file("capstan-postgres.so");
  std::ofstream(file) << "no library";
  const Diagnostic d = fault_of({kNotThere, file});
  EXPECT_EQ(d.code, "CASE-LIBRARY");
  EXPECT_THAT(d.message, HasSubstr(file));
  EXPECT_THAT(d.hint, AllOf(HasSubstr("libpqxx-6.4"), HasSubstr(kAgain)));
}

TEST(PostgresLibrary, OfAnotherBuildIsRefusedWithTheIdentitiesOfBoth) {
  const Diagnostic d = fault_of({other_build()});
  EXPECT_EQ(d.code, "CASE-LIBRARY");
  EXPECT_THAT(d.message, AllOf(HasSubstr(other_build()), HasSubstr("0.0.1-of-another-build"),
                               testing::ContainsRegex("opens it \\([0-9.]+-[0-9a-f]{16}\\)")));
  EXPECT_THAT(d.hint, AllOf(HasSubstr("of one build"), HasSubstr(kAgain)));
}

TEST(PostgresLibrary, ThatStatesNoBuildIsRefused) {
  Dl_info sqlite{};  // any library that is not ours
  ASSERT_NE(dladdr(dlsym(RTLD_DEFAULT, "sqlite3_open"), &sqlite), 0);
  const Diagnostic d = fault_of({sqlite.dli_fname});
  EXPECT_EQ(d.code, "CASE-LIBRARY");
  EXPECT_THAT(d.message, HasSubstr("states none"));
}

TEST(PostgresLibrary, OfThisBuildIsTakenWhereOneOfAnotherComesFirst) {
  auto places = places_beside(kPostgresLibrary);
  if (std::none_of(places.begin(), places.end(), [](const auto& p) { return std::filesystem::exists(p); }))
    GTEST_SKIP() << "built without PostgreSQL";
  places.insert(places.begin(), other_build());
  const auto connect = connector_of(places);
  EXPECT_TRUE(connect) << to_text(connect.error());
}

/// A base on a server, on a machine that has no library for it.
class WithoutLibrary : public testing::Test {
 protected:
  void SetUp() override { setenv("CAPSTAN_CASES", beside_.path().c_str(), 1); }
  void TearDown() override { unsetenv("CAPSTAN_CASES"); }

  static Result<std::unique_ptr<Store>> no_library(const std::string&, Missing, Job&) {
    return fail(Diagnostic{.code = "CASE-LIBRARY", .message = "it is not there", .hint = "install it"});
  }
  static Result<std::unique_ptr<Store>> nobody(const std::string&, Missing, Job&) {
    return fail("CASE-OFFLINE", "nobody answers");
  }
  LocalFiles files() const { return local_files(name_of(kServer)).value(); }

  static constexpr const char* kServer = "postgresql://shop@away/cases";
  Folder beside_;
  Job job_;
};

TEST_F(WithoutLibrary, ABaseIsReadFromItsCopyAndTheWarningSaysSo) {
  fill(files().copy, random_cases(5, 3));
  const auto store = open_server(kServer, Missing::kRefuse, job_, &no_library);
  ASSERT_TRUE(store) << to_text(store.error());
  ASSERT_EQ(job_.diagnostics().size(), 1u);
  const Diagnostic& said = job_.diagnostics()[0];
  EXPECT_EQ(said.code, "CASE-LIBRARY");
  EXPECT_EQ(said.severity, Severity::kWarning);
  EXPECT_THAT(said.message,
              AllOf(HasSubstr("it is not there"), HasSubstr("local copy"), HasSubstr("5 rows")));
  EXPECT_THAT(said.hint, AllOf(HasSubstr("install it"), HasSubstr(files().outbox)));
  std::size_t heads = 0;
  const auto read = (*store)->read(0, [&](std::int64_t, std::string_view) -> Status {
    ++heads;
    return {};
  });
  EXPECT_TRUE(read);
  EXPECT_EQ(heads, 5u);
}

TEST_F(WithoutLibrary, NothingIsBegunForAServerThatWasNeverReached) {
  for (const Missing missing : {Missing::kRefuse, Missing::kCreate}) {
    const auto store = open_server(kServer, missing, job_, &no_library);
    ASSERT_FALSE(store);
    EXPECT_EQ(store.error().code, "CASE-LIBRARY");
    EXPECT_EQ(store.error().hint, "install it");
  }
  EXPECT_EQ(open_server(kServer, Missing::kRefuse, job_, &nobody).error().code, "CASE-OPEN");
  EXPECT_FALSE(std::filesystem::exists(files().outbox));
  EXPECT_TRUE(job_.diagnostics().empty());
}

}  // namespace
}  // namespace capstan::casebase
