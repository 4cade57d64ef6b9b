#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/door/app/command/command.h"

// `capstan check --schema`, run as a user runs it.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class SchemaTest : public CommandTest {
 protected:
  [[nodiscard]] Ran check(const std::string& schema, const std::string& data,
                          const std::string& options = "") const {
    put("file.stpnc",
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');"
        "\nFILE_SCHEMA(('" +
            schema + "'));\nENDSEC;\nDATA;\n" + data + "ENDSEC;\nEND-ISO-10303-21;\n");
    return run("check --schema " + options + " file.stpnc");
  }
};

constexpr const char* kAp238 = "MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA";

TEST_F(SchemaTest, EndsWithNothingWhereTheFileFollowsIt) {
  const Ran r = check(kAp238, "#1=CARTESIAN_POINT('',(0.,0.,0.));\n");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("Not proven safe: 1 file is compared with the schema only; 1 file checked;"));
  EXPECT_EQ(check("INTEGRATED_CNC_SCHEMA", "#1=CARTESIAN_POINT('',(0.,0.,0.));\n").code, 0);
}

TEST_F(SchemaTest, NamesFileLineInstanceAndWhatWasExpected) {
  const Ran r = check(kAp238, "#1=CARTESIAN_POINT('',(0.,0.,0.));\n#2=VECTOR('',#1,1.);\n");
  EXPECT_EQ(r.code, 1);
  EXPECT_THAT(r.err,
              HasSubstr("file.stpnc:9: error: #2 orientation: #1 is a CARTESIAN_POINT; expected DIRECTION"));
  EXPECT_THAT(r.err, HasSubstr("[SCH-TYPE]"));
  EXPECT_THAT(r.err, HasSubstr("1 deviation from the schema"));
}

TEST_F(SchemaTest, GivesFindingsAsJson) {
  const Ran r = check(kAp238, "#1=CARTESIAN_POINT($,(0.,0.,0.));\n", "--json");
  EXPECT_EQ(r.code, 1);
  EXPECT_THAT(r.out, HasSubstr("SCH-MANDATORY"));
  EXPECT_THAT(r.out, HasSubstr("#1 name: a mandatory value is missing"));
}

TEST_F(SchemaTest, RefusesOtherSchemasByName) {
  const Ran r = check("AUTOMOTIVE_DESIGN", "#1=CARTESIAN_POINT('',(0.,0.,0.));\n");
  EXPECT_EQ(r.code, 3);
  EXPECT_THAT(r.err, HasSubstr("AUTOMOTIVE_DESIGN"));
}

TEST_F(SchemaTest, RefusesWhatIsNotReadable) {
  EXPECT_EQ(check(kAp238, "#1=CARTESIAN_POINT('',(0.,0.;\n").code, 3);
}

}  // namespace
}  // namespace capstan::app
