#include <gtest/gtest.h>

#include <random>
#include <string>

#include "planner/model/plan/edit/edit.h"
#include "planner/model/plan/edit/provenance.h"
#include "planner/model/plan/edit/deciding.h"
#include "planner/model/plan/edit/restrictions.h"

namespace capstan::model {
namespace {

Edit parsed(EditKind kind, const std::string& text) {
  const auto e = parse_edit(kind, text, "--" + std::string(to_text(kind)));
  EXPECT_TRUE(e) << text << ": " << (e ? "" : to_text(e.error()));
  return e.value_or(Edit{});
}

std::string refused(EditKind kind, const std::string& text) {
  const auto e = parse_edit(kind, text, "");
  EXPECT_FALSE(e) << text;
  return e ? std::string() : e.error().code;
}

TEST(OperatorEdit, OfEachKindIsReadWithPatternAttributeAndValue) {
  const Edit set = parsed(EditKind::kSet, " POCKET* / tool = T5 ");
  EXPECT_EQ(set.where, "POCKET*");
  EXPECT_EQ(set.of, EditOf::kTool);
  EXPECT_EQ(set.value, "T5");
  const Edit feed = parsed(EditKind::kSet, "feed=2000.5");
  EXPECT_EQ(feed.where, "*");
  EXPECT_EQ(feed.number, 2000.5);
  const Edit limit = parsed(EditKind::kLimit, "tool.diameter>=8");
  EXPECT_EQ(limit.of, EditOf::kToolDiameter);
  EXPECT_TRUE(limit.at_least);
  EXPECT_EQ(limit.number, 8.0);
  EXPECT_EQ(parsed(EditKind::kPin, "SLOT/tool").value, "");
  EXPECT_EQ(parsed(EditKind::kForbid, "operation=reaming").of, EditOf::kOperation);
  const Edit order = parsed(EditKind::kOrder, "HOLE 1 < POCKET*");
  EXPECT_EQ(order.where, "HOLE 1");
  EXPECT_EQ(order.before, "POCKET*");
}

// A name may hold a slash; the attribute stands behind the last one.
TEST(OperatorEdit, IsAboutANameWithASlash) { EXPECT_EQ(parsed(EditKind::kSet, "A/B/feed=100").where, "A/B"); }

TEST(OperatorEdit, ThatIsNoneIsRefused) {
  for (const char* bad : {"", "  ", "tool", "tool=", "feed=fast", "feed=0", "feed=-1", "feed=nan", "feed=inf",
                          "feed=1,5", "/feed=5", "feed=2000000", "feed=1e7"})
    EXPECT_EQ(refused(EditKind::kSet, bad), "EDIT-SYNTAX") << bad;
  for (const char* bad : {"feed=5", "feed<5", "feed>=5", "speed>=1", "feed<="})
    EXPECT_EQ(refused(EditKind::kLimit, bad), "EDIT-SYNTAX") << bad;
  for (const char* bad : {"A", "<B", "A<", "A<B<C"})
    EXPECT_EQ(refused(EditKind::kOrder, bad), "EDIT-SYNTAX") << bad;
  EXPECT_EQ(refused(EditKind::kSet, std::string(kLongestEdit + 1, 'a') + "/feed=5"), "EDIT-SYNTAX");
  EXPECT_EQ(refused(EditKind::kSet, "A\nB/feed=5"), "EDIT-SYNTAX");
}

TEST(OperatorEdit, NamesWhatAnUnknownAttributeMayMean) {
  const auto e = parse_edit(EditKind::kSet, "POCKET/fed=100", "");
  ASSERT_FALSE(e);
  EXPECT_EQ(e.error().code, "NAME-UNKNOWN");
  EXPECT_NE(e.error().message.find("'feed'"), std::string::npos) << e.error().message;
  // A diameter is bounded and not set: the tool is what is set.
  EXPECT_EQ(refused(EditKind::kSet, "tool.diameter=8"), "NAME-UNKNOWN");
}

TEST(OperatorEdit, HasNamesWithItsOwnSignsInDoubleQuotes) {
  const Edit set = parsed(EditKind::kSet, R"( "A=1 <B> \"x\" \\"/ tool = "T = 5" )");
  EXPECT_EQ(set.where, R"(A=1 <B> "x" \)");
  EXPECT_EQ(set.value, "T = 5");
  EXPECT_EQ(parsed(EditKind::kSet, R"("A/B"/feed=5)").where, "A/B");
  const Edit order = parsed(EditKind::kOrder, R"("A<B" < C)");
  EXPECT_EQ(order.where, "A<B");
  EXPECT_EQ(order.before, "C");
  for (const char* bad : {R"("A=B/feed=5)", R"(""/feed=5)", R"("A"feed=5)", R"("A"/B/feed=5)"})
    EXPECT_EQ(refused(EditKind::kSet, bad), "EDIT-SYNTAX") << bad;
  EXPECT_EQ(refused(EditKind::kForbid, R"(tool="A"B)"), "EDIT-SYNTAX");
  // Whoever leaves them out is told of them.
  const auto bare = parse_edit(EditKind::kSet, "A=B/feed=5", "");
  ASSERT_FALSE(bare);
  EXPECT_NE(bare.error().message.find("double quotes"), std::string::npos) << bare.error().message;
}

TEST(OperatorEditProperty, ReadsBackWithAnyName) {
  std::mt19937 random(3);
  const auto name = [&] {
    static constexpr std::string_view kLetters = "AB=<>\"\\/ *?#'";
    std::string out;
    for (auto n = 1 + random() % 6; n > 0; --n) out += kLetters[random() % kLetters.size()];
    return out;
  };
  int quoted = 0;
  for (int i = 0; i < 20000; ++i) {
    Edit e;
    e.kind = kEditKinds[random() % 5];
    e.where = name();
    switch (e.kind) {
      case EditKind::kSet:
      case EditKind::kForbid:
        e.of = EditOf::kTool;
        e.value = name();
        break;
      case EditKind::kPin:
        e.of = EditOf::kDepth;
        break;
      case EditKind::kLimit:
        e.of = EditOf::kFeed;
        e.value = "900";
        e.number = 900.0;
        break;
      case EditKind::kOrder:
        e.before = name();
        break;
    }
    const auto again = parse_edit(e.kind, text_of(e), "");
    ASSERT_TRUE(again) << text_of(e) << ": " << to_text(again.error());
    EXPECT_EQ(*again, e) << text_of(e);
    quoted += text_of(e).find('"') != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(quoted, 5000);  // names with signs are met
}

TEST(OperatorEditProperty, ReadsBackFromItsTextAndFromProvenance) {
  std::mt19937 random(1);
  const auto name = [&] {
    static constexpr std::string_view kLetters = "AB*? /_-1'\"#";
    std::string out = "N";
    for (auto n = random() % 8; n > 0; --n) out += kLetters[random() % kLetters.size()];
    return out + "E";
  };
  Plan plan;
  std::vector<Edit> all;
  for (int i = 0; i < 2000; ++i) {
    Edit e;
    e.kind = kEditKinds[random() % 5];
    e.from = "edit " + std::to_string(i) + " of x.yaml";
    const std::string where = random() % 3 == 0 ? "" : name() + "/";
    std::string text;
    switch (e.kind) {
      case EditKind::kSet:
        text = where + (random() % 2 == 0 ? "tool=" + name() : "feed=" + std::to_string(1 + random() % 9999));
        break;
      case EditKind::kPin:
        text = where + (random() % 2 == 0 ? "tool" : "speed=" + std::to_string(1 + random() % 9999));
        break;
      case EditKind::kLimit:
        text = where + (random() % 2 == 0 ? "feed<=2500.25" : "tool.teeth>=2");
        break;
      case EditKind::kForbid:
        text = where + "strategy=" + name();
        break;
      case EditKind::kOrder:
        text = name() + "<" + name();
        break;
    }
    const auto first = parse_edit(e.kind, text, e.from);
    ASSERT_TRUE(first) << text;
    const auto again = parse_edit(e.kind, text_of(*first), e.from);
    ASSERT_TRUE(again) << text_of(*first);
    EXPECT_EQ(*again, *first) << text;
    plan.provenance.push_back(provenance_of(*first));
    all.push_back(*first);
  }
  EXPECT_EQ(edits_of(plan), all);
}

/// What `names` means, by its definition.
bool matches(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) return name.empty();
  if (pattern.front() == '*')
    return matches(pattern.substr(1), name) || (!name.empty() && matches(pattern, name.substr(1)));
  return !name.empty() && (pattern.front() == '?' || pattern.front() == name.front()) &&
         matches(pattern.substr(1), name.substr(1));
}

TEST(OperatorEditProperty, APatternMeansWhatItsDefinitionSays) {
  std::mt19937 random(2);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string pattern, name;
    for (auto n = random() % 7; n > 0; --n) pattern += "ab*?"[random() % 4];
    for (auto n = random() % 7; n > 0; --n) name += "ab"[random() % 2];
    EXPECT_EQ(names(pattern, name), matches(pattern, name)) << pattern << " " << name;
    hits += names(pattern, name) ? 1 : 0;
  }
  EXPECT_GT(hits, 1000);  // both answers are met
  EXPECT_LT(hits, 19000);
}

Cutter cutter(const std::string& id, double diameter_mm, int pocket) {
  Cutter c;
  c.id = id;
  c.cutting_diameter_mm = diameter_mm;
  c.pocket = pocket;
  return c;
}

TEST(Restrictions, BarACutterBySizeNumberAndNameWhereTheyAreMeant) {
  const std::vector<Edit> edits = {parsed(EditKind::kLimit, "POCKET/tool.diameter<=8"),
                                   parsed(EditKind::kForbid, "tool=T3"),
                                   parsed(EditKind::kForbid, "HOLE*/tool=drill*")};
  const StepNames pocket{"POCKET", "POCKET rough"}, hole{"HOLE[2]", "HOLE[2] drill"};
  EXPECT_FALSE(barred(edits, pocket, cutter("em8", 8.0, 1)));
  EXPECT_FALSE(barred(edits, hole, cutter("em10", 10.0, 1)));
  const auto wide = barred(edits, pocket, cutter("em10", 10.0, 1));
  ASSERT_TRUE(wide);
  EXPECT_EQ(wide->edit, &edits[0]);
  EXPECT_EQ(wide->why, "--limit: limit POCKET/tool.diameter<=8: 'em10' has 10 mm");
  EXPECT_TRUE(barred(edits, pocket, cutter("em6", 6.0, 3)));
  EXPECT_FALSE(barred(edits, pocket, cutter("drill5", 5.0, 0)));
  EXPECT_TRUE(barred(edits, hole, cutter("drill5", 5.0, 0)));
}

TEST(OperatorEdit, ADepthIsSetAndNotLimited) {
  EXPECT_TRUE(parse_edit(EditKind::kSet, "POCKET/depth=4", "--set"));
  EXPECT_FALSE(parse_edit(EditKind::kLimit, "POCKET/depth<=4", "--limit"));
}

TEST(Restrictions, TheLeastOfSeveralLimitsHolds) {
  const std::vector<Edit> edits = {
      parsed(EditKind::kLimit, "feed<=2000"), parsed(EditKind::kLimit, "SLOT*/feed<=900"),
      parsed(EditKind::kLimit, "feed<=1500"), parsed(EditKind::kLimit, "speed<=2000")};
  const EditLimits slot = limits_of(edits, {"SLOT", "SLOT rough"}), other = limits_of(edits, {"POCKET", ""});
  EXPECT_EQ(slot.feed_mm_min, 900.0);
  EXPECT_EQ(other.feed_mm_min, 1500.0);
  EXPECT_EQ(other.speed_rpm, 2000.0);
  EXPECT_EQ(slot.words(), "--limit: limit SLOT*/feed<=900; --limit: limit speed<=2000");
}

TEST(Restrictions, TheEditThatNamesAStepMostCloselyDecides) {
  const StepNames rough{"SLOT", "SLOT rough", "id-7"};
  const auto decided = [&](const std::vector<const char*>& texts) {
    std::vector<Edit> edits = {parsed(EditKind::kSet, "speed=1"), parsed(EditKind::kLimit, "feed<=1")};
    for (const char* text : texts) edits.push_back(parsed(EditKind::kSet, text));
    const Edit* e = deciding(edits, EditOf::kFeed, rough);
    return e == nullptr ? 0.0 : e->number;
  };
  // In any order.
  EXPECT_EQ(decided({"feed=1", "SLOT*/feed=2", "SLOT/feed=3", "SLOT rough/feed=4"}), 4.0);
  EXPECT_EQ(decided({"SLOT rough/feed=4", "SLOT/feed=3", "SLOT*/feed=2", "feed=1"}), 4.0);
  EXPECT_EQ(decided({"id-7/feed=5", "SLOT/feed=3"}), 5.0);
  EXPECT_EQ(decided({"SLOT/feed=3", "SLOT r*/feed=2"}), 3.0) << "a feature's name before a pattern";
  EXPECT_EQ(decided({"SLOT r*/feed=2", "S*/feed=6"}), 2.0) << "the pattern with more letters";
  EXPECT_EQ(decided({"SLOT*/feed=2", "SLOT?*/feed=6"}), 6.0) << "of equals the last";
  EXPECT_EQ(decided({"S*/feed=2", "feed=1"}), 2.0);
  EXPECT_EQ(decided({"POCKET/feed=2"}), 0.0);
}

TEST(Restrictions, BarOperationsAndStrategiesByTheirKeyword) {
  const std::vector<Edit> edits = {parsed(EditKind::kForbid, "operation=Reaming"),
                                   parsed(EditKind::kForbid, "POCKET/strategy=contour_*")};
  EXPECT_TRUE(barred_operation(edits, {"H", ""}, TypeId::kReaming));
  EXPECT_FALSE(barred_operation(edits, {"H", ""}, TypeId::kDrilling));
  EXPECT_TRUE(barred_strategy(edits, {"POCKET", ""}, word_of(StrategyKind::kContourParallel)));
  EXPECT_FALSE(barred_strategy(edits, {"SLOT", ""}, word_of(StrategyKind::kContourParallel)));
  EXPECT_FALSE(barred_strategy(edits, {"POCKET", ""}, word_of(StrategyKind::kBidirectional)));
}

}  // namespace
}  // namespace capstan::model
