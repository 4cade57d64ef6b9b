#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "tests/door/app/programs.h"
#include "tests/support/corpus.h"

// Files of our own that somebody edited since: `check` judges what they say, not what we would plan.

namespace capstan::app {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class CheckedAsWritten : public ::testing::Test {
 protected:
  void SetUp() override {
    run("plan '" + capstan::testing::source_dir() + "/examples/two_setups.p21' -o p.stpnc");
    std::ifstream in(folder_ / "p.stpnc", std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    text_ = text.str();
    ASSERT_FALSE(text_.empty()) << said_;
  }
  int run(const std::string& arguments) {
    const std::string line =
        "cd '" + folder_.string() + "' && " + command_quoted() + " " + arguments + " >out 2>&1";
    const int status = std::system(line.c_str());
    std::ifstream in(folder_ / "out", std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    said_ = text.str();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  int checked(const std::string& text) {
    std::ofstream(folder_ / "edited.stpnc", std::ios::binary) << text;
    return run("check edited.stpnc");
  }

  ::capstan::testing::ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
  std::string said_, text_;
};

TEST_F(CheckedAsWritten, NothingIsFoundInTheFileAsItWasPlanned) { EXPECT_EQ(checked(text_), 0) << said_; }

TEST_F(CheckedAsWritten, APlanOrAToolTableThatIsEmptyOrSomethingElseIsNotCheckedAsAProgram) {
  for (const std::string name : {"e.json", "e.tbl", "e.STPNC"}) {
    std::ofstream(folder_ / name, std::ios::binary) << " \n";
    EXPECT_EQ(run("check " + name), 3) << said_;
    EXPECT_THAT(said_, HasSubstr(name + ": error: the file is empty")) << said_;
    std::ofstream(folder_ / name, std::ios::binary) << "hello\n";
    EXPECT_EQ(run("check " + name), 3) << said_;
    EXPECT_THAT(said_, HasSubstr("its content is not what its name says")) << said_;
  }
  std::ofstream(folder_ / "e.ngc", std::ios::binary) << "M2\n";
  EXPECT_EQ(run("check e.ngc"), 1) << said_;
  EXPECT_THAT(said_, HasSubstr("CHK-END-LOW")) << "a program, and checked as one";
}

TEST_F(CheckedAsWritten, TripledFeedsAreFound) {
  static const std::regex kFeed(R"((REPRESENTATION_ITEM\('feed speed',NUMERIC_MEASURE\()([0-9.E+-]+))");
  std::string tripled;
  std::size_t n = 0;
  auto from = text_.cbegin();
  for (std::sregex_iterator it(text_.begin(), text_.end(), kFeed), end; it != end; ++it, ++n) {
    tripled.append(from, (*it)[2].first);
    std::ostringstream number;
    number << std::fixed << 3.0 * std::stod((*it)[2].str());
    tripled += number.str();
    from = (*it)[2].second;
  }
  tripled.append(from, text_.cend());
  ASSERT_GT(n, 0U);
  EXPECT_EQ(checked(tripled), 1) << said_;
  EXPECT_THAT(said_, HasSubstr("CHK-FEED"));
}

TEST_F(CheckedAsWritten, APointMovedBelowWhatItCutsIsFound) {
  // The first point of a path at cutting depth, 10 mm lower.
  static const std::regex kPoint(R"((=CARTESIAN_POINT\('',\([0-9.E+-]+,[0-9.E+-]+,)(-[0-9.E+-]+)(\)\);))");
  static const std::regex kCurve(R"(=POLYLINE\('',\((#[0-9,#]+)\)\);)");
  bool found = false;
  for (std::sregex_iterator c(text_.begin(), text_.end(), kCurve), end; c != end && !found; ++c) {
    std::istringstream ids((*c)[1].str());
    for (std::string id; std::getline(ids, id, ',') && !found;) {
      const auto at = text_.find("\n" + id + "=CARTESIAN_POINT('',(");
      if (at == std::string::npos) continue;
      const auto line_end = text_.find('\n', at + 1);
      const std::string line = text_.substr(at, line_end - at);
      std::smatch m;
      if (!std::regex_search(line, m, kPoint)) continue;
      std::ostringstream z;
      z << std::fixed << std::stod(m[2].str()) - 10.0;
      text_.replace(at + static_cast<std::size_t>(m.position(2)), m[2].str().size(), z.str());
      found = true;
    }
  }
  ASSERT_TRUE(found);
  EXPECT_NE(checked(text_), 0) << said_;
}

TEST_F(CheckedAsWritten, AToolLengthOfZeroIsFoundThoughProgramAndTableAgree) {
  // As a shop has it that measured no tool: the program was posted with that table, and says 0, too.
  ASSERT_EQ(run("plan '" + capstan::testing::source_dir() + "/examples/two_setups.p21' -o p.ngc -o p.tbl"), 0)
      << said_;
  const auto slurped = [&](const char* name) {
    std::ifstream in(folder_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string table =
      std::regex_replace(slurped("p.tbl"), std::regex(R"(( Z)[+][0-9.]+)"), "$1+0.000000");
  const std::string program =
      std::regex_replace(slurped("p.ngc"), std::regex(R"((CAPSTAN TOOL T.* length=)[0-9.]+)"), "$010");
  std::ofstream(folder_ / "zero.tbl", std::ios::binary) << table;
  std::ofstream(folder_ / "zero.ngc", std::ios::binary) << program;
  ASSERT_NE(table.find("Z+0.000000"), std::string::npos);
  ASSERT_NE(program.find("length=0 "), std::string::npos);
  EXPECT_NE(run("check zero.ngc zero.tbl"), 0);
  EXPECT_THAT(said_, HasSubstr("error: T1 has Z0 in the tool table: it is not measured"));
  EXPECT_THAT(said_, HasSubstr("[CHK-TOOL-OFFSET]"));
  // Named as the library it is the same table.
  EXPECT_NE(run("check zero.ngc --tools zero.tbl"), 0);
  EXPECT_THAT(said_, HasSubstr("error: T1 has Z0 in the tool table: it is not measured"));
}

}  // namespace
}  // namespace capstan::app
