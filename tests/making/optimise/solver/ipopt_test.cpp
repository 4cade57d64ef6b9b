// Ipopt's library where it is not there, and where it is and fails.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "planner/ground/base/loading/library.h"
#include "planner/making/optimise/solver/ipopt/library.h"
#include "planner/making/optimise/solver/solver.h"
#include "tests/making/optimise/examples.h"
#include "tests/making/optimise/solver/false_ipopt.h"

namespace capstan::optimise {
namespace {

using testing::HasSubstr;
using Fault = FalseIpopt::Fault;

constexpr const char* kNone = "libcapstan_has_none.so.1";

// IpReturnCodes_inc.h
constexpr int kSucceeded = 0, kNotEnoughDegreesOfFreedom = -10, kInvalidProblemDefinition = -11,
              kInvalidOption = -12, kUnrecoverableException = -100, kNonIpoptExceptionThrown = -101,
              kInsufficientMemory = -102, kInternalError = -199;

const std::vector<double> kStart = {0.25, 0.75};

Result<std::vector<double>> run_by(const std::string& library, const Problem& problem) {
  Job job;
  Evaluator evaluator(problem, job, 1e-6);
  evaluator.allow_until(100);
  return solve_with_ipopt_of(library, evaluator, Attempt{.start = kStart, .max_evaluations = 100});
}

Result<std::vector<double>> by_none(Evaluator& evaluator, const Attempt& attempt) {
  return solve_with_ipopt_of(kNone, evaluator, attempt);
}

TEST(IpoptLibrary, ThatIsNotThereIsNamedWithWhatToInstall) {
  Options o;
  o.solver = Solver::kIpopt;
  o.backends[Solver::kIpopt] = &by_none;
  Job job;
  const auto s = solve(examples::projected_point(), o, job);
  ASSERT_FALSE(s);
  EXPECT_EQ(s.error().code, "OPT-BACKEND-ABSENT");
  EXPECT_THAT(s.error().message, HasSubstr("Ipopt"));
  EXPECT_THAT(s.error().hint, HasSubstr("coinor-libipopt"));
}

/// A library that fails as it is told.
class FalseLibrary : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "false_ipopt.so";
    if (!std::filesystem::exists(path_)) GTEST_SKIP() << "built without Ipopt";
    const auto library = Library::open(path_);
    ASSERT_TRUE(library) << to_text(library.error());
    ASSERT_TRUE(library->take("capstan_false_ipopt", told_));
    *told_ = {};
  }
  Result<std::vector<double>> run(const FalseIpopt& as) {
    *told_ = as;
    return run_by(path_, examples::projected_point());
  }
  /// The code of the fault; empty: a point was given.
  std::string code(const FalseIpopt& as) {
    const auto u = run(as);
    return u ? "" : u.error().code;
  }

  std::string path_;
  FalseIpopt* told_ = nullptr;
};

TEST_F(FalseLibrary, GivesThePointThatARunEndedAtWhateverItsStatus) {
  for (const int status :
       {kSucceeded, kUnrecoverableException, kNonIpoptExceptionThrown, kInsufficientMemory, kInternalError}) {
    const auto u = run({.status = status});
    ASSERT_TRUE(u) << status << to_text(u.error());
    EXPECT_EQ(*u, kStart);
  }
}

TEST_F(FalseLibrary, ThatRefusesProblemOrOptionsIsAFaultAndNoAnswer) {
  for (const Fault fault : {Fault::kNoProblem, Fault::kNoOption, Fault::kNoCallback})
    EXPECT_EQ(code({.fault = fault}), "OPT-IPOPT") << static_cast<int>(fault);
  for (const bool asks : {false, true})
    for (const int status : {kInvalidOption, kInvalidProblemDefinition})
      EXPECT_EQ(code({.asks = asks, .status = status}), "OPT-IPOPT") << status;
}

TEST_F(FalseLibrary, ThatFailsBeforeItAsksForAPointIsAFaultAndNoAnswer) {
  for (const int status : {kUnrecoverableException, kNonIpoptExceptionThrown, kInsufficientMemory,
                           kInternalError, kNotEnoughDegreesOfFreedom, kSucceeded}) {
    const auto u = run({.asks = false, .status = status});
    ASSERT_FALSE(u) << status;
    EXPECT_EQ(u.error().code, "OPT-IPOPT");
    EXPECT_THAT(u.error().message, HasSubstr(std::to_string(status)));
  }
}

TEST_F(FalseLibrary, LetsNoExceptionOfItsOwnOut) {
  for (const Fault fault : {Fault::kThrowsAtProblem, Fault::kThrowsAtOption})
    EXPECT_EQ(code({.fault = fault}), "OPT-IPOPT") << static_cast<int>(fault);
  EXPECT_EQ(code({.fault = Fault::kThrowsAtSolving, .asks = false}), "OPT-IPOPT");
  EXPECT_EQ(code({.fault = Fault::kThrowsAtSolving, .asks = true}), "");
}

TEST_F(FalseLibrary, HidesNoExceptionOfTheModelBehindAStatus) {
  *told_ = {.status = kInvalidOption};
  Problem p = examples::projected_point();
  p.model = [](std::span<const double>, bool, Evaluation&) { throw std::runtime_error("the model"); };
  EXPECT_THROW(static_cast<void>(run_by(path_, p)), std::runtime_error);
}

}  // namespace
}  // namespace capstan::optimise
