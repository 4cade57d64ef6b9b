#include "planner/files/exchange/brep/read_brep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "tests/files/exchange/brep/step_part.h"
#include "tests/files/exchange/brep/support.h"

// The caller, with programs in place of the helper: each of its ends is one clear fault, and none is left
// alive.

namespace capstan::exchange {
namespace {

using namespace std::chrono_literals;
using testing::children;
using ::testing::HasSubstr;
using testing::script;
using testing::StepPart;

std::string box() {
  StepPart part;
  part.product({part.box({0, 0, 0}, {1, 2, 3})}, part.context());
  return part.text();
}

class WithHelper : public ::testing::Test {
 protected:
  /// The fault of reading a box with this script for a helper.
  Diagnostic fault(const std::string& text, BrepLimits limits = {}) {
    limits.helper = script(folder_, text);
    const auto brep = read_brep_bytes(box(), "box.step", limits, job_);
    EXPECT_FALSE(brep);
    EXPECT_EQ(children(), 0U);
    if (brep) return {};
    EXPECT_EQ(brep.error().file, "box.step");
    EXPECT_FALSE(brep.error().message.empty());
    return brep.error();
  }
  capstan::testing::ScratchFolder folder_;
  Job job_;
};

TEST_F(WithHelper, AKilledOneIsACrash) {
  const auto d = fault("kill -KILL $$");
  EXPECT_EQ(d.code, "BREP-CRASH");
  EXPECT_THAT(d.message, HasSubstr("signal 9"));
  EXPECT_FALSE(d.hint.empty());
}
TEST_F(WithHelper, ASegmentationFaultIsACrash) { EXPECT_EQ(fault("kill -SEGV $$").code, "BREP-CRASH"); }
TEST_F(WithHelper, AHangingOneIsEnded) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(fault("exec sleep 60", {.wall_s = 1}).code, "BREP-TIME");
  EXPECT_LT(std::chrono::steady_clock::now() - start, 30s);
}
TEST_F(WithHelper, ABusyOneIsEnded) {
  const auto d = fault("while :; do :; done", {.processor_s = 1});
  EXPECT_EQ(d.code, "BREP-TIME");
  EXPECT_THAT(d.message, HasSubstr("1 s of processor time"));
}
TEST_F(WithHelper, AFloodIsEnded) {
  EXPECT_EQ(fault("exec yes", {.wall_s = 60, .message_bytes = 100'000}).code, "BREP-LIMIT");
}
TEST_F(WithHelper, SilenceIsRefused) { EXPECT_EQ(fault("exit 0").code, "BREP-MESSAGE"); }
TEST_F(WithHelper, NoiseIsRefused) { EXPECT_EQ(fault("echo hello").code, "BREP-MESSAGE"); }
TEST_F(WithHelper, AFailureIsToldWithItsWords) {
  const auto d = fault("echo no room >&2; exit 5");
  EXPECT_EQ(d.code, "BREP-CRASH");
  EXPECT_THAT(d.message, HasSubstr("no room"));
}
TEST_F(WithHelper, AMissingLibraryIsToldAsTheLoaderTellsIt) {
  const auto d = fault("echo 'libTKSTEP.so.7.6: cannot open shared object file' >&2; exit 127");
  EXPECT_EQ(d.code, "BREP-HELPER");
  EXPECT_THAT(d.message, HasSubstr("libTKSTEP.so.7.6"));
}
TEST_F(WithHelper, AStopEndsIt) {
  std::thread stopper([this] {
    std::this_thread::sleep_for(100ms);
    job_.request_stop();
  });
  const auto code = fault("exec sleep 60").code;
  stopper.join();
  EXPECT_EQ(code, "BREP-STOPPED");
}
TEST_F(WithHelper, ADeadlineEndsIt) {
  job_.set_deadline(std::chrono::steady_clock::now() + 200ms);
  EXPECT_EQ(fault("exec sleep 60").code, "BREP-STOPPED");
}

TEST(ReadBrep, AHelperThatIsNotThereIsNamedWithWhatToDo) {
  Job job;
  const auto brep = read_brep_bytes(box(), "box.step", {.helper = "/nonexistent/capstan-brep"}, job);
  ASSERT_FALSE(brep);
  EXPECT_EQ(brep.error().code, "BREP-HELPER");
  EXPECT_THAT(brep.error().message, HasSubstr("/nonexistent/capstan-brep"));
  EXPECT_THAT(brep.error().hint, HasSubstr("libocct-data-exchange-dev"));
}

TEST(ReadBrep, TheEnvironmentNamesTheHelper) {
  const capstan::testing::ScratchFolder folder;
  ASSERT_EQ(::setenv("CAPSTAN_BREP", script(folder, "kill -SEGV $$").c_str(), 1), 0);
  Job job;
  const auto brep = read_brep_bytes(box(), "box.step", {}, job);
  ::unsetenv("CAPSTAN_BREP");
  ASSERT_FALSE(brep);
  EXPECT_EQ(brep.error().code, "BREP-CRASH");
}

TEST(ReadBrep, FacesBeyondTheLimitAreRefusedBeforeTheHelperRuns) {
  Job job;
  const auto brep = read_brep_bytes(box(), "box.step", {.faces = 5, .helper = "/nonexistent"}, job);
  ASSERT_FALSE(brep);
  EXPECT_EQ(brep.error().code, "BREP-LIMIT");
  EXPECT_THAT(brep.error().message, HasSubstr("6 faces; at most 5"));
}

TEST(ReadBrep, WhatIsNoPart21FileNeverReachesTheHelper) {
  Job job;
  for (const std::string bytes : {"", "solid x", "ISO-10303-21;HEADER;"}) {
    const auto brep = read_brep_bytes(bytes, "x.step", {.helper = "/nonexistent"}, job);
    ASSERT_FALSE(brep);
    EXPECT_EQ(brep.error().code.substr(0, 4), "P21-") << bytes;
  }
}

}  // namespace
}  // namespace capstan::exchange
