#include "planner/door/service/options.h"

#include <gtest/gtest.h>

#include <set>

namespace capstan::service {
namespace {

TEST(Options, DurationsAreReadWithTheirUnit) {
  using std::chrono::milliseconds;
  EXPECT_EQ(parse_duration("200ms"), milliseconds(200));
  EXPECT_EQ(parse_duration("1.5s"), milliseconds(1500));
  EXPECT_EQ(parse_duration("30"), milliseconds(30));
  for (const char* bad : {"", "ms", "0", "-5ms", "soon", "nan", "inf", "1e300s", "5 minutes"})
    EXPECT_FALSE(parse_duration(bad)) << bad;
}

TEST(Options, StockIsAnAllowanceOrABox) {
  Request o;
  EXPECT_EQ(parse_stock("block:+2", o), "");
  EXPECT_EQ(o.stock_allowance_mm, 2.0);
  Request p;
  EXPECT_EQ(parse_stock("box:0,0,-30,120,80,1", p), "");
  ASSERT_TRUE(p.stock);
  EXPECT_EQ(p.stock->hi.x, 120.0);
  EXPECT_EQ(p.stock->lo.z, -30.0);
}

TEST(Options, StockThatIsNoneIsRefusedWithAReason) {
  for (const char* bad : {"", "block", "block:", "block:-1", "block:nan", "box:", "box:1,2,3",
                          "box:0,0,0,1,1,0", "box:0,0,0,1,1,x", "box:0,0,0,1,1,1,1", "cylinder:5"}) {
    Request o;
    EXPECT_NE(parse_stock(bad, o), "") << bad;
  }
}

TEST(Options, NamesAreUniqueAndEachHasAVerbAndASetter) {
  std::set<std::string_view> seen;
  for (const Option& o : options()) {
    EXPECT_TRUE(seen.insert(o.name).second) << o.name;
    EXPECT_NE(o.set, nullptr) << o.name;
    EXPECT_TRUE(o.help_of(Verb::kPlan) || o.help_of(Verb::kBind) || o.help_of(Verb::kCheck)) << o.name;
    // A word is always one of its own; a text may name some of those that it takes.
    if (o.value == Value::kText) {
      for (const std::string& word : o.words) {
        Request r;
        EXPECT_TRUE(set(r, o.name, word)) << o.name << " " << word;
      }
    } else {
      EXPECT_EQ(o.words.empty(), o.value != Value::kWord) << o.name;
    }
    EXPECT_EQ(find_option(o.name), &o);
  }
}

TEST(Options, AreSetByNameAndRefusedWithWhatIsWrong) {
  Request r;
  EXPECT_TRUE(set(r, "workholding", "auto"));
  EXPECT_EQ(r.workholding, "auto");
  EXPECT_TRUE(set(r, "batch", "12"));
  EXPECT_EQ(r.batch, 12);
  EXPECT_TRUE(set(r, "allow-findings", "yes"));
  EXPECT_TRUE(r.allow_findings);
  EXPECT_TRUE(set(r, "bind", "tools"));
  EXPECT_EQ(r.bind, pipeline::Bind::kTools);
  EXPECT_EQ(set(r, "workholdin", "auto").error().code, "OPTION-UNKNOWN");
  for (const auto& [name, text] : std::vector<std::pair<const char*, const char*>>{{"batch", "0"},
                                                                                   {"batch", "1.5"},
                                                                                   {"batch", "many"},
                                                                                   {"bind", "some"},
                                                                                   {"strict", "maybe"},
                                                                                   {"machine", ""},
                                                                                   {"machine", "  "},
                                                                                   {"revenue", "0"},
                                                                                   {"edges", "-1"},
                                                                                   {"deadline", "soon"}}) {
    const auto refused = set(r, name, text);
    ASSERT_FALSE(refused) << name << " " << text;
    EXPECT_EQ(refused.error().code, "OPTION-VALUE");
    EXPECT_NE(refused.error().message.find(name), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace capstan::service
