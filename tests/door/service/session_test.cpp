#include "planner/door/service/session.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "planner/door/service/options.h"
#include "tests/support/corpus.h"

namespace capstan::service {
namespace {

const std::string kSource = capstan::testing::source_dir();

/// A whole transport, as another program might speak to a session over a pipe. A line asks, a line answers:
///
///     set NAME VALUE          -> CODE
///     bind MILLISECONDS SIZE  -> CODE, after SIZE bytes of the plan
///     output FORMAT           -> SIZE, and that many bytes
///     message                 -> SIZE, and that many bytes
void serve_lines(std::istream& in, std::ostream& out) {
  Session session;
  const auto sized = [&](const std::string& text) { out << text.size() << "\n" << text; };
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string what, name;
    words >> what;
    if (what == "set") {
      std::string value;
      words >> name >> std::ws;
      std::getline(words, value);
      out << static_cast<int>(session.set(name, value)) << "\n";
    } else if (what == "bind") {
      long milliseconds = 0;
      std::size_t size = 0;
      words >> milliseconds >> size;
      std::string plan(size, '\0');
      in.read(plan.data(), static_cast<std::streamsize>(size));
      out << static_cast<int>(session.bind(std::move(plan), std::chrono::milliseconds(milliseconds))) << "\n";
    } else if (what == "output") {
      words >> name;
      const std::string* text = session.output(name);
      sized(text == nullptr ? std::string() : *text);
    } else if (what == "message") {
      sized(session.message());
    }
  }
}

TEST(Session, ATransportOfLinesIsOneFunctionOverIt) {
  const std::string plan = testing::slurp(kSource + "/examples/plate_bound.p21");
  std::istringstream in("set machine generic_vmc\nset tools " + kSource +
                        "/tests/door/late/magazine.tbl\nset margin wild\nbind 600000 " +
                        std::to_string(plan.size()) + "\n" + plan + "output linuxcnc\n");
  std::ostringstream out;
  serve_lines(in, out);
  std::istringstream said(out.str());
  int machine = -1, tools = -1, margin = -1, bound = -1;
  std::size_t size = 0;
  said >> machine >> tools >> margin >> bound >> size;
  EXPECT_EQ(machine, 0);
  EXPECT_EQ(tools, 0);
  EXPECT_EQ(margin, static_cast<int>(Code::kUsage));
  EXPECT_EQ(bound, 0);
  EXPECT_GT(size, 100U);
  const std::string text = out.str();
  ASSERT_GT(text.size(), size);
  EXPECT_EQ(text.substr(text.size() - size, 17), "(CAPSTAN PROGRAM ");
}

TEST(Session, TakesTheShopsSettingsWhereAnOptionIsNotSet) {
  const capstan::testing::ScratchFolder scratch;
  const std::string shop = scratch.file("shop.yaml");
  const auto settings = [&](const std::string& text) {
    std::ofstream(shop, std::ios::trunc) << "capstan_shop: 1\n" << text;
  };
  settings("machine: small_router\nmargin: careful\n");
  const std::string plan = testing::slurp(kSource + "/examples/plate_bound.p21");
  Session s;
  ASSERT_EQ(s.set("shop", shop), Code::kDone);
  ASSERT_EQ(s.set("tools", kSource + "/tests/door/late/magazine.tbl"), Code::kDone);
  ASSERT_EQ(s.open(), Code::kDone) << s.message();
  ASSERT_EQ(s.set("threads", "1"), Code::kDone) << "an option of one call keeps the settings";
  // Its spindle turns too fast for the plan's drills.
  EXPECT_NE(s.bind(plan, std::nullopt), Code::kDone);
  EXPECT_NE(s.message().find("machine 'small_router'"), std::string::npos) << s.message();
  // An option that is set wins; settings that are wrong are named.
  ASSERT_EQ(s.set("machine", "generic_vmc"), Code::kDone);
  ASSERT_EQ(s.bind(plan, std::nullopt), Code::kDone) << s.message();
  EXPECT_EQ(s.output("json")->find("small_router"), std::string::npos);
  settings("machin: small_router\n");
  ASSERT_EQ(s.set("shop", shop), Code::kDone);
  EXPECT_EQ(s.open(), Code::kUsage);
  EXPECT_NE(s.message().find("shop.yaml:2"), std::string::npos) << s.message();
}

TEST(Session, OpensItsShopOnceAndAnewAfterAnOption) {
  Session s;
  ASSERT_EQ(s.set("machine", "no such machine"), Code::kDone);
  EXPECT_EQ(s.open(), Code::kUnreadable);
  EXPECT_EQ(s.bind("x", std::nullopt), Code::kUsage);
  ASSERT_EQ(s.set("machine", "generic_vmc"), Code::kDone);
  EXPECT_EQ(s.open(), Code::kDone) << s.message();
  EXPECT_EQ(s.bind("not a plan", std::nullopt), Code::kUnreadable);
  EXPECT_EQ(s.output("json"), nullptr);
  EXPECT_EQ(s.machining_s(), 0.0);
}

TEST(Session, BindsWithThePlansOwnToolsWhenNoneAreNamed) {
  Session s;
  ASSERT_EQ(s.set("machine", "generic_vmc"), Code::kDone);
  // The example states its tools' sizes and no tool numbers: nothing of it is loaded.
  EXPECT_EQ(s.bind(testing::slurp(kSource + "/examples/bracket.p21"), std::nullopt), Code::kUsage);
  EXPECT_NE(s.message().find("no cutter of the library is in the magazine"), std::string::npos)
      << s.message();
}

/// What a session gives for the example, with this length of its end mill T7.
std::string bound_with(Session& s, const std::string& length_mm) {
  const testing::ScratchFolder folder;
  std::string table = testing::slurp(kSource + "/tests/door/late/magazine.tbl");
  const auto at = table.find("Z+", table.find("T7 "));
  const auto end = table.find(' ', at);
  EXPECT_NE(end, std::string::npos);
  table.replace(at, end - at, "Z+" + length_mm);
  const std::string path = folder.path() + "/magazine.tbl";
  std::ofstream(path) << table;
  EXPECT_EQ(s.set("tools", path), Code::kDone);
  EXPECT_EQ(s.bind(testing::slurp(kSource + "/examples/plate_bound.p21"), std::nullopt), Code::kDone)
      << s.message();
  const std::string* program = s.output("linuxcnc");
  EXPECT_NE(program, nullptr);
  return program == nullptr ? std::string() : *program;
}

TEST(Session, GivesWhatANewOneGivesAfterATableWasChanged) {
  Session one;
  const std::string first = bound_with(one, "115.0");
  const std::string changed = bound_with(one, "118.5");
  Session another;
  EXPECT_EQ(changed, bound_with(another, "118.5"));
  EXPECT_NE(changed, first);
  EXPECT_EQ(bound_with(one, "115.0"), first);
}

}  // namespace
}  // namespace capstan::service
