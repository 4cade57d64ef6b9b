#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/door/app/command/command.h"
#include "tests/door/app/plans.h"

// Where a call may write, and what it leaves there.

namespace capstan::app {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Names = std::vector<std::string>;

class Outputs : public CommandTest {
 protected:
  void SetUp() override { put("plate.p21", plate_); }
  std::string plate_ = testing::drilled_plate();
};

TEST_F(Outputs, ThatAreInputsAreRefusedBeforeAnyWork) {
  fs::create_symlink("plate.p21", folder_ / "other.p21");
  fs::create_directory(folder_ / "sub");
  for (const char* name : {"plate.p21", "./plate.p21", "sub/../plate.p21", "other.p21"}) {
    const Ran r = run(std::string("plan plate.p21 -o ") + name);
    EXPECT_EQ(r.code, 2) << name;
    EXPECT_THAT(r.err, HasSubstr("is also read by the call")) << name;
    EXPECT_THAT(r.err, HasSubstr("--force"));
  }
  EXPECT_EQ(slurp(folder_ / "plate.p21"), plate_);
  put("shop.yaml", "not read: the outputs are judged first");
  EXPECT_THAT(run("plan plate.p21 --tools shop.yaml -o a.json -o shop.yaml").err, HasSubstr("OUT-INPUT"));
  EXPECT_THAT(run("convert plate.p21 -o plate.p21").err, HasSubstr("OUT-INPUT"));
  EXPECT_THAT(run("tools convert shop.yaml -o shop.yaml").err, HasSubstr("OUT-INPUT"));
}

// What the shop's settings name, and the files of a folder that is read, are inputs as well.
TEST_F(Outputs, ThatTheShopsSettingsNameAreRefusedToo) {
  fs::create_directory(folder_ / "rules");
  const std::string rules = "table: hole\nrows: []\n", material = "capstan_materials: 1\nmaterials: []\n";
  put("rules/ours.yaml", rules);
  put("ours.yaml", material);
  put("shop.yaml", "capstan_shop: 1\nmaterials: [ours.yaml]\nrules: rules\n");
  for (const char* name : {"ours.yaml", "shop.yaml", "rules/ours.yaml"}) {
    const Ran r = run(std::string("plan plate.p21 -o a.json -o ") + name);
    EXPECT_EQ(r.code, 2) << name;
    EXPECT_THAT(r.err, HasSubstr("OUT-INPUT")) << r.err;
  }
  EXPECT_EQ(slurp(folder_ / "ours.yaml"), material);
  EXPECT_EQ(slurp(folder_ / "rules/ours.yaml"), rules);
}

TEST_F(Outputs, ThatAreInputsAreReplacedWhenForced) {
  const Ran r = run("plan plate.p21 -o plate.p21 --force");
  EXPECT_LE(r.code, 1) << r.err;
  EXPECT_NE(slurp(folder_ / "plate.p21"), plate_);
  EXPECT_EQ(files(), Names{"plate.p21"});
}

TEST_F(Outputs, RefusedForTheirNamesLeaveWhatIsThereAlone) {
  put("part.ngc", plate_);
  EXPECT_EQ(run("plan part.ngc -o part.ngc").code, 2);
  EXPECT_EQ(slurp(folder_ / "part.ngc"), plate_);
  EXPECT_EQ(files(), (Names{"part.ngc", "plate.p21"}));
}

TEST_F(Outputs, FromBeforeGoAsideAlsoWhereAnotherNameIsWrong) {
  put("a.ngc", "old");
  EXPECT_EQ(run("plan plate.p21 -o a.ngc -o b.xyz").code, 2);
  EXPECT_EQ(files(), (Names{"a.ngc.before", "plate.p21"}));
}

TEST_F(Outputs, FromBeforeThatALinkLeadsToGoAsideAndTheLinkStays) {
  put("real.ngc", "old");
  fs::create_symlink("real.ngc", folder_ / "now.ngc");
  EXPECT_EQ(run("plan plate.p21 --machine nowhere.yaml -o now.ngc").code, 3);
  EXPECT_EQ(files(), (Names{"now.ngc", "plate.p21", "real.ngc.before"}));
  EXPECT_LE(run("plan plate.p21 --allow-findings -o now.ngc").code, 1);
  EXPECT_EQ(files(), (Names{"now.ngc", "plate.p21", "real.ngc", "real.ngc.before"}));
}

TEST_F(Outputs, OfOnePathAreRefusedAlsoByAnotherName) {
  fs::create_symlink("a.json", folder_ / "b.json");
  for (const char* pair : {"-o a.json -o a.json", "-o a.json -o ./a.json"}) {
    const Ran r = run(std::string("plan plate.p21 ") + pair);
    EXPECT_EQ(r.code, 2);
    EXPECT_THAT(r.err, HasSubstr("is named twice")) << pair;
  }
  put("a.json", "x");
  EXPECT_THAT(run("plan plate.p21 -o a.json -o b.json").err, HasSubstr("OUT-TWICE"));
  EXPECT_EQ(slurp(folder_ / "a.json"), "x");
}

TEST_F(Outputs, ThatCannotBeWrittenAreFoundBeforePlanning) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.json").c_str(), 0600), 0);
  for (const char* name : {"nowhere/a.json", "/proc/capstan.json", "pipe.json"}) {
    // The machine that is not there is looked for only after.
    const Ran r = run(std::string("plan plate.p21 --machine nowhere.yaml -o b.json -o ") + name);
    EXPECT_EQ(r.code, 2) << name;
    EXPECT_THAT(r.err, HasSubstr("FILE-WRITE")) << r.err;
    EXPECT_THAT(r.err, ::testing::Not(HasSubstr("nowhere.yaml"))) << r.err;
  }
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe.json"));
  EXPECT_EQ(files(), (Names{"pipe.json", "plate.p21"}));
}

}  // namespace
}  // namespace capstan::app
