#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/door/app/programs.h"
#include "tests/support/corpus.h"

// Tool libraries through the built program: read, written, converted, with what is lost on the way.

namespace capstan::app {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class ToolsCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    put("mill.fctb", R"({"version": 2, "name": "Mill 5", "shape": "endmill.fcstd", "parameter": {
      "CuttingEdgeHeight": "20 mm", "Diameter": "5 mm", "Length": "50 mm", "ShankDiameter": "6 mm"},
      "attribute": {}})");
    put("own.yaml",
        "capstan_tools: 1\nunit: mm\ntools:\n"
        "  - {id: em6, class: endmill, cutting_diameter: 6, teeth: 3, stick_out: 25}\n"
        "  - {id: dr5, class: twist_drill, cutting_diameter: 5, teeth: 2, stick_out: 60}\n");
    put("bare.csv", "id,class,diameter\nem,endmill,0.5\n");
    put("nothing.txt", "no library at all\n");
  }
  /// Exit code; the two streams are kept.
  int run(const std::string& arguments) {
    std::string line = "cd '";
    line.append(folder_.string()).append("' && ").append(command_quoted()).append(" tools ").append(arguments);
    line.append(" >out.txt 2>err.txt");
    const int status = std::system(line.c_str());
    out_ = slurp("out.txt");
    err_ = slurp("err.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  [[nodiscard]] std::string slurp(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  [[nodiscard]] bool there(const std::string& name) const { return fs::exists(folder_ / name); }

  ::capstan::testing::ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
  std::string out_, err_;
};

TEST_F(ToolsCommand, WhatIsExportedIsTakenAgain) {
  ASSERT_EQ(run("export -o lib.yaml"), 0) << err_;
  ASSERT_EQ(run("list"), 0) << err_;
  const std::string shipped = out_;
  EXPECT_EQ(run("list --tools lib.yaml"), 0) << err_;
  EXPECT_EQ(out_, shipped);
}

TEST_F(ToolsCommand, ListsAndShowsWhatALibraryHolds) {
  EXPECT_EQ(run("list --tools own.yaml"), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("em6"));
  EXPECT_THAT(out_, HasSubstr("dr5"));
  EXPECT_EQ(run("show em6 --tools own.yaml"), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("cutting_diameter      6 mm"));
  EXPECT_THAT(out_, HasSubstr("stick_out             25 mm"));
}

TEST_F(ToolsCommand, ACutterThatIsNotThereIsAWrongUse) {
  EXPECT_EQ(run("show em7 --tools own.yaml"), 2);
  EXPECT_THAT(err_, HasSubstr("em7"));
}

TEST_F(ToolsCommand, ImportSaysWhatIsLostAndWritesTheRest) {
  EXPECT_EQ(run("import mill.fctb -o a.yaml"), 0) << err_;
  EXPECT_THAT(err_, HasSubstr("TOOLS-DROPPED"));
  EXPECT_THAT(err_, HasSubstr("read 1 tool from mill.fctb"));
  EXPECT_THAT(slurp("a.yaml"), HasSubstr("cutting_diameter: 5"));
  EXPECT_THAT(slurp("a.yaml"), HasSubstr("maximum_depth_of_cut: 20"));
}

TEST_F(ToolsCommand, AnImportOfALibraryWithoutToolsIsAnErrorAndWritesNothing) {
  put("none.csv", "id,class,diameter\n");
  put("none.json", "{\"data\": [], \"version\": 2}\n");
  for (const char* file : {"none.csv", "none.json"}) {
    EXPECT_EQ(run(std::string("import ") + file + " --unit mm -o a.yaml"), 3) << err_;
    EXPECT_THAT(err_, HasSubstr(std::string(file) + ": error: there is no tool in it"));
    EXPECT_FALSE(there("a.yaml"));
  }
}

TEST_F(ToolsCommand, WithoutAnOutputImportSaysWhatPlanningCanUse) {
  EXPECT_EQ(run("import own.yaml"), 0) << err_;
  EXPECT_THAT(err_, HasSubstr("planning can use 2"));
}

TEST_F(ToolsCommand, TheReportIsJsonOnStandardOutputAndNamesEveryField) {
  EXPECT_EQ(run("convert mill.fctb -o a.yaml --json"), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("\"read\": {"));
  EXPECT_THAT(out_, HasSubstr("\"written\": [{\"file\": \"a.yaml\""));
  EXPECT_THAT(out_, HasSubstr("\"dropped\": ["));
  EXPECT_THAT(out_, HasSubstr("\"field\": \"shape\""));
}

TEST_F(ToolsCommand, ConvertKeepsTheSizesThroughEveryFormatThatIsWritten) {
  for (const char* name : {"a.csv", "a.tools", "a.json", "a.sqlite", "a.p21", "a.zip"}) {
    EXPECT_EQ(run(std::string("convert own.yaml -o ") + name), 0) << name << "\n" << err_;
    EXPECT_EQ(run(std::string("list --tools ") + name), 0) << name << "\n" << err_;
    EXPECT_THAT(out_, ::testing::ContainsRegex("endmill +6 ")) << name;
    EXPECT_THAT(out_, ::testing::ContainsRegex("drill +5 ")) << name;
  }
}

TEST_F(ToolsCommand, ThereAreFormatsForMachinesThatAreOnlyWritten) {
  EXPECT_EQ(run("convert own.yaml -o a.xml"), 0) << err_;
  EXPECT_THAT(slurp("a.xml"), HasSubstr("MTConnectAssets"));
  EXPECT_EQ(run("list --tools a.xml"), 3);
}

TEST_F(ToolsCommand, ExportWritesTheLibraryThatPlanningUses) {
  EXPECT_EQ(run("export --tools own.yaml -o e.csv"), 0) << err_;
  EXPECT_THAT(slurp("e.csv"), HasSubstr("em6"));
  EXPECT_EQ(run("export -o g.yaml"), 0) << err_;
  EXPECT_THAT(slurp("g.yaml"), HasSubstr("generic/"));
}

TEST_F(ToolsCommand, AUnitThatTheFileLeavesOpenIsTheCallers) {
  EXPECT_EQ(run("import bare.csv --unit inch -o inch.yaml"), 0) << err_;
  EXPECT_EQ(run("show em --tools inch.yaml"), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("cutting_diameter      12.7 mm"));  // 0.5 x 25.4
  EXPECT_EQ(run("import bare.csv --unit mm -o mm.yaml"), 0) << err_;
  EXPECT_EQ(run("show em --tools mm.yaml"), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("cutting_diameter      0.5 mm"));
}

TEST_F(ToolsCommand, TheUnitOfABitWithoutOneIsTheCallers) {
  put("bare.fctb", R"({"version": 2, "name": "b", "shape": "endmill.fcstd", "parameter": {
      "CuttingEdgeHeight": "20", "Diameter": "6", "Length": "50", "ShankDiameter": "6"}, "attribute": {}})");
  EXPECT_EQ(run("import bare.fctb"), 3);
  EXPECT_THAT(err_, HasSubstr("--unit"));
  EXPECT_EQ(run("import bare.fctb --unit mm -o bit.yaml"), 0) << err_;
  EXPECT_THAT(slurp("bit.yaml"), HasSubstr("maximum_depth_of_cut: 20"));
}

TEST_F(ToolsCommand, LossesOfSizesAreToldBeforeThoseOfAnotherSystemsBookkeeping) {
  std::string tools;
  for (int n = 0; n < 3; ++n) {
    const std::string k = std::to_string(n);
    tools += (n > 0 ? ",\n" : "") +
             std::string(R"({"type": "ball end mill", "unit": "millimeters", "guid": "g)") + k +
             R"(", "description": "ball )" + k + R"(", "reference_guid": "r", "geometry":
             {"DC": 6, "LCF": 13, "LB": 30, "OAL": 57, "SFDM": 6, "NOF": 2, "RE": 3, "HAND": true},
             "post-process": {"turret": 0, "live": true}})";
  }
  put("fusion.json", "{\"data\": [" + tools + "]}");
  EXPECT_EQ(run("import fusion.json -o a.zip"), 0) << err_;
  EXPECT_THAT(err_, Not(HasSubstr("LCF")));
  const auto sizes = err_.find("3 tools, LPR, HAND: the shape Ballend has no parameter for it");
  const auto paths = err_.find("post-process.");
  ASSERT_NE(sizes, std::string::npos) << err_;
  ASSERT_NE(paths, std::string::npos) << err_;
  EXPECT_LT(sizes, paths);
}

TEST_F(ToolsCommand, LossesThatAMachinistMissesAreToldBeforeIdentifiers) {
  put("fusion.json",
      R"({"data": [{"type": "flat end mill", "unit": "millimeters", "guid": "g", "description": "8 flat",
    "geometry": {"DC": 8, "LCF": 19, "LB": 25, "OAL": 63, "SFDM": 8, "NOF": 3, "HAND": true},
    "post-process": {"number": 4, "length-offset": 9, "diameter-offset": 9},
    "start-values": {"presets": [{"guid": "b", "name": "Steel", "n": 3000, "v_f": 300, "f_z": 0.03}]}}],
    "version": 2})");
  for (const char* name : {"a.zip", "a.yaml"}) {
    EXPECT_EQ(run(std::string("convert fusion.json -o ") + name), 0) << err_;
    const auto offsets = err_.find("post-process.length-offset, post-process.diameter-offset");
    const auto guid = err_.find("presets.0.guid");
    ASSERT_NE(offsets, std::string::npos) << err_;
    ASSERT_NE(guid, std::string::npos) << err_;
    EXPECT_LT(offsets, guid) << err_;
    EXPECT_THAT(err_.substr(0, offsets), Not(HasSubstr("version"))) << name;
  }
}

TEST_F(ToolsCommand, ABitOfFreecadIsJsonAndOneTool) {
  EXPECT_EQ(run("convert mill.fctb -o one.fctb"), 0) << err_;
  EXPECT_THAT(slurp("one.fctb"), ::testing::StartsWith("{"));
  EXPECT_THAT(slurp("one.fctb"), HasSubstr("\"Diameter\": \"5 mm\""));
  EXPECT_EQ(run("list --tools one.fctb"), 0) << err_;
  EXPECT_EQ(run("convert own.yaml -o two.fctb"), 2);
  EXPECT_THAT(err_, HasSubstr("a .fctb holds one tool, and there are 2"));
  EXPECT_THAT(err_, HasSubstr(".fctl"));
  EXPECT_THAT(err_, HasSubstr(".zip"));
  EXPECT_FALSE(there("two.fctb"));
}

TEST_F(ToolsCommand, ALibraryOfFreecadIsJsonWithItsBitsBesideIt) {
  fs::create_directories(folder_ / "lib");
  EXPECT_EQ(run("convert own.yaml -o lib/shop.fctl"), 0) << err_;
  EXPECT_THAT(err_, HasSubstr("wrote lib/shop.fctl and 2 files beside it"));
  EXPECT_THAT(slurp("lib/shop.fctl"), HasSubstr("\"path\": \"em6.fctb\""));
  EXPECT_THAT(slurp("lib/dr5.fctb"), HasSubstr("\"Diameter\": \"5 mm\""));
  EXPECT_EQ(run("list --tools lib/shop.fctl"), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("em6"));
  EXPECT_THAT(out_, HasSubstr("dr5"));
  // Again: the same. Over a bit that says something else: not without --force.
  EXPECT_EQ(run("convert own.yaml -o lib/shop.fctl"), 0) << err_;
  put("lib/em6.fctb", "mine");
  put("lib/shop.fctl", "mine");
  EXPECT_EQ(run("convert own.yaml -o lib/shop.fctl"), 2);
  EXPECT_THAT(err_, HasSubstr("OUT-THERE"));
  EXPECT_EQ(slurp("lib/em6.fctb"), "mine");
  EXPECT_EQ(slurp("lib/shop.fctl"), "mine");
  EXPECT_EQ(run("convert own.yaml -o lib/shop.fctl --force"), 0) << err_;
  EXPECT_THAT(slurp("lib/em6.fctb"), ::testing::StartsWith("{"));
}

TEST_F(ToolsCommand, ALibraryInFreecadsOwnFolderHasItsBitsInTheFolderBit) {
  fs::create_directories(folder_ / "Library");
  fs::create_directories(folder_ / "Bit");
  EXPECT_EQ(run("convert own.yaml -o Library/shop.fctl"), 0) << err_;
  EXPECT_THAT(err_, HasSubstr("and 2 files in Bit"));
  EXPECT_TRUE(there("Bit/em6.fctb"));
  EXPECT_FALSE(there("Library/em6.fctb"));
  EXPECT_EQ(run("list --tools Library/shop.fctl"), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("dr5"));
}

TEST_F(ToolsCommand, OneBadFileOfAFolderIsToldAndTheRestIsRead) {
  fs::create_directories(folder_ / "lib");
  put("lib/good.fctb", slurp("mill.fctb"));
  put("lib/bad.fctb", R"({"shape": "endmill.fcstd", "parameter": {"Diameter": "6"}})");
  put("lib/cut.fctb", R"({"shape": "endm)");
  EXPECT_EQ(run("import lib -o a.yaml"), 0) << err_;
  EXPECT_THAT(err_, HasSubstr("lib/bad.fctb"));
  EXPECT_THAT(err_, HasSubstr("lib/cut.fctb"));
  EXPECT_THAT(err_, HasSubstr("read 1 tool from lib"));
  EXPECT_THAT(err_, HasSubstr("no error, 2 warnings"));
  EXPECT_TRUE(there("a.yaml"));
}

TEST_F(ToolsCommand, WrongUseEndsWithTwoAndWritesNothing) {
  EXPECT_EQ(run("import own.yaml --unit furlong -o a.csv"), 2);
  EXPECT_THAT(err_, HasSubstr("furlong"));
  EXPECT_EQ(run("convert own.yaml -o a.zzz"), 2);
  EXPECT_THAT(err_, HasSubstr("APP-FORMAT"));
  EXPECT_EQ(run("convert own.yaml"), 2);
  EXPECT_EQ(run("convert own.yaml -o a.csv --format cobol"), 2);
  EXPECT_EQ(run("import own.yaml --save-map m.yaml"), 2);
  EXPECT_FALSE(there("a.csv") || there("a.zzz") || there("m.yaml"));
}

TEST_F(ToolsCommand, WhatCannotBeReadEndsWithThreeAndWritesNothing) {
  EXPECT_EQ(run("import nothing.txt -o a.csv"), 3);
  EXPECT_THAT(err_, HasSubstr("LIBRARY-KIND"));
  EXPECT_EQ(run("import absent.csv -o a.csv"), 3);
  EXPECT_EQ(run("list --tools nothing.txt"), 3);
  EXPECT_FALSE(there("a.csv"));
}

TEST_F(ToolsCommand, AnOutputThatCannotBeWrittenIsFoundFirstAndEndsWithTwo) {
  EXPECT_EQ(run("convert own.yaml -o absent/a.csv"), 2);
  EXPECT_THAT(err_, HasSubstr("FILE-WRITE"));
  EXPECT_EQ(run("export --tools own.yaml -o absent/a.csv"), 2);
}

TEST_F(ToolsCommand, TheSameInputGivesTheSameBytes) {
  EXPECT_EQ(run("convert own.yaml -o a.csv -o a.yaml"), 0) << err_;
  EXPECT_EQ(run("convert own.yaml -o b.csv -o b.yaml"), 0) << err_;
  EXPECT_EQ(slurp("a.csv"), slurp("b.csv"));
  EXPECT_EQ(slurp("a.yaml"), slurp("b.yaml"));
}

}  // namespace
}  // namespace capstan::app
