#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "capstan/capstan_late.h"
#include "planner/files/json/json.h"
#include "tests/door/late/brought.h"

// Late binding through the interface for C.

namespace capstan::late {
namespace {

TEST(LateInterface, PastTheDeadlineTheCodeIsLateAndThePlanIsThere) {
  capstan_late* s = capstan_late_open("generic_vmc", kMagazine.c_str());
  ASSERT_EQ(capstan_late_status(s), CAPSTAN_LATE_OK) << capstan_late_message(s);
  const std::string text = testing::slurp(kPlate);
  EXPECT_EQ(capstan_late_bind(s, text.data(), text.size(), 0), CAPSTAN_LATE_LATE) << capstan_late_message(s);
  EXPECT_EQ(capstan_late_status(s), CAPSTAN_LATE_LATE);
  EXPECT_NE(std::string(capstan_late_message(s)).find("the deadline of 0 ms is past"), std::string::npos);
  EXPECT_NE(capstan_late_output(s, CAPSTAN_LATE_LINUXCNC, nullptr), nullptr);
  EXPECT_EQ(capstan_late_bind(s, text.data(), text.size(), 3600000), CAPSTAN_LATE_OK)
      << capstan_late_message(s);
  capstan_late_close(s);
}

TEST(LateInterface, AJsonPlanMayBeginWithAByteOrderMark) {
  capstan_late* session = capstan_late_open("generic_vmc", kMagazine.c_str());
  ASSERT_EQ(capstan_late_status(session), CAPSTAN_LATE_OK) << capstan_late_message(session);
  const std::string json = "\xEF\xBB\xBF" + json::write_json(plate());
  EXPECT_EQ(capstan_late_bind(session, json.data(), json.size(), 600000), CAPSTAN_LATE_OK)
      << capstan_late_message(session);
  EXPECT_NE(capstan_late_output(session, CAPSTAN_LATE_LINUXCNC, nullptr), nullptr);
  capstan_late_close(session);
}

TEST(LateInterface, TakesOptionsByTheirNames) {
  EXPECT_EQ(capstan_late_interface(), 9U);
  capstan_late* session = capstan_late_create();
  ASSERT_NE(session, nullptr);
  EXPECT_EQ(capstan_late_set(session, "machine", "generic_vmc"), CAPSTAN_LATE_OK);
  EXPECT_EQ(capstan_late_set(session, "tools", kMagazine.c_str()), CAPSTAN_LATE_OK);
  EXPECT_EQ(capstan_late_set(session, "general-tolerance", "ISO 2768-m"), CAPSTAN_LATE_OK);
  EXPECT_EQ(capstan_late_set(session, "may", "tools,feeds,depths,strategy,order"), CAPSTAN_LATE_OK);
  EXPECT_EQ(capstan_late_set(session, "may", "speeds"), CAPSTAN_LATE_USAGE);
  EXPECT_EQ(capstan_late_set(session, "time", "2026-11-25T12:00:00Z"), CAPSTAN_LATE_OK);
  EXPECT_EQ(capstan_late_set(session, "colour", "red"), CAPSTAN_LATE_USAGE);
  EXPECT_EQ(capstan_late_set(session, "margin", "wild"), CAPSTAN_LATE_USAGE);
  EXPECT_NE(std::string(capstan_late_message(session)).find("margin"), std::string::npos);
  EXPECT_EQ(capstan_late_prepare(session), CAPSTAN_LATE_OK) << capstan_late_message(session);
  const std::string text = testing::slurp(kPlate);
  EXPECT_EQ(capstan_late_bind(session, text.data(), text.size(), 600000), CAPSTAN_LATE_OK)
      << capstan_late_message(session);
  const std::string told = capstan_late_changes(session);
  EXPECT_NE(told.find("Time of the steps"), std::string::npos) << told;
  const std::string json = capstan_late_output_as(session, "json", nullptr);
  EXPECT_TRUE(json.find("ISO 2768-m") != std::string::npos);
  EXPECT_TRUE(json.find("2026-11-25T12:00:00Z") != std::string::npos);
  EXPECT_STREQ(capstan_late_output_as(session, "linuxcnc", nullptr),
               capstan_late_output(session, CAPSTAN_LATE_LINUXCNC, nullptr));
  EXPECT_EQ(capstan_late_output_as(session, "no such format", nullptr), nullptr);
  EXPECT_EQ(capstan_late_set(session, "workholding", "no_such_fixture"), CAPSTAN_LATE_OK);
  EXPECT_EQ(capstan_late_bind(session, text.data(), text.size(), 600000), CAPSTAN_LATE_UNREADABLE);
  capstan_late_close(session);
}

TEST(LateInterface, TellsProgressAndEndsWhenItIsStopped) {
  struct Seen {
    capstan_late* session;
    int calls = 0;
  } seen{capstan_late_open("generic_vmc", kMagazine.c_str())};
  capstan_late_on_progress(
      seen.session,
      [](const char* stage, double fraction, void* user) {
        auto* s = static_cast<Seen*>(user);
        EXPECT_STRNE(stage, "");
        EXPECT_GE(fraction, 0.0);
        ++s->calls;
        capstan_late_stop(s->session);
      },
      &seen);
  const std::string text = testing::slurp(kPlate);
  // Nothing is given that was not checked to its end.
  EXPECT_EQ(capstan_late_bind(seen.session, text.data(), text.size(), 600000), CAPSTAN_LATE_IMPOSSIBLE);
  EXPECT_EQ(capstan_late_output(seen.session, CAPSTAN_LATE_LINUXCNC, nullptr), nullptr);
  EXPECT_GT(seen.calls, 0);
  // A stop is of one call.
  capstan_late_on_progress(seen.session, nullptr, nullptr);
  EXPECT_EQ(capstan_late_bind(seen.session, text.data(), text.size(), 600000), CAPSTAN_LATE_OK)
      << capstan_late_message(seen.session);
  capstan_late_close(seen.session);
}

TEST(LateInterface, TellsWhatIsOpenBeforeAndAfterABind) {
  capstan_late* s = capstan_late_open("generic_vmc", kMagazine.c_str());
  EXPECT_EQ(capstan_late_left_open(s), nullptr);
  EXPECT_EQ(capstan_late_left_open(nullptr), nullptr);
  const std::string text = testing::slurp(kPlate);
  ASSERT_EQ(capstan_late_take(s, text.data(), text.size()), CAPSTAN_LATE_OK) << capstan_late_message(s);
  // The plate's file leaves feed and speed of one technology open, and nothing else.
  const std::string open = capstan_late_left_open(s);
  EXPECT_EQ(std::count(open.begin(), open.end(), '\n'), 2) << open;
  EXPECT_NE(open.find("MILLING_TECHNOLOGY"), std::string::npos) << open;
  EXPECT_NE(open.find(", step 'DRILL PLAIN HOLE'"), std::string::npos) << open;
  ASSERT_EQ(capstan_late_bind_next(s, nullptr, 0, 1, 5, 600000), CAPSTAN_LATE_OK) << capstan_late_message(s);
  EXPECT_STREQ(capstan_late_left_open(s), "");
  capstan_late_close(s);
}

TEST(LateInterface, TellsOfALateBindWhatWasOpenBeforeIt) {
  capstan_late* s = capstan_late_open("generic_vmc", kMagazine.c_str());
  const std::string text = testing::slurp(kPlate);
  ASSERT_EQ(capstan_late_take(s, text.data(), text.size()), CAPSTAN_LATE_OK) << capstan_late_message(s);
  const std::string open = capstan_late_left_open(s);
  ASSERT_EQ(capstan_late_bind_next(s, nullptr, 0, 1, 5, 0), CAPSTAN_LATE_LATE) << capstan_late_message(s);
  EXPECT_EQ(capstan_late_left_open(s), open);
  capstan_late_close(s);
}

// Once it went on with the plan that was bound in part before.
TEST(LateInterface, GoesOnWithThePlanThatWasTakenLast) {
  const auto results = [](capstan_late* s) {
    const std::string json = capstan_late_output(s, CAPSTAN_LATE_JSON, nullptr);
    std::size_t n = 0;
    for (auto at = json.find("\"cutter_id\""); at != std::string::npos;
         at = json.find("\"cutter_id\"", at + 1))
      ++n;
    return n;
  };
  capstan_late* s = capstan_late_open("generic_vmc", kMagazine.c_str());
  const std::string text = testing::slurp(kPlate);
  ASSERT_EQ(capstan_late_take(s, text.data(), text.size()), CAPSTAN_LATE_OK) << capstan_late_message(s);
  const std::string open = capstan_late_left_open(s);
  for (const std::size_t bound : {1U, 2U}) {
    ASSERT_EQ(capstan_late_bind_next(s, nullptr, 0, 0, 1, 600000), CAPSTAN_LATE_OK)
        << capstan_late_message(s);
    EXPECT_EQ(results(s), bound);
  }
  ASSERT_EQ(capstan_late_take(s, text.data(), text.size()), CAPSTAN_LATE_OK) << capstan_late_message(s);
  EXPECT_EQ(capstan_late_left_open(s), open);
  ASSERT_EQ(capstan_late_bind_next(s, nullptr, 0, 0, 1, 600000), CAPSTAN_LATE_OK) << capstan_late_message(s);
  EXPECT_EQ(results(s), 1U);
  // What cannot be read is no plan, and nothing goes on behind it.
  EXPECT_NE(capstan_late_take(s, "x", 1), CAPSTAN_LATE_OK);
  EXPECT_EQ(capstan_late_left_open(s), nullptr);
  EXPECT_EQ(capstan_late_bind_next(s, nullptr, 0, 0, 1, 600000), CAPSTAN_LATE_USAGE);
  capstan_late_close(s);
}

TEST(LateInterface, SaysWhatIsWrongAndNeverThrows) {
  EXPECT_EQ(capstan_late_bind(nullptr, "x", 1, 10), CAPSTAN_LATE_USAGE);
  EXPECT_EQ(capstan_late_output(nullptr, CAPSTAN_LATE_JSON, nullptr), nullptr);
  EXPECT_EQ(capstan_late_changes(nullptr), nullptr);
  capstan_late* broken = capstan_late_open("no such machine", kMagazine.c_str());
  ASSERT_NE(broken, nullptr);
  EXPECT_EQ(capstan_late_status(broken), CAPSTAN_LATE_UNREADABLE);
  EXPECT_NE(std::string(capstan_late_message(broken)).find("no such machine"), std::string::npos);
  EXPECT_EQ(capstan_late_bind(broken, "x", 1, 10), CAPSTAN_LATE_USAGE);
  capstan_late_close(broken);
  capstan_late* open = capstan_late_open("generic_vmc", kMagazine.c_str());
  EXPECT_EQ(capstan_late_status(open), CAPSTAN_LATE_OK) << capstan_late_message(open);
  EXPECT_EQ(capstan_late_bind(open, "not a plan", 10, 10), CAPSTAN_LATE_UNREADABLE);
  EXPECT_EQ(capstan_late_output(open, CAPSTAN_LATE_JSON, nullptr), nullptr);
  capstan_late_close(open);
  capstan_late_close(nullptr);
}

}  // namespace
}  // namespace capstan::late
