// What every transport of late binding owes its caller: the same questions, through the C interface and
// through `capstan serve`, with the same codes, the same words and the same bytes.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "capstan/capstan_late.h"
#include "planner/door/transport/serve/wire/http.h"
#include "tests/door/transport/serve/running_server.h"

namespace capstan::transport {
namespace {

/// One session, through whatever door.
class Door {
 public:
  virtual ~Door() = default;
  struct Answer {
    int code = -1;
    std::string message;
    friend bool operator==(const Answer&, const Answer&) = default;
  };
  virtual Answer open(const std::string& machine, const std::string& tools) = 0;
  virtual Answer set(const std::string& option, const std::string& value) = 0;
  virtual Answer tell_tools(const std::string& states) = 0;
  virtual Answer bind(const std::string& plan, unsigned deadline_ms) = 0;
  /// The next workingsteps of a plan; an empty one: that of the last bind.
  virtual Answer next(const std::string& plan, unsigned from, unsigned count, unsigned deadline_ms) = 0;
  virtual std::string output(const std::string& format) = 0;  ///< empty: none
  virtual std::string changes() = 0;
  virtual double machining_s() = 0;
};

std::ostream& operator<<(std::ostream& out, const Door::Answer& a) {
  return out << a.code << ": " << a.message;
}

class ThroughC : public Door {
 public:
  ~ThroughC() override { capstan_late_close(session_); }
  Answer open(const std::string& machine, const std::string& tools) override {
    capstan_late_close(session_);
    session_ = capstan_late_open(machine.c_str(), tools.c_str());
    return answer();
  }
  Answer set(const std::string& option, const std::string& value) override {
    if (capstan_late_set(session_, option.c_str(), value.c_str()) == CAPSTAN_LATE_OK)
      capstan_late_prepare(session_);
    return answer();
  }
  Answer tell_tools(const std::string& states) override {
    if (capstan_late_tool_state(session_, states.data(), states.size()) == CAPSTAN_LATE_OK)
      capstan_late_prepare(session_);
    return answer();
  }
  Answer bind(const std::string& plan, unsigned deadline_ms) override {
    capstan_late_bind(session_, plan.data(), plan.size(), deadline_ms);
    return answer();
  }
  Answer next(const std::string& plan, unsigned from, unsigned count, unsigned deadline_ms) override {
    capstan_late_bind_next(session_, plan.empty() ? nullptr : plan.data(), plan.size(), from, count,
                           deadline_ms);
    return answer();
  }
  std::string output(const std::string& format) override {
    std::size_t size = 0;
    const char* text = capstan_late_output_as(session_, format.c_str(), &size);
    return text == nullptr ? std::string() : std::string(text, size);
  }
  std::string changes() override {
    const char* text = capstan_late_changes(session_);
    return text == nullptr ? "none" : text;
  }
  double machining_s() override { return capstan_late_machining_seconds(session_); }

 private:
  Answer answer() const { return {capstan_late_status(session_), capstan_late_message(session_)}; }
  capstan_late* session_ = nullptr;
};

class ThroughHttp : public Door {
 public:
  Answer open(const std::string& machine, const std::string& tools) override {
    const nlohmann::json state = {{"options", {{"machine", machine}, {"tools", tools}}}};
    const auto reply = client_.ask("POST", "/v1/sessions", state.dump());
    if (reply.status == 201) path_ = "/v1/sessions/" + reply.json()["session"].get<std::string>();
    return answer(reply);
  }
  Answer set(const std::string& option, const std::string& value) override {
    const nlohmann::json state = {{"options", {{option, value}}}};
    return answer(client_.ask("PUT", path_ + "/state", state.dump()));
  }
  Answer tell_tools(const std::string& states) override {
    return answer(client_.ask("PUT", path_ + "/state", nlohmann::json{{"tool_state", states}}.dump()));
  }
  Answer bind(const std::string& plan, unsigned deadline_ms) override {
    return bound(plan, {{"deadline_ms", deadline_ms}});
  }
  Answer next(const std::string& plan, unsigned from, unsigned count, unsigned deadline_ms) override {
    // What reading the plan said stands in the answer to PUT.
    const std::string read = plan.empty() ? std::string() : put(plan).message;
    const Answer answer = bound({}, {{"deadline_ms", deadline_ms}, {"from", from}, {"next", count}});
    return {answer.code, read + answer.message};
  }
  std::string output(const std::string& format) override {
    const auto reply = client_.ask("GET", path_ + "/output/" + format);
    return reply.status == 200 ? reply.body : std::string();
  }
  std::string changes() override {
    const auto reply = client_.ask("GET", path_ + "/changes");
    return reply.status == 200 ? reply.body : "none";
  }
  double machining_s() override { return last_.value("machining_s", 0.0); }

 private:
  Answer put(const std::string& plan) { return answer(client_.ask("PUT", path_ + "/plan", plan)); }
  Answer bound(const std::string& plan, const nlohmann::json& asked) {
    if (!plan.empty()) {
      const Answer brought = put(plan);
      if (brought.code != CAPSTAN_LATE_OK) return brought;
    }
    last_ = client_.ask("POST", path_ + "/bind", asked.dump()).json();
    return {last_["code"], last_["message"]};
  }
  static Answer answer(const Client::Reply& reply) {
    const auto json = reply.json();
    return {json.value("code", -1), json.value("message", "")};
  }
  RunningServer server_;
  Client client_{server_.socket()};
  std::string path_;
  nlohmann::json last_ = nlohmann::json::object();
};

/// A transport by its name.
struct Way {
  const char* name;
  std::unique_ptr<Door> (*door)();
};
void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }
const Way kC{"C", [] { return std::unique_ptr<Door>(new ThroughC); }};
const Way kHttp{"Http", [] { return std::unique_ptr<Door>(new ThroughHttp); }};

class Contract : public ::testing::TestWithParam<Way> {
 protected:
  void SetUp() override {
    if (std::string(GetParam().name) == "Http" && !http_is_built()) GTEST_SKIP() << "no Boost.Beast";
    door = GetParam().door();
  }
  std::unique_ptr<Door> door;
};

TEST_P(Contract, BindsAPlanAndGivesItInEveryFormat) {
  ASSERT_EQ(door->open("generic_vmc", magazine_file()).code, CAPSTAN_LATE_OK);
  const auto bound = door->bind(plate(), 600'000);
  EXPECT_EQ(bound.code, CAPSTAN_LATE_OK) << bound.message;
  EXPECT_GT(door->machining_s(), 0.0);
  for (const char* format : {"iso14649", "ap238", "json", "linuxcnc", "linuxcnc_tools"})
    EXPECT_NE(door->output(format), "") << format;
  EXPECT_EQ(door->output("no_such_format"), "");
  EXPECT_NE(door->changes().find("Time of the steps"), std::string::npos);
}

TEST_P(Contract, PastTheDeadlineItIsLateAndThePlanIsThere) {
  ASSERT_EQ(door->open("generic_vmc", magazine_file()).code, CAPSTAN_LATE_OK);
  const auto bound = door->bind(plate(), 0);
  EXPECT_EQ(bound.code, CAPSTAN_LATE_LATE) << bound.message;
  EXPECT_NE(door->output("linuxcnc"), "");
}

TEST_P(Contract, SaysWhatIsWrongAndGivesNothing) {
  EXPECT_EQ(door->open("no such machine", magazine_file()).code, CAPSTAN_LATE_UNREADABLE);
  ASSERT_EQ(door->open("generic_vmc", magazine_file()).code, CAPSTAN_LATE_OK);
  EXPECT_EQ(door->set("colour", "red").code, CAPSTAN_LATE_USAGE);
  EXPECT_EQ(door->set("margin", "wild").code, CAPSTAN_LATE_USAGE);
  const auto unread = door->bind("not a plan", 1000);
  EXPECT_EQ(unread.code, CAPSTAN_LATE_UNREADABLE);
  EXPECT_NE(unread.message, "");
  EXPECT_EQ(door->output("json"), "");
  EXPECT_EQ(door->changes(), "none");
}

TEST_P(Contract, BindsWorkingstepByWorkingstep) {
  ASSERT_EQ(door->open("generic_vmc", magazine_file()).code, CAPSTAN_LATE_OK);
  const auto first = door->next(plate(), 0, 1, 600'000);
  ASSERT_EQ(first.code, CAPSTAN_LATE_OK) << first.message;
  const std::string program = door->output("linuxcnc");
  EXPECT_NE(program, "");
  const auto second = door->next("", 2, 1, 600'000);
  ASSERT_EQ(second.code, CAPSTAN_LATE_OK) << second.message;
  EXPECT_NE(door->output("linuxcnc"), program);
}

TEST_P(Contract, StopsWithoutTheToolsThatAPlanNeeds) {
  ASSERT_EQ(door->open("generic_vmc", testing::source_dir() + "/tests/door/late/one_tool.tbl").code,
            CAPSTAN_LATE_OK);
  EXPECT_EQ(door->bind(plate(), 600'000).code, CAPSTAN_LATE_IMPOSSIBLE);
  EXPECT_EQ(door->output("linuxcnc"), "");
}

TEST_P(Contract, TakesWhatBecameOfTheToolsAndChangesNothingWhereItIsWrong) {
  ASSERT_EQ(door->open("generic_vmc", magazine_file()).code, CAPSTAN_LATE_OK);
  ASSERT_EQ(door->bind(plate(), 600'000).code, CAPSTAN_LATE_OK);
  const std::string program = door->output("linuxcnc");
  const auto wrong = door->tell_tools("T5 broken\nT8 wear nan\n");
  EXPECT_EQ(wrong.code, CAPSTAN_LATE_USAGE);
  EXPECT_NE(wrong.message.find("tool-state:2"), std::string::npos) << wrong.message;
  EXPECT_EQ(door->output("linuxcnc"), program);
  // The plate's hole is reamed by T5, which nothing replaces.
  ASSERT_EQ(door->tell_tools("T5 broken\n").code, CAPSTAN_LATE_OK);
  EXPECT_EQ(door->output("linuxcnc"), "");
  const auto bound = door->bind(plate(), 600'000);
  EXPECT_EQ(bound.code, CAPSTAN_LATE_IMPOSSIBLE);
  EXPECT_NE(bound.message.find("T5 (is broken)"), std::string::npos) << bound.message;
  ASSERT_EQ(door->tell_tools("").code, CAPSTAN_LATE_OK);
  ASSERT_EQ(door->bind(plate(), 600'000).code, CAPSTAN_LATE_OK);
  EXPECT_EQ(door->output("linuxcnc"), program);
}

INSTANTIATE_TEST_SUITE_P(Transports, Contract, ::testing::Values(kC, kHttp),
                         [](const auto& way) { return std::string(way.param.name); });

TEST(ContractOfBoth, TheSameQuestionsGetTheSameWordsAndBytes) {
  if (!http_is_built()) GTEST_SKIP() << "no Boost.Beast";
  ThroughC c;
  ThroughHttp http;
  const auto both = [&](const std::function<Door::Answer(Door&)>& question) {
    const auto one = question(c);
    EXPECT_EQ(one, question(http));
    return one.code;
  };
  both([](Door& d) { return d.open("generic_vmc", magazine_file()); });
  both([](Door& d) { return d.set("margin", "wild"); });
  both([](Door& d) { return d.set("may", "feeds"); });
  both([](Door& d) { return d.set("time", "2026-11-25T12:00:00Z"); });
  both([](Door& d) { return d.bind("ISO-10303-21;", 1000); });
  both([](Door& d) { return d.bind(plate(), 600'000); });
  both([](Door& d) { return d.set("may", "all"); });
  ASSERT_EQ(both([](Door& d) { return d.bind(plate(), 600'000); }), CAPSTAN_LATE_OK);
  for (const char* format : {"iso14649", "ap238", "json", "linuxcnc", "linuxcnc_tools"})
    EXPECT_EQ(c.output(format), http.output(format)) << format;
  EXPECT_EQ(c.changes(), http.changes());
  ASSERT_EQ(both([](Door& d) { return d.next(plate(), 0, 2, 600'000); }), CAPSTAN_LATE_OK);
  EXPECT_EQ(c.output("linuxcnc"), http.output("linuxcnc"));
  EXPECT_EQ(c.machining_s(), http.machining_s());
}

}  // namespace
}  // namespace capstan::transport
