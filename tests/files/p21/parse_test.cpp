#include "planner/files/p21/read/parse.h"

#include <cmath>
#include <limits>
#include <random>

#include "tests/files/p21/p21_helpers.h"

namespace capstan::p21::testing {
namespace {

TEST(Parse, TellsEachKindOfParameter) {
  const File f = read_clean(data_file("#7=A($,*,-12,1.5E-1,'t',.METRE.,\"0FA\",#7,(1,(2)),LENGTH(3.));"));
  const Instance i = f.instance(0);
  EXPECT_EQ(i.id(), 7U);
  EXPECT_EQ(i.keyword(), "A");
  EXPECT_EQ(i.line(), kFirstDataLine);
  EXPECT_FALSE(i.is_complex());
  const Value p = i.parameters();
  ASSERT_EQ(p.size(), 10U);
  EXPECT_EQ(p[0].kind(), Kind::kOmitted);
  EXPECT_EQ(p[1].kind(), Kind::kDerived);
  EXPECT_EQ(p[2].as_integer(), -12);
  EXPECT_EQ(p[2].as_real(), -12.0);
  EXPECT_EQ(p[3].kind(), Kind::kReal);
  EXPECT_EQ(p[3].as_real(), 0.15);
  EXPECT_EQ(p[3].lexeme(), "1.5E-1");
  EXPECT_EQ(p[4].as_text(), "t");
  EXPECT_EQ(p[5].enumeration(), "METRE");
  EXPECT_EQ(p[6].lexeme(), "0FA");
  EXPECT_EQ(p[7].reference(), 7U);
  EXPECT_EQ(p[8].size(), 2U);
  EXPECT_EQ(p[8][1][0].as_integer(), 2);
  EXPECT_EQ(p[9].kind(), Kind::kTyped);
  EXPECT_EQ(p[9].keyword(), "LENGTH");
  EXPECT_EQ(p[9].size(), 1U);
  EXPECT_EQ(p[9][0].as_real(), 3.0);
}

TEST(Parse, AskingForAnotherKindOrPlaceThrows) {
  const File f = read_clean(data_file("#1=A(1,(2));"));
  const Value p = f.instance(0).parameters();
  EXPECT_THROW((void)p[0].as_text(), std::logic_error);
  EXPECT_THROW((void)p[0].reference(), std::logic_error);
  EXPECT_THROW((void)p[0].enumeration(), std::logic_error);
  EXPECT_THROW((void)p[1].as_real(), std::logic_error);
  EXPECT_THROW((void)p[1].keyword(), std::logic_error);
  EXPECT_THROW((void)p[2], std::out_of_range);
  EXPECT_THROW((void)f.instance(1), std::out_of_range);
  EXPECT_EQ(Value().kind(), Kind::kOmitted);
  EXPECT_EQ(Value().lexeme(), "$");
}

TEST(Parse, KeepsThePartsOfAComplexInstanceInOrder) {
  const File f = read_clean(data_file("#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));"));
  const Instance i = f.instance(0);
  EXPECT_TRUE(i.is_complex());
  EXPECT_EQ(i.keyword(), "");
  ASSERT_EQ(i.part_count(), 3U);
  EXPECT_EQ(i.part(1).keyword, "NAMED_UNIT");
  EXPECT_EQ((*i.part("SI_UNIT"))[1].enumeration(), "METRE");
  EXPECT_FALSE(i.part("AREA_UNIT"));
}

TEST(Parse, GivesHeaderSectionsAndSchemas) {
  const File f = read_clean(std::string(kHeader) +
                            "DATA('one',('S'));\n#1=A();\n#2=A();\nENDSEC;\nDATA('two',('T'));\n#3=!B();\n"
                            "ENDSEC;\nEND-ISO-10303-21;");
  EXPECT_EQ(f.header_count(), 3U);
  EXPECT_EQ(f.header(1).keyword(), "FILE_NAME");
  EXPECT_EQ(f.header(1).line(), 4U);
  EXPECT_EQ(f.header("FILE_SCHEMA")->parameters()[0][0].as_text(), "S");
  EXPECT_EQ(f.schemas(), std::vector<std::string>{"S"});
  ASSERT_EQ(f.data_sections().size(), 2U);
  EXPECT_EQ(f.data_sections()[0].count, 2U);
  EXPECT_EQ(f.data_sections()[1].first, 2U);
  EXPECT_EQ(f.data_sections()[1].parameters[0].as_text(), "two");
  EXPECT_TRUE(f.instance(2).user_defined());
  EXPECT_FALSE(f.instance(0).user_defined());
  std::size_t n = 0;
  for (const Instance i : f) n += i.id();
  EXPECT_EQ(n, 6U);
}

TEST(Parse, KeepsEdition3SectionsVerbatim) {
  const File f = read_clean(std::string(kHeader) +
                            "ANCHOR;\n<a;b>=#1 /* ENDSEC; */;\nENDSEC;\nREFERENCE;\n#5=<x.stp#y>;\nENDSEC;\n"
                            "DATA;\n#1=A(#5);\nENDSEC;\nEND-ISO-10303-21;\nSIGNATURE\nZm9v\nENDSEC;\n");
  ASSERT_EQ(f.verbatim_sections().size(), 3U);
  EXPECT_EQ(f.verbatim_sections()[0].text, "\n<a;b>=#1 /* ENDSEC; */;\n");
  EXPECT_EQ(f.verbatim_sections()[1].keyword, "REFERENCE");
  EXPECT_EQ(f.verbatim_sections()[2].text, "\nZm9v\n");
  EXPECT_EQ(f.external_ids(), std::vector<std::uint64_t>{5});
  Job job;
  EXPECT_EQ(check_references(f, job), 0U);
}

TEST(Parse, FindsInstancesByNumberDenseOrSparse) {
  for (const std::uint64_t step : {std::uint64_t{1}, std::uint64_t{3}, std::uint64_t{1} << 50U}) {
    std::string text;
    for (std::uint64_t i = 2000; i > 0; --i) text += "#" + std::to_string(i * step) + "=A();\n";
    const File f = read_clean(data_file(text));
    for (std::uint64_t i = 1; i <= 2000; ++i) {
      ASSERT_TRUE(f.find(i * step));
      EXPECT_EQ(f.find(i * step)->index(), 2000 - i);
      EXPECT_EQ(f.find(i * step)->id(), i * step);
    }
    EXPECT_FALSE(f.find(0));
    EXPECT_FALSE(f.find(2001 * step));
    EXPECT_FALSE(f.find(UINT64_MAX));
  }
}

TEST(Parse, ReportsEachFaultWithItsLineAndInstanceAndGoesOn) {
  const Outcome o = read(data_file("#1=A(1;\n#2=B();\n\n#3=C(1.E);\n#0=D();\n#4=E('\\X\\');"));
  EXPECT_FALSE(o.file);
  ASSERT_EQ(o.said.size(), 4U) << o.all();
  EXPECT_EQ(o.said[0].instance, 1U);
  EXPECT_EQ(o.said[0].line, kFirstDataLine);
  EXPECT_EQ(o.said[0].expected, "',' or ')'");
  EXPECT_EQ(o.said[1].instance, 3U);
  EXPECT_EQ(o.said[1].line, kFirstDataLine + 3);
  EXPECT_EQ(o.said[2].code, "P21-ID");
  EXPECT_EQ(o.said[3].code, "P21-STRING");
  EXPECT_EQ(o.said[3].line, kFirstDataLine + 5);
  EXPECT_EQ(o.file.error().line, kFirstDataLine);
  EXPECT_EQ(o.file.error().message,
            "the file cannot be read as Part 21: 4 faults; the first: #1 " + o.said[0].message);
}

TEST(Parse, CapsTheFaultsItReports) {
  std::string text;
  for (int i = 0; i < 60; ++i) text += "#0=A();\n";
  const Outcome o = read(data_file(text));
  EXPECT_EQ(o.said.size(), 51U);
  EXPECT_EQ(o.said.back().message, "and 10 more errors");
}

TEST(Parse, CountsLinesThroughCommentsStringsAndCarriageReturns) {
  for (const std::string end : {"\n", "\r\n"}) {
    std::string text = data_file("/* one\ntwo */ #1=A(\n'x');\n#2=B('y\nz');\n#3=C();");
    std::string with_ends;
    for (const char c : text) with_ends += c == '\n' ? end : std::string(1, c);
    const Outcome o = read(with_ends);
    ASSERT_TRUE(o.file);
    EXPECT_EQ(o.file->find(1)->line(), kFirstDataLine + 1);
    EXPECT_EQ(o.file->find(2)->line(), kFirstDataLine + 3);
    EXPECT_EQ(o.file->find(3)->line(), kFirstDataLine + 5);
  }
}

TEST(Parse, StopsWhenTheJobIsAskedTo) {
  Job job;
  job.request_stop();
  const auto file = parse(data_file("#1=A();"), "f", {}, job);
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, "P21-STOPPED");
}

TEST(Parse, ViewsOutliveTheMoveOfAFile) {
  File f = read_clean(data_file("#1=A('short');"));
  const Value v = f.instance(0).parameters();
  const File moved = std::move(f);
  EXPECT_EQ(v[0].as_text(), "short");
}

TEST(CheckReferences, NamesWhatDanglesAnywhereInAnInstance) {
  const File f = read_clean(data_file("#1=A(#1,(#9,T(#8)));\n#2=(B(#7)C(#1));"));
  Job job;
  EXPECT_EQ(check_references(f, job), 3U);
  ASSERT_EQ(job.diagnostics().size(), 3U);
  EXPECT_EQ(job.diagnostics()[0].instance, 1U);
  EXPECT_EQ(job.diagnostics()[0].severity, Severity::kWarning);
  EXPECT_EQ(job.diagnostics()[2].instance, 2U);
  EXPECT_NE(job.diagnostics()[2].message.find("#7"), std::string::npos);
  Job capped;
  EXPECT_EQ(check_references(f, capped, 1), 3U);
  EXPECT_EQ(capped.diagnostics().size(), 2U);
}

// The short way (one multiplication or division) must agree with strtod to the last bit.
TEST(Reals, AreRoundedCorrectly) {
  std::mt19937_64 random(20260101);
  std::string text = "#1=A(0.";
  std::vector<double> expected{0.0};
  for (int i = 0; i < 20000; ++i) {
    std::string lexeme = random() % 2 == 0 ? "-" : "";
    const std::size_t digits = 1 + random() % 20;
    const std::size_t point = 1 + random() % digits;
    for (std::size_t d = 0; d < digits; ++d) {
      lexeme += static_cast<char>('0' + random() % 10);
      if (d + 1 == point) lexeme += '.';
    }
    if (random() % 2 == 0) lexeme += "E" + std::to_string(static_cast<int>(random() % 560) - 280);
    text += "," + lexeme;
    expected.push_back(std::strtod(lexeme.c_str(), nullptr));
  }
  const File f = read_clean(data_file(text + ");"));
  const Value p = f.instance(0).parameters();
  ASSERT_EQ(p.size(), expected.size());
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(p[i].as_real(), expected[i]) << p[i].lexeme();
}

TEST(Reals, BeyondTheShortWayAreReadToo) {
  const File f =
      read_clean(data_file("#1=A(1.7976931348623157E308,4.9E-324,0.1000000000000000055511151231257827,-0.,+2."
                           "5,9007199254740993.);"));
  const Value p = f.instance(0).parameters();
  EXPECT_EQ(p[0].as_real(), std::numeric_limits<double>::max());
  EXPECT_EQ(p[1].as_real(), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(p[2].as_real(), 0.1);
  EXPECT_TRUE(std::signbit(p[3].as_real()));
  EXPECT_EQ(p[4].as_real(), 2.5);
  EXPECT_EQ(p[5].as_real(), 9007199254740992.0);  // a tie, to even
}

}  // namespace
}  // namespace capstan::p21::testing
