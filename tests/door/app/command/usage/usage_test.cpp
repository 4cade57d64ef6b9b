#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "planner/door/app/command/options.h"
#include "planner/door/app/command/reference.h"
#include "planner/door/app/command/usage/examples.h"
#include "planner/door/app/command/usage/mistyped.h"
#include "tests/door/app/command/command.h"
#include "tests/door/app/plans.h"
#include "tests/door/app/programs.h"

// How the command behaves beside what it does.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

TEST_F(CommandTest, AMistypedWordIsToldWithWhatItMayMean) {
  const Ran command = run("plna part.p21 -o a.json");
  EXPECT_EQ(command.code, 2);
  EXPECT_THAT(command.err, HasSubstr("unknown command 'plna'. Did you mean 'plan'"));
  const Ran below = run("tools lisst");
  EXPECT_EQ(below.code, 2);
  EXPECT_THAT(below.err, HasSubstr("unknown command 'lisst'. Did you mean 'list'"));
  const Ran option = run("plan part.p21 -o a.json --materail C45");
  EXPECT_EQ(option.code, 2);
  EXPECT_THAT(option.err, HasSubstr("unknown option '--materail'. Did you mean '--material'"));
  const Ran choice = run("plan part.p21 -o a.json --objective tme");
  EXPECT_EQ(choice.code, 2);
  EXPECT_THAT(choice.err, HasSubstr("'tme'. Did you mean 'time'"));
}

TEST_F(CommandTest, WrongUsageIsJsonWhereThatIsAsked) {
  for (const char* line : {"--diagnostics json plna", "plan --diagnostics=json",
                           "plan p.p21 -o a.json --diagnostics json --threads 0",
                           "plan p.p21 -o a.json --diagnostics json --revenue 5"}) {
    const Ran r = run(line);
    EXPECT_EQ(r.code, 2) << line;
    std::istringstream lines(r.err);
    int count = 0;
    for (std::string text; std::getline(lines, text); ++count) {
      const auto d = nlohmann::json::parse(text, nullptr, false);
      ASSERT_FALSE(d.is_discarded()) << line << ": " << text;
      EXPECT_EQ(d.value("severity", ""), "error") << text;
      EXPECT_FALSE(d.value("message", "").empty()) << text;
    }
    EXPECT_EQ(count, 1) << line;
  }
}

TEST_F(CommandTest, HelpOfACommandIsItsHelp) {
  EXPECT_EQ(run("help plan").out, run("plan --help").out);
  EXPECT_EQ(run("help tools list").out, run("tools list --help").out);
  EXPECT_EQ(run("help").code, 0);
}

TEST_F(CommandTest, HelpOfACommandThatIsNoneIsAnErrorWithWhatItMayMean) {
  for (const char* line : {"help plna", "plna --help"}) {
    const Ran r = run(line);
    EXPECT_EQ(r.code, 2) << line;
    EXPECT_THAT(r.out, IsEmpty()) << line;
    EXPECT_THAT(r.err, HasSubstr("unknown command 'plna'. Did you mean 'plan'")) << line;
  }
  EXPECT_EQ(run("help tools lisst").code, 2);
  EXPECT_EQ(run("help nonsense").code, 2);
  EXPECT_EQ(run("help help").out, run("--help").out);
  EXPECT_EQ(run("--version").code, 0);
}

/// Every command by the words that call it.
void each(const CommandText& c, const std::string& called,
          const std::function<void(const CommandText&, const std::string&)>& f) {
  f(c, called);
  for (const CommandText& sub : c.commands) each(sub, called + " " + sub.name, f);
}

TEST(Examples, EveryCommandShowsOnesThatItUnderstands) {
  const CommandText all = command_reference();
  each(all, "capstan", [&](const CommandText& c, const std::string& called) {
    const std::string_view examples = examples_of(called);
    ASSERT_FALSE(examples.empty()) << called;
    EXPECT_THAT(c.notes, HasSubstr("Examples:\n  capstan ")) << called;
    std::istringstream lines{std::string(examples)};
    for (std::string line; std::getline(lines, line);) {
      EXPECT_THAT(line, StartsWith("capstan ")) << called;
      // Words as a shell parts them.
      std::vector<std::string> words(1);
      bool quoted = false;
      for (const char ch : line) {
        if (ch == '\'') {
          quoted = !quoted;
        } else if (ch == ' ' && !quoted) {
          words.emplace_back();
        } else {
          words.back() += ch;
        }
      }
      std::vector<const char*> argv;
      for (const std::string& w : words) argv.push_back(w.c_str());
      const auto parsed = parse_command_line(static_cast<int>(argv.size()), argv.data());
      // What names a folder that is not here is refused for that alone.
      const bool no_folder = parsed.ending.text.find("is no folder") != std::string::npos;
      EXPECT_TRUE(parsed.options.has_value() || no_folder) << line << ": " << parsed.ending.text;
    }
  });
}

TEST_F(CommandTest, QuietTellsErrorsAlone) {
  put("plate.p21", testing::drilled_plate());
  const Ran usual = run("convert plate.p21 -o plate.stpnc");
  EXPECT_THAT(usual.err, HasSubstr("note:"));
  const Ran quiet = run("-q convert plate.p21 -o again.stpnc");
  EXPECT_EQ(quiet.code, 0);
  EXPECT_THAT(quiet.err, IsEmpty());
  const Ran failed = run("-q inspect missing.p21");
  EXPECT_EQ(failed.code, 3);
  EXPECT_THAT(failed.err, HasSubstr("error:"));
  const Ran json = run("-q --diagnostics json convert plate.p21 -o third.stpnc");
  EXPECT_EQ(json.code, 0);
  EXPECT_THAT(json.err, IsEmpty());
  const Ran failed_json = run("-q --diagnostics json inspect missing.p21");
  EXPECT_THAT(failed_json.err, HasSubstr("\"error\""));
  EXPECT_EQ(run("-q -v inspect plate.p21").code, 2) << "they exclude each other";
}

TEST_F(CommandTest, VerboseFoldsNothing) {
  put("plate.p21", testing::drilled_plate());
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  EXPECT_GE(lines(run("-v convert plate.p21 -o plate.stpnc").err),
            lines(run("convert plate.p21 -o b.stpnc").err));
}

TEST_F(CommandTest, ProgressIsJsonOffATerminalWhereThatIsAsked) {
  put("plate.p21", testing::drilled_plate());
  const Ran r = run("plan plate.p21 -o a.json --progress json");
  std::istringstream lines(r.err);
  int told = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto d = nlohmann::json::parse(line, nullptr, false);
    if (d.is_discarded() || d.value("code", "") != "PROGRESS") continue;
    ++told;
    EXPECT_FALSE(d.value("stage", "").empty());
    EXPECT_GE(d.value("fraction", -1.0), 0.0);
    EXPECT_LE(d.value("fraction", 2.0), 1.0);
  }
  EXPECT_GE(told, 1) << r.err;
  EXPECT_THAT(run("plan plate.p21 -o b.json").err, Not(HasSubstr("PROGRESS")));
}

TEST_F(CommandTest, ColoursAreForATerminal) {
  EXPECT_THAT(run("inspect missing.p21").err, Not(HasSubstr("\033[")));
  // `script` gives the command a terminal of its own.
  const std::string command =
      "script -qec \"" + command_quoted() + " inspect missing.p21\" /dev/null </dev/null";
  const auto on_terminal = [&](const std::string& setting) {
    const std::string line =
        "cd '" + folder_.string() + "' && " + setting + " TERM=xterm " + command + " >stdout.txt 2>&1";
    (void)std::system(line.c_str());
    return slurp(folder_ / "stdout.txt");
  };
  const std::string coloured = on_terminal("env -u NO_COLOR");
  if (coloured.find("missing.p21") == std::string::npos) GTEST_SKIP() << "no `script` here: " << coloured;
  EXPECT_THAT(coloured, HasSubstr("\033[1;31merror:\033[0m"));
  EXPECT_THAT(on_terminal("NO_COLOR=1"), Not(HasSubstr("\033[1;31m")));
}

TEST_F(CommandTest, AReaderThatHasEnoughIsNoError) {
  for (const char* text : {"rules list", "tools list", "materials list"}) {
    const std::string line = "cd '" + folder_.string() + "' && bash -c \"set -o pipefail; " +
                             command_quoted() + " " + text + " 2>stderr.txt | head -n 1 >stdout.txt\"";
    const int status = std::system(line.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 0) << text;
    EXPECT_THAT(slurp(folder_ / "stderr.txt"), IsEmpty()) << text;
  }
}

constexpr const char* kDrawing = "  0\nSECTION\n  2\nHEADER\n  0\nENDSEC\n";

TEST_F(CommandTest, AFileGivenByMistakeIsToldForWhatItIs) {
  put("part.dxf", kDrawing);
  put("part.pdf", "%PDF-1.7\n");
  put("part.sldprt", "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1....");
  put("part.ngc", "G21 G90\nG0 X0 Y0\nG1 Z-1 F100\nM2\n");
  put("part.sat",
      "400 30 1 0\n16 Autodesk AutoCAD 8 ACIS 4.0 24 Mon Jan 01 00:00:00 2001\n1 9.9e-07 1e-10\n");
  put("part.txt", "%\nO1000\nG21\n");
  put("part.h", "0 BEGIN PGM PART MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n2 TOOL CALL 1 Z S2000\n");
  put("part.mpf", ";PART\nG17 G40 G90 G94 G710\nMCALL\nT=\"MILL\" M6\nG0 SUPA Z0 D0\n");
  const std::vector<std::string> given = files();
  for (const auto& [name, word] :
       {std::pair("part.dxf", "DXF drawing"), std::pair("part.pdf", "PDF"),
        std::pair("part.sldprt", "SolidWorks"), std::pair("part.ngc", "G-code"),
        std::pair("part.sat", "ACIS"), std::pair("part.txt", "a program"),
        std::pair("part.h", "a program for Heidenhain"), std::pair("part.mpf", "a program")}) {
    const Ran r = run(std::string("plan ") + name + " -o a.json");
    EXPECT_EQ(r.code, 3) << name;
    EXPECT_THAT(r.err, HasSubstr(word)) << name;
    EXPECT_THAT(r.err, HasSubstr("READ-FOREIGN")) << name;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 2) << r.err;  // the fault, and the last line
  }
  EXPECT_EQ(files(), given);
}

TEST_F(CommandTest, ADrawingIsNoProgramAndNoDataOfTheShop) {
  put("plate.p21", testing::drilled_plate());
  put("part.dxf", kDrawing);
  put("part.png", std::string("\x89PNG\r\n\x1A\n\0\0", 10));
  put("part.fcstd", "PK\x03\x04....");
  for (const auto& [arguments, word] :
       {std::pair("check part.dxf", "DXF drawing"), std::pair("check part.png", "PNG picture"),
        std::pair("check part.fcstd", "ZIP archive"),
        std::pair("plan plate.p21 --machine part.dxf -o a.json", "DXF drawing"),
        std::pair("plan plate.p21 --tools part.dxf -o a.json", "DXF drawing"),
        std::pair("tools list --tools part.dxf", "DXF drawing"),
        std::pair("tools import part.dxf", "DXF drawing")}) {
    const Ran r = run(arguments);
    EXPECT_THAT(r.code, ::testing::AnyOf(2, 3)) << arguments;
    EXPECT_THAT(r.err, HasSubstr(word)) << arguments;
    EXPECT_THAT(r.err, HasSubstr("; 1 error, ")) << "not one for each key that is missing";
  }
}

TEST_F(CommandTest, AFilterThatNoCutterFitsIsAnErrorThatNamesTheOptionForAFile) {
  put("part.dxf", kDrawing);
  const Ran file = run("tools list part.dxf");
  EXPECT_EQ(file.code, 2);
  EXPECT_THAT(file.out, IsEmpty());
  EXPECT_THAT(file.err, HasSubstr("--tools part.dxf"));
  EXPECT_EQ(run("tools list nonesuch").code, 2);
  EXPECT_EQ(run("tools list drill").code, 0);
}

TEST_F(CommandTest, ShopInitWritesAFileOnceAndShowSaysWhatHolds) {
  const Ran init = run("shop init");
  EXPECT_EQ(init.code, 0) << init.err;
  EXPECT_THAT(init.err, HasSubstr("wrote shop.yaml"));
  const std::string before = slurp(folder_ / "shop.yaml");
  EXPECT_THAT(before, HasSubstr("\n# machine: "));
  const Ran again = run("shop init");
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("there already"));
  EXPECT_EQ(slurp(folder_ / "shop.yaml"), before);
  put("shop.yaml", "capstan_shop: 1\nmachine: small_router\n");
  EXPECT_THAT(run("shop show").out, HasSubstr("machine: small_router"));
  put("plate.p21", testing::drilled_plate());
  EXPECT_THAT(run("plan plate.p21 -o a.json --bind none").err, HasSubstr("settings of shop.yaml: machine"));
  EXPECT_THAT(slurp(folder_ / "a.json"), HasSubstr("shop.yaml: machine small_router"));
  EXPECT_THAT(run("plan plate.p21 -o b.json --bind none --shop none").err, Not(HasSubstr("settings of")));
  EXPECT_THAT(slurp(folder_ / "b.json"), HasSubstr("generic_vmc"));
  EXPECT_EQ(run("plan plate.p21 -o c.json --shop nowhere.yaml").code, 2);
}

TEST_F(CommandTest, AShopFileOfTheUserIsFoundWhereTheFolderHasNone) {
  std::filesystem::create_directories(folder_ / "config" / "capstan");
  put("config/capstan/shop.yaml", "capstan_shop: 1\nmachine: small_router\n");
  ::setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
  EXPECT_THAT(run("shop show").out, HasSubstr("config/capstan/shop.yaml"));
  put("shop.yaml", "capstan_shop: 1\nmachine: generic_vmc\n");
  EXPECT_THAT(run("shop show").out, HasSubstr("machine: generic_vmc")) << "this folder's comes first";
  ::unsetenv("XDG_CONFIG_HOME");
}

TEST_F(CommandTest, WhatComesWithThePlannerIsListedAndShown) {
  for (const auto& [kind, id, word] :
       {std::tuple("machines", "generic_vmc", "spindle"), std::tuple("fixtures", "vise_125", "25000"),
        std::tuple("controls", "linuxcnc", ".ngc"),
        std::tuple("controls", "haas", "renishaw_9811, which the shop confirms"),
        std::tuple("materials", "c45", "ISO 513 P")}) {
    EXPECT_THAT(run(std::string(kind) + " list").out, HasSubstr(id)) << kind;
    const Ran page = run(std::string(kind) + " show " + id);
    EXPECT_EQ(page.code, 0) << kind << page.err;
    EXPECT_THAT(page.out, HasSubstr(word)) << kind;
    const Ran wrong = run(std::string(kind) + " show nonesuch_" + id);
    EXPECT_EQ(wrong.code, 2) << kind;
    EXPECT_THAT(wrong.err, HasSubstr("list` shows all")) << kind;
  }
}

}  // namespace
}  // namespace capstan::app
