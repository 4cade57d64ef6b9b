#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "planner/door/service/reading.h"

// A file of another kind that is given for a part.

namespace capstan::service {
namespace {

TEST(ForeignPart, EndsReadingWithOneErrorThatNamesItAndSaysWhatToDo) {
  for (const auto& [bytes, word] :
       {std::pair("0\r\nSECTION\r\n2\r\nENTITIES\r\n", "DXF drawing"), std::pair("%PDF-1.7\n%...", "PDF"),
        std::pair("; a comment\nG21\nG90 G1 X10 F200\nM2\n", "G-code"),
        std::pair("%\nO1000\nG21\n", "a program number"),
        std::pair("; PLATE\n0 BEGIN PGM PLATE MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-30\n", "Heidenhain"),
        std::pair("MSG(\"PLATE\")\nMCALL\nT=\"MILL\"\n", "Siemens")}) {
    Job job;
    const auto plan = read_plan(bytes, "part.xyz", job);
    ASSERT_FALSE(plan) << word;
    EXPECT_EQ(plan.error().code, "READ-FOREIGN");
    EXPECT_NE(plan.error().message.find(word), std::string::npos) << plan.error().message;
    EXPECT_EQ(plan.error().file, "part.xyz");
    EXPECT_TRUE(job.diagnostics().empty()) << "no fault of a reader for another format";
  }
}

}  // namespace
}  // namespace capstan::service
