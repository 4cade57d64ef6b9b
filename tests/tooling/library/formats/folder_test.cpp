#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "tests/support/corpus.h"
#include "tooling/library/formats/import.h"

// A folder of tool libraries, some of which cannot be read.

namespace capstan::tooling {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

constexpr const char* kGoodBit =
    R"({"version": 2, "name": "m", "shape": "endmill.fcstd", "parameter": {"Diameter": "5 mm"}})";
constexpr const char* kBitWithoutUnit =
    R"({"version": 2, "name": "m", "shape": "endmill.fcstd", "parameter": {"Diameter": "6"}})";

class Folder : public ::testing::Test {
 protected:
  void put(const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories(std::filesystem::path(scratch_.file(name)).parent_path());
    std::ofstream(scratch_.file(name), std::ios::binary) << bytes;
  }
  Result<Imported> read(Job& job) const { return import_library(scratch_.path(), {}, job); }
  [[nodiscard]] std::vector<Diagnostic> of(const Job& job, const std::string& name) const {
    std::vector<Diagnostic> out;
    for (const Diagnostic& d : job.diagnostics()) {
      if (d.file == scratch_.file(name)) out.push_back(d);
    }
    return out;
  }

  capstan::testing::ScratchFolder scratch_;
};

TEST_F(Folder, EachFileWithAFaultIsLeftOutAndToldOnceAndTheRestIsRead) {
  put("Bit/a_good.fctb", kGoodBit);
  put("Bit/b_cut_off.fctb", R"({"version": 2, "shape": "endm)");
  put("Bit/c_no_unit.fctb", kBitWithoutUnit);
  put("d_two_faults.tbl", "T1 P1 D6 Z80\nT2 P2 Dx\nT1 P3 D5\n");
  put("e_fusion.json", R"({"data": [{"type": "flat end mill", "unit": "millimeters", "geometry": {"DC": "x"}}]})");
  put("f_cut_off.json", R"({"data": [{"type": "flat end mill", "unit": "millimeters",)");
  put("g_cut_off.tools", "PK\x03\x04");
  put("h_good.yaml",
      "capstan_tools: 1\nunit: mm\ntools:\n  - {id: em6, class: endmill, cutting_diameter: 6, teeth: 3}\n");
  put("i_negative.yaml",
      "capstan_tools: 1\nunit: mm\ntools:\n  - {id: em7, class: endmill, cutting_diameter: -6, teeth: 3}\n");
  Job job;
  const auto r = read(job);
  ASSERT_TRUE(r) << to_text(r.error());
  ASSERT_EQ(r->library.items.size(), 2U);
  EXPECT_EQ(r->report.tools, 2U);
  for (const auto& [name, code] :
       {std::pair("Bit/b_cut_off.fctb", "JSON-SYNTAX"), std::pair("Bit/c_no_unit.fctb", "DATA-UNIT"),
        std::pair("d_two_faults.tbl", "TBL-SYNTAX"), std::pair("e_fusion.json", "DATA-NUMBER"),
        std::pair("f_cut_off.json", "JSON-SYNTAX"), std::pair("g_cut_off.tools", "LIBRARY-KIND"),
        std::pair("i_negative.yaml", "TOOL-VALUE")}) {
    const auto told = of(job, name);
    ASSERT_EQ(told.size(), 1U) << name;
    EXPECT_EQ(told.front().code, code) << to_text(told.front());
    EXPECT_EQ(told.front().severity, Severity::kWarning) << "as of one bad bit in an archive";
    EXPECT_THAT(told.front().message, HasSubstr("the file is left out"));
    EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::what, HasSubstr(name))));
  }
  EXPECT_THAT(of(job, "d_two_faults.tbl").front().message, HasSubstr("and 1 more fault of this file"));
  EXPECT_FALSE(job.has_errors());
}

TEST_F(Folder, ABitThatAListNamesIsToldOnceWhicheverIsReadFirst) {
  const std::string list =
      R"({"version": 1, "tools": [{"nr": 1, "path": "good.fctb"}, {"nr": 2, "path": "bad.fctb"}]})";
  for (const char* place : {"a/list.fctl", "z/list.fctl"}) put(place, list);
  put("a/Bit/good.fctb", kGoodBit);
  put("a/Bit/bad.fctb", kBitWithoutUnit);
  put("z/bad.fctb", R"({"version": 2, "shape": "endm)");
  put("z/good.fctb", kGoodBit);
  Job job;
  const auto r = read(job);
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->library.items.size(), 1U);
  EXPECT_EQ(of(job, "a/Bit/bad.fctb").size(), 1U);
  EXPECT_EQ(of(job, "z/bad.fctb").size(), 1U);
}

TEST_F(Folder, WithoutOneLibraryThatCanBeReadEveryFaultIsAnError) {
  put("a.fctb", kBitWithoutUnit);
  put("b.fctb", "{");
  Job job;
  const auto r = read(job);
  ASSERT_FALSE(r);
  EXPECT_EQ(of(job, "a.fctb").size(), 1U);
  EXPECT_EQ(r.error().file, scratch_.file("b.fctb"));  // the last is what ends it
  EXPECT_EQ(job.count(Severity::kError), 1U);
}

}  // namespace
}  // namespace capstan::tooling
