#include "planner/ground/base/tables/separated.h"

#include <gmock/gmock.h>

#include <random>

// Tables of separated values: RFC 4180 by its own examples, and what spreadsheets make of it.

namespace capstan {
namespace {

using ::testing::ElementsAre;

constexpr const char* kCode = "TABLE";

std::vector<SeparatedRow> rows_of(std::string_view text, char separator = ',') {
  const auto rows = separated_rows(text, separator, "t.csv", kCode, StrayQuotes::kRefused);
  EXPECT_TRUE(rows) << rows.error().message;
  return rows ? *rows : std::vector<SeparatedRow>{};
}

Diagnostic fault_of(std::string_view text, StrayQuotes stray = StrayQuotes::kRefused) {
  const auto rows = separated_rows(text, ',', "t.csv", kCode, stray);
  EXPECT_FALSE(rows) << text;
  return rows ? Diagnostic{} : rows.error();
}

// RFC 4180, section 2, rules 5 to 7.
TEST(SeparatedRows, ACellInQuotesHoldsSeparatorsLineEndsAndDoubledQuotes) {
  const auto rows = rows_of("\"aaa\",\"b \r\nbb\",\"c,c\"\r\nzzz,\"b\"\"bb\",\r\n");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_THAT(rows[0].cells, ElementsAre("aaa", "b \r\nbb", "c,c"));
  EXPECT_THAT(rows[1].cells, ElementsAre("zzz", "b\"bb", ""));
}

TEST(SeparatedRows, ARowTellsTheLineWhereItBegins) {
  const auto rows = rows_of("a\n\n\"b\nb\"\nc");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].line, 1U);
  EXPECT_EQ(rows[1].line, 3U) << "line 2 is blank";
  EXPECT_EQ(rows[2].line, 5U) << "the cell before it takes two lines";
}

TEST(SeparatedRows, ByteOrderMarkAndCarriageReturnsAreNoPartOfACell) {
  const auto rows = rows_of(
      "\xEF\xBB\xBF"
      "a;b\r\n1;2\r\n",
      ';');
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_THAT(rows[0].cells, ElementsAre("a", "b"));
  EXPECT_THAT(rows[1].cells, ElementsAre("1", "2"));
}

TEST(SeparatedRows, ARowOfSeparatorsAloneIsARowAndABlankLineIsNone) {
  const auto rows = rows_of(",,\n\r\n\"\"\n");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_THAT(rows[0].cells, ElementsAre("", "", ""));
  EXPECT_THAT(rows[1].cells, ElementsAre(""));
}

TEST(SeparatedRows, AnOpenQuoteIsToldWithItsFileAndLine) {
  const Diagnostic d = fault_of("a,b\n1,\"2\n3,4\n");
  EXPECT_EQ(d.code, kCode);
  EXPECT_EQ(d.file, "t.csv");
  EXPECT_EQ(d.line, 2U);
  EXPECT_THAT(d.message, ::testing::HasSubstr("does not end"));
}

TEST(SeparatedRows, StrayQuotesAreRefusedOrKeptAsTheCallerSays) {
  EXPECT_EQ(fault_of("a,3\" bolt\n").line, 1U);
  EXPECT_EQ(fault_of("x\n\"a\"b,c\n").line, 2U);
  const auto kept = separated_rows("a,3\" bolt\n\"a\"b,c\n", ',', "t.csv", kCode, StrayQuotes::kKept);
  ASSERT_TRUE(kept);
  EXPECT_THAT(kept->at(0).cells, ElementsAre("a", "3\" bolt"));
  EXPECT_THAT(kept->at(1).cells, ElementsAre("ab", "c"));
}

TEST(SeparatedRows, NulBytesAndUtf16AreToldAndNotRead) {
  EXPECT_THAT(fault_of(std::string_view("a\0b", 3)).message, ::testing::HasSubstr("NUL"));
  EXPECT_THAT(fault_of("\xFF\xFE"
                       "a")
                  .message,
              ::testing::HasSubstr("UTF-16"));
}

TEST(SeparatorOf, IsWhatTheFirstLineWithWordsHasMostOfOutsideQuotes) {
  EXPECT_EQ(separator_of("a;b;c,d\n1,2,3,4\n"), ';');
  EXPECT_EQ(separator_of("\n\na\tb\n"), '\t');
  EXPECT_EQ(separator_of("\"a;b;c\",d\n"), ',');
  EXPECT_EQ(separator_of("words alone\n"), '\0');
}

TEST(SeparatedRowsProperty, WhatIsWrittenCellByCellIsReadBack) {
  std::mt19937 random(4180);
  constexpr std::string_view kLetters = "ab ,;\t\"\r\n";
  for (int round = 0; round < 500; ++round) {
    std::vector<std::vector<std::string>> table(1 + random() % 4);
    std::string text;
    for (auto& row : table) {
      row.resize(2);  // a row of one empty cell is a blank line
      for (auto& cell : row)
        for (std::size_t n = random() % 6; n > 0; --n) cell += kLetters[random() % kLetters.size()];
      text += separated_cell(row[0], ';') + ";" + separated_cell(row[1], ';') + "\r\n";
    }
    const auto rows = rows_of(text, ';');
    ASSERT_EQ(rows.size(), table.size()) << text;
    for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i].cells, table[i]) << text;
  }
}

}  // namespace
}  // namespace capstan
