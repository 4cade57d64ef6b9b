#include <filesystem>
#include <fstream>
#include <random>

#include "rules/rules.h"
#include "tests/support/scratch.h"

namespace capstan::rules {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A table of two facts, complete and free of contradictions; `extra` is appended to its rows.
std::vector<std::pair<std::string, std::string>> table(const std::string& extra,
                                                       const std::string& second_row = R"(
  - id: b
    when: {it_grade: {from: 7, to: 18}}
    cannot: "b"
    source: "test"
)") {
  return {{"t.yaml", R"(table: pocket
facts: [wall, it_grade]
rows:
  - id: a
    when: {it_grade: {from: 0, to: 6}}
    cannot: "a"
    source: "test"
)" + second_row + extra}};
}

std::vector<std::string> findings(const std::vector<std::pair<std::string, std::string>>& texts) {
  const auto base = rules_from_texts(texts);
  if (!base) return {to_text(base.error())};
  std::vector<std::string> out;
  for (const auto& f : check_tables(*base)) out.push_back(f.text());
  return out;
}

TEST(Check, FindsNothingInACompleteTable) { EXPECT_TRUE(findings(table("")).empty()); }

TEST(Check, NamesTheBoxOfAPlantedGap) {
  EXPECT_THAT(findings(table("", R"(
  - {id: b, when: {it_grade: {from: 9, to: 18}}, cannot: "b", source: "test"}
  - {id: c, when: {it_grade: {from: 7, to: 8}, wall: [upright]}, cannot: "c", source: "test"}
)")),
              ElementsAre("pocket: gap: no row for wall in {drafted}, it_grade in [7, 9)"));
}

TEST(Check, CountsARowWithoutConditionsAsAGap) {
  EXPECT_THAT(
      findings({{"t.yaml",
                 "table: pocket\nfacts: [wall]\nrows:\n  - {id: all, cannot: \"no\", source: \"test\"}\n"}}),
      ElementsAre("pocket: gap: no row for everything"));
}

std::string told(const std::string& chains) {
  const auto base = rules_from_texts({{"t.yaml",
                                       "table: pocket\nfacts: [wall]\nrows:\n  - {id: a, when: {wall: "
                                       "[upright]}, source: \"test\", chains: [" +
                                           chains + "]}\n"}});
  return base ? std::string() : to_text(base.error());
}

TEST(Load, RefusesAChainOfMoreStepsThanAnyFeatureTakes) {
  const auto steps = [](int n) {
    std::string out = "area_finish";
    for (int i = 1; i < n; ++i) out += ", area_finish";
    return "[" + out + "]";
  };
  EXPECT_EQ(told(steps(32)), "");
  EXPECT_THAT(told(steps(33)), HasSubstr("a chain of 33 steps; it has at most 32"));
  EXPECT_THAT(told(steps(3000)), HasSubstr("RULE-ROW"));
}

TEST(Load, RefusesParametersBelowZeroAndPartsOfASizeAboveOne) {
  EXPECT_EQ(told("[{do: area_finish, allowance_side_mm: 0.2, of_passage: 1}]"), "");
  EXPECT_THAT(told("[{do: area_finish, allowance_side_mm: -0.2}]"),
              HasSubstr("allowance_side_mm is -0.2, below zero"));
  EXPECT_THAT(told("[{do: area_finish, of_passage: 1.5}]"), HasSubstr("of_passage is 1.5"));
  EXPECT_THAT(told("[{do: area_finish, of_passage: 0}]"), HasSubstr("of_passage is 0"));
  const auto base = rules_from_texts({{"t.yaml",
                                       "table: pocket\nfacts: [wall]\nrows:\n  - {id: a, source: \"test\", "
                                       "when: {wall: [upright]}, values: {peck: -7}}\n"}});
  ASSERT_FALSE(base);
  EXPECT_THAT(to_text(base.error()), HasSubstr("peck is -7, below zero"));
}

// So that a new operation's rows stand in a file of its own, whatever its name.
TEST(Load, AddsRowsOfATableThatALaterFileDefines) {
  const std::string rows = "table: pocket\nrows:\n  - {id: own, when: {wall: [upright]}, cannot: \"c\", ";
  const std::string defined =
      "table: pocket\nfacts: [wall]\nrows:\n  - {id: all, when: {wall: [drafted]}, cannot: \"no\", source: "
      "\"t\"}\n";
  const auto base = rules_from_texts({{"a.yaml", rows + "source: \"test\"}\n"}, {"b.yaml", defined}});
  ASSERT_TRUE(base) << to_text(base.error());
  ASSERT_EQ(base->tables.size(), 1u);
  EXPECT_EQ(base->tables.front().rows.size(), 2u);
  EXPECT_THAT(findings({{"a.yaml", rows + "source: \"test\"}\n"}, {"b.yaml", defined}}),
              ::testing::IsEmpty());
}

TEST(Load, RefusesAShippedRowOrCapabilityThatStandsInTwoFiles) {
  const std::string rows =
      "table: pocket\nrows:\n  - {id: all, when: {wall: [upright]}, cannot: \"c\", source: \"t\"}\n";
  const std::string defined =
      "table: pocket\nfacts: [wall]\nrows:\n  - {id: all, when: {wall: [drafted]}, cannot: \"no\", source: "
      "\"t\"}\n";
  const auto twice = rules_from_texts({{"a.yaml", defined}, {"b.yaml", rows}});
  ASSERT_FALSE(twice);
  EXPECT_THAT(to_text(twice.error()), HasSubstr("b.yaml:3"));
  EXPECT_THAT(to_text(twice.error()), HasSubstr("the id all occurs twice"));
  const std::string drill = "capabilities:\n  - {action: drill, finest_grade: 11, source: \"t\"}\n";
  const auto both = rules_from_texts({{"a.yaml", drill}, {"b.yaml", drill}});
  ASSERT_FALSE(both);
  EXPECT_THAT(to_text(both.error()), HasSubstr("the capability of drill occurs twice"));
}

TEST(Check, NamesTheBoxOfAPlantedContradiction) {
  EXPECT_THAT(
      findings(table(R"(
  - {id: c, when: {it_grade: {from: 5, to: 7}, wall: [upright]}, cannot: "c", source: "test"}
)")),
      ElementsAre(
          "pocket: contradiction: a and c conclude differently for wall in {upright}, it_grade in [5, 7)",
          "pocket: contradiction: b and c conclude differently for wall in {upright}, it_grade in [7, 8)"));
}

TEST(Check, AllowsEqualPriorityWhereABetterRowDecides) {
  EXPECT_TRUE(findings(table(R"(
  - {id: c, when: {it_grade: {from: 5, to: 6}, wall: [upright]}, cannot: "c", source: "test", priority: 1}
)"))
                  .empty());
}

TEST(Check, NamesAPlantedDeadRow) {
  EXPECT_THAT(
      findings(table(R"(
  - {id: c, when: {it_grade: {from: 5, to: 9}, wall: [drafted]}, cannot: "c", source: "test", priority: 200}
)")),
      ElementsAre(
          "pocket: dead row: c never decides: better rows cover wall in {drafted}, it_grade in [5, 10)"));
}

TEST(Check, NamesAChainThatDoesNotHoldTheGradeItAccepts) {
  EXPECT_THAT(findings(table("capabilities: [{action: area_finish, finest_grade: 9, source: test}]\n", R"(
  - {id: b, when: {it_grade: {from: 7, to: 18}}, chains: [[area_rough, area_finish]], source: "test"}
)")),
              ElementsAre("pocket: incapable chain: b has a chain that does not hold it_grade in [7, 9)"));
}

TEST(Boxes, SubtractToPiecesThatHoldExactlyWhatIsLeft) {
  const std::vector<std::size_t> facts{*find_fact("it_grade"), *find_fact("wall"), *find_fact("depth_mm")};
  std::mt19937 random(11);
  const auto side = [&](std::size_t i) {
    if (i == 1) return Side{0.0, 0.0, static_cast<std::uint32_t>(1 + random() % 3), true};
    const double a = static_cast<double>(random() % 10);
    return Side{a, a + 1.0 + static_cast<double>(random() % 9), 0, false};
  };
  for (int round = 0; round < 300; ++round) {
    const Box a{side(0), side(1), side(2)};
    const Box b{side(0), side(1), side(2)};
    const auto left = subtract(a, b);
    for (double x = 0.5; x < 19.0; x += 1.0) {
      for (double y = 0.0; y < 2.0; y += 1.0) {
        for (double z = 0.5; z < 19.0; z += 1.0) {
          const auto in = [&](const Box& box) {
            return holds(box[0], x) && holds(box[1], y) && holds(box[2], z);
          };
          const auto pieces = std::count_if(left.begin(), left.end(), in);
          ASSERT_EQ(pieces, in(a) && !in(b) ? 1 : 0) << to_text(a, facts) << " without " << to_text(b, facts);
        }
      }
    }
  }
}

struct BadText {
  std::string text, code, message;
  std::uint64_t line;
};
class Loading : public ::testing::TestWithParam<BadText> {};

TEST_P(Loading, RefusesABadTableWithFileAndLine) {
  const auto base = rules_from_texts({{"bad.yaml", GetParam().text}});
  ASSERT_FALSE(base);
  EXPECT_EQ(base.error().code, GetParam().code);
  EXPECT_THAT(base.error().message, HasSubstr(GetParam().message));
  EXPECT_EQ(base.error().file, "bad.yaml");
  EXPECT_EQ(base.error().line, GetParam().line);
}

std::string row(const std::string& fields) {
  return "table: pocket\nfacts: [wall, it_grade]\nrows:\n  - " + fields + "\n";
}
INSTANTIATE_TEST_SUITE_P(
    Texts, Loading,
    ::testing::Values(
        BadText{"table: [", "RULE-SYNTAX", "", 1}, BadText{"just text", "RULE-SYNTAX", "not a map", 1},
        BadText{"table: pocket\nfacts: [colour]\nrows: []", "RULE-FACT", "no fact named colour", 2},
        BadText{row("{id: a, cannot: x}"), "RULE-ROW", "source is missing", 4},
        BadText{row("{id: a, source: s}"), "RULE-ROW", "exactly one of", 4},
        BadText{row("{id: a, source: s, cannot: x, when: {diameter_mm: {from: 1}}}"), "RULE-FACT",
                "does not ask about diameter_mm", 4},
        BadText{row("{id: a, source: s, cannot: x, when: {it_grade: {from: 9, to: 7}}}"), "RULE-ROW",
                "is empty", 4},
        BadText{row("{id: a, source: s, cannot: x, when: {it_grade: {from: 9, to: 70}}}"), "RULE-ROW",
                "domain", 4},
        BadText{row("{id: a, source: s, cannot: x, when: {it_grade: {from: .nan}}}"), "RULE-ROW", "finite",
                4},
        BadText{row("{id: a, source: s, cannot: x, when: {it_grade: {from: 7.5}}}"), "RULE-ROW", "whole", 4},
        BadText{row("{id: a, source: s, cannot: x, when: {wall: [bent]}}"), "RULE-ROW", "no symbol 'bent'",
                4},
        BadText{row("{id: a, source: s, chains: [[laser]]}"), "RULE-ROW", "no action named laser", 4},
        BadText{row("{id: a, source: s, chains: [[{do: area_rough, speed: 3}]]}"), "RULE-ROW",
                "takes no speed", 4},
        BadText{row("{id: a, source: s, cannot: x, colour: red}"), "RULE-ROW", "a row has no colour", 4},
        BadText{row("{id: a, source: s, cannot: x}\n  - {id: a, source: s, cannot: y}"), "RULE-ROW",
                "occurs twice", 5}));

class ShopRules : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = capstan::testing::scratch_file(::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  std::filesystem::path folder_;
};

TEST_F(ShopRules, ReplaceARowOfTheSameIdAndAddOthers) {
  write("shop.yaml", R"(table: hole
rows:
  - {id: hole.tiny, priority: 12, when: {diameter_mm: {from: 0, below: 0.5}}, cannot: "not here", source: "shop"}
  - {id: shop.drill, priority: 1, when: {diameter_mm: {from: 9, below: 11}, it_grade: {from: 7, to: 7}, bottom: [through]},
     chains: [[centre, drill]], source: "shop"}
)");
  Job job;
  const auto base = load_rules(folder_.string(), job);
  ASSERT_TRUE(base) << to_text(base.error());
  const auto shipped = load_rules("", job);
  const Table& table = *base->table("hole");
  EXPECT_EQ(table.rows.size(), shipped->table("hole")->rows.size() + 1);
  EXPECT_EQ(table.rows.front().id, "shop.drill");
  const auto tiny =
      std::find_if(table.rows.begin(), table.rows.end(), [](const Row& r) { return r.id == "hole.tiny"; });
  EXPECT_EQ(tiny->cannot, "not here");
  // The shop says that its drills hold IT7; the shipped capability says otherwise, and check tells.
  ASSERT_EQ(check(*base).size(), 1U);
  EXPECT_EQ(check(*base).front().fault, RuleFault::kIncapable);
}

TEST_F(ShopRules, MayNotSpeakOfATableThatIsNotThere) {
  write("shop.yaml", "table: holes\nrows: []\n");
  Job job;
  const auto base = load_rules(folder_.string(), job);
  ASSERT_FALSE(base);
  EXPECT_EQ(base.error().code, "RULE-TABLE");
}

TEST_F(ShopRules, AreMissedWhenTheFolderIsEmptyOrNotThere) {
  Job job;
  EXPECT_TRUE(load_rules(folder_.string(), job));
  EXPECT_EQ(job.count(Severity::kWarning), 1U);
  const auto none = load_rules((folder_ / "none").string(), job);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "RULE-IO");
}

}  // namespace
}  // namespace capstan::rules
