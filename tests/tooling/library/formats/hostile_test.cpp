#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/ground/base/job.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/library.h"

// Each bad input of a tool library, in each format that can say it: one clear error that names the file, the
// place and what was expected.

namespace capstan::tooling {
namespace {

using ::testing::HasSubstr;

struct Bad {
  std::string name, file, text, code;
  std::string place;    ///< in the path, or the line as a number
  std::string message;  ///< part of it
  std::uint64_t line = 0;
};

std::string fusion(const std::string& geometry, const std::string& unit = R"("unit": "millimeters",)",
                   const std::string& post = R"({"number": 1})") {
  return "{\"data\": [\n{\"type\": \"flat end mill\", " + unit +
         " \"guid\": \"g\", \"description\": \"bad one\",\n\"geometry\": " + geometry +
         ",\n\"post-process\": " + post + "}]}";
}
std::string csv(const std::string& row,
                const std::string& titles = "description,type,number,DC,flutes,LCF,OAL,unit") {
  return titles + "\ngood,drill,1,5,2,20,60,mm\n" + row + "\n";
}
std::string list(const std::string& fields, const std::string& unit = "unit: mm\n") {
  return "capstan_tools: 1\n" + unit + "tools:\n  - {id: bad, class: endmill, " + fields + "}\n";
}

std::vector<Bad> bad_inputs() {
  std::string deep = "{\"data\": ";
  deep.append(1'000'000, '[');
  std::string deep_yaml = "capstan_tools: 1\nunit: mm\ntools: ";
  deep_yaml.append(1'000'000, '[');
  const std::string good = R"({"DC": 6, "NOF": 3, "LCF": 20, "OAL": 60})";
  return {
      {"FusionDuplicateKey", "a.json", fusion(R"({"DC": 6, "DC": 8})"), "DATA-DUPLICATE", "",
       "'DC' is given twice", 3},
      {"FusionNesting", "a.json", deep, "JSON-DEPTH", "", "deeper than 64", 1},
      {"FusionNegative", "a.json", fusion(R"({"DC": 6, "NOF": -1})"), "TOOL-VALUE", "bad one', geometry.NOF",
       "-1", 3},
      {"FusionFraction", "a.json", fusion(R"({"DC": 6, "NOF": 3.9})"), "TOOL-VALUE", "geometry.NOF", "3.9",
       3},
      {"FusionByte", "a.json", fusion(R"({"DC": 6, "NOF": 300})"), "TOOL-VALUE", "geometry.NOF", "300", 3},
      {"FusionNan", "a.json", fusion(R"({"DC": NaN})"), "JSON-SYNTAX", "", "NaN", 3},
      {"FusionNanQuoted", "a.json", fusion(R"({"DC": "NaN"})"), "DATA-NUMBER", "geometry.DC", "NaN", 3},
      {"FusionHuge", "a.json", fusion(R"({"DC": 1e400})"), "DATA-NUMBER", "geometry.DC", "1e400", 3},
      {"FusionUnit", "a.json", fusion(good, ""), "DATA-UNIT", "bad one', unit", "missing", 2},
      {"FusionUnitUnknown", "a.json", fusion(good, R"("unit": "furlongs",)"), "DATA-UNIT", "unit", "furlongs",
       2},
      {"FusionZero", "a.json", fusion(R"({"DC": 0, "NOF": 3})"), "TOOL-VALUE", "bad one", "diameter DC is 0"},
      {"FusionFlutes", "a.json", fusion(R"({"DC": 6, "LCF": 70, "OAL": 60})"), "TOOL-VALUE", "bad one",
       "flutes are longer than the tool"},
      {"FusionComma", "a.json", fusion(R"({"DC": "6,5"})"), "DATA-NUMBER", "geometry.DC", "decimal comma", 3},
      {"FusionCommaBare", "a.json", fusion(R"({"DC": 6,5})"), "JSON-SYNTAX", "", "a key should be", 3},
      {"FusionToolNumber", "a.json", fusion(good, R"("unit": "inches",)", R"({"number": -4})"), "TOOL-NUMBER",
       "post-process.number", "-4", 4},
      {"FusionTruncated", "a.json", fusion(good).substr(0, 120), "JSON-SYNTAX", "", "ends", 3},

      {"CsvNegative", "a.csv", csv("bad,drill,2,5,-1,20,60,mm"), "TOOL-VALUE", "column 'flutes'", "-1", 3},
      {"CsvFraction", "a.csv", csv("bad,drill,2,5,3.9,20,60,mm"), "TOOL-VALUE", "column 'flutes'", "3.9", 3},
      {"CsvByte", "a.csv", csv("bad,drill,2,5,300,20,60,mm"), "TOOL-VALUE", "column 'flutes'", "300", 3},
      {"CsvNan", "a.csv", csv("bad,drill,2,NaN,2,20,60,mm"), "DATA-NUMBER", "column 'DC'", "NaN", 3},
      {"CsvHuge", "a.csv", csv("bad,drill,2,1e400,2,20,60,mm"), "DATA-NUMBER", "column 'DC'", "1e400", 3},
      {"CsvUnit", "a.csv", csv("bad,drill,2,5,2,20,60,"), "DATA-UNIT", "column 'DC'", "unit of DC is missing",
       3},
      {"CsvUnitUnknown", "a.csv", csv("bad,drill,2,5,2,20,60,ell"), "DATA-UNIT", "column 'unit'", "ell", 3},
      {"CsvNumber", "a.csv", csv("bad,drill,1,5,2,20,60,mm"), "TOOL-NUMBER", "column 'number'",
       "tool number 1 is given twice, first in line 2", 3},
      {"CsvZero", "a.csv", csv("bad,drill,2,0,2,20,60,mm"), "TOOL-VALUE", "bad", "diameter DC is 0"},
      {"CsvFlutes", "a.csv", csv("bad,drill,2,5,2,70,60,mm"), "TOOL-VALUE", "bad", "flutes are longer"},
      {"CsvCommaSplits", "a.csv", csv("bad,drill,2,5,5,2,20,60,mm"), "CSV-SYNTAX", "", "9 cells", 3},
      {"CsvComma", "a.csv", csv("bad,drill,2,\"5,5\",2,20.5,60,mm"), "DATA-NUMBER", "column 'DC'",
       "decimal comma", 3},
      {"CsvQuote", "a.csv", csv("\"bad,drill,2,5,2,20,60,mm"), "CSV-SYNTAX", "", "does not end", 3},
      {"CsvUtf16", "a.csv", std::string("\xFF\xFE") + "d\0,\0D\0C\0\n", "LIBRARY-KIND", "", ""},

      {"TblDuplicateLetter", "a.tbl", "T1 P1 D6 D7 ;end mill\n", "DATA-DUPLICATE", "",
       "letter D is given twice", 1},
      {"TblNumber", "a.tbl", "T1 P1 D6 ;end mill\nT1 P2 D7 ;end mill\n", "TOOL-NUMBER", "", "first in line 1",
       2},
      {"TblNegative", "a.tbl", "T1 P1 D6 ;end mill\nT-1 P2 D6 ;end mill\n", "TOOL-NUMBER", "", "T-1", 2},
      {"TblFraction", "a.tbl", "T1.5 P1 D6 ;end mill\n", "TOOL-NUMBER", "", "T1.5", 1},
      {"TblNan", "a.tbl", "T1 P1 Dnan ;end mill\n", "TBL-SYNTAX", "", "Dnan", 1},
      {"TblHuge", "a.tbl", "T1 P1 D1e400 ;end mill\n", "TBL-SYNTAX", "", "1e400", 1},
      {"TblComma", "a.tbl", "T1 P1 D6,5 ;end mill\n", "TBL-SYNTAX", "", "decimal comma", 1},
      {"TblDiameter", "a.tbl", "T1 P1 D-6 ;end mill\n", "TOOL-VALUE", "", "negative", 1},
      {"TblTooWide", "a.tbl", "T1 P1 D60000 ;end mill\n", "TOOL-VALUE", "T1", "60000", 1},

      {"ListDuplicateKey", "a.yaml", list("cutting_diameter: 6, cutting_diameter: 8"), "DATA-DUPLICATE", "",
       "twice", 4},
      {"ListNesting", "a.yaml", deep_yaml, "DATA-SYNTAX", "", "", 3},
      {"ListFraction", "a.yaml", list("cutting_diameter: 6, teeth: 3.9"), "DATA-NUMBER", "teeth", "3.9", 4},
      {"ListNegative", "a.yaml", list("cutting_diameter: 6, teeth: -1"), "TOOL-VALUE", "bad", "-1", 4},
      {"ListByte", "a.yaml", list("cutting_diameter: 6, teeth: 300"), "TOOL-VALUE", "bad", "300", 4},
      {"ListNan", "a.yaml", list("cutting_diameter: .nan"), "DATA-NUMBER", "cutting_diameter", ".nan", 4},
      {"ListHuge", "a.yaml", list("cutting_diameter: 1e400"), "DATA-NUMBER", "cutting_diameter", "1e400", 4},
      {"ListUnit", "a.yaml", list("cutting_diameter: 6", ""), "DATA-UNIT", "unit", "missing"},
      {"ListZero", "a.yaml", list("cutting_diameter: 0"), "TOOL-VALUE", "bad", "zero", 4},
      {"ListFlutes", "a.yaml", list("cutting_diameter: 6, maximum_depth_of_cut: 40, stick_out: 30"),
       "TOOL-VALUE", "bad", "longer than the tool sticks out", 4},
      {"ListComma", "a.yaml", list("cutting_diameter: '6,5'"), "DATA-NUMBER", "cutting_diameter", "6,5", 4},

      {"Nothing", "a.bin", "what is this", "LIBRARY-KIND", "", "no tool library"},
      {"Empty", "a.bin", "", "LIBRARY-KIND", "", "no tool library"},
  };
}

class Hostile : public ::testing::TestWithParam<Bad> {};

TEST_P(Hostile, GetsOneClearError) {
  const Bad& bad = GetParam();
  Job job;
  const auto read = import_bytes(bad.text, bad.file, {}, job);
  if (bad.code.empty()) {
    ASSERT_TRUE(read);
    return;
  }
  ASSERT_FALSE(read);
  const Diagnostic& d = read.error();
  EXPECT_EQ(d.code, bad.code) << to_text(d);
  EXPECT_EQ(d.severity, Severity::kError);
  EXPECT_THAT(d.file, HasSubstr(bad.file));
  EXPECT_THAT(d.path, HasSubstr(bad.place)) << to_text(d);
  EXPECT_THAT(d.message, HasSubstr(bad.message)) << to_text(d);
  if (bad.line != 0) {
    EXPECT_EQ(d.line, bad.line) << to_text(d);
  }
  EXPECT_EQ(job.count(Severity::kError), 0u);  // the one error is the result's
  EXPECT_LT(to_text(d).size(), 1200u);
}
INSTANTIATE_TEST_SUITE_P(Library, Hostile, ::testing::ValuesIn(bad_inputs()),
                         [](const auto& one) { return one.param.name; });

TEST(HostileTable, ASecondDiameterColumnIsRefused) {
  Job job;
  const auto read = import_bytes("description,DC,unit,DC\nx,5,mm,6\n", "a.csv", {}, job);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, "DATA-DUPLICATE");
  FormatOptions both;
  both.column_map =
      "capstan_columns: 1\nunit: mm\ncolumns:\n  - {title: a, field: DC}\n  - {title: b, field: DC}\n";
  EXPECT_EQ(import_bytes("a,b\n5,6\n", "a.csv", both, job).error().code, "DATA-DUPLICATE");
}

TEST(HostileLibrary, TellsEveryFaultNotOnlyTheFirst) {
  Job job;
  const auto read = import_bytes(
      "description,type,DC,flutes,unit\na,drill,x,2,mm\nb,drill,5,2.5,mm\nc,drill,5,2,\n", "a.csv", {}, job);
  ASSERT_FALSE(read);
  EXPECT_EQ(job.count(Severity::kError), 2u);
  EXPECT_EQ(job.diagnostics()[0].line, 2u);
  EXPECT_EQ(job.diagnostics()[1].line, 3u);
  EXPECT_EQ(read.error().line, 4u);
}

}  // namespace
}  // namespace capstan::tooling
