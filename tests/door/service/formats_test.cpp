#include "planner/door/service/formats.h"

#include <gtest/gtest.h>

#include <set>

#include "planner/controls/controls.h"
#include "planner/door/report/print.h"
#include "planner/door/service/outputs.h"
#include "planner/door/service/reading.h"

namespace capstan::service {
namespace {

TEST(Formats, NamesAndEndingsAreUnique) {
  std::set<std::string_view> names, endings;
  for (const Format& f : formats()) {
    EXPECT_TRUE(names.insert(f.name).second) << f.name;
    EXPECT_FALSE(f.endings.empty()) << f.name;
    for (const std::string_view e : f.endings) EXPECT_TRUE(endings.insert(e).second) << e;
    EXPECT_EQ(f.of_program() && f.write != nullptr, f.control != nullptr) << f.name;
  }
}

TEST(Formats, EachControlHasAProgramAndThoseThatReadOneAToolTable) {
  for (const controls::Dialect* d : controls::dialects()) {
    for (const controls::FileKind& file : {d->program, d->tool_table}) {
      if (file.name.empty()) continue;
      ASSERT_NE(find_format(file.name), nullptr);
      EXPECT_TRUE(find_format(file.name)->is_read_by(d->id)) << d->id;
      EXPECT_EQ(format_of_ending(file.ending), find_format(file.name));
    }
    EXPECT_EQ(d->tool_table.name.empty(), d->write_tool_table == nullptr) << d->id;
  }
}

TEST(Formats, AProgramOfAnotherControlThanTheMachinesIsRefused) {
  model::Plan plan;
  plan.machine.id = "mill";
  Job job;
  const auto written = write(plan, *find_format("fanuc"), job);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, "OUT-CONTROL");
  EXPECT_NE(written.error().hint.find("--control fanuc"), std::string::npos) << written.error().hint;
}

TEST(Formats, AnOutputsEndingTellsItsFormat) {
  for (const Format& f : formats()) {
    for (const std::string_view e : f.endings) {
      const auto output = output_of("a" + std::string(e));
      if (f.printed && !report::find_browser()) {
        EXPECT_EQ(output.error().code, "OUT-BROWSER") << e;
        continue;
      }
      EXPECT_EQ(output.has_value(), f.write != nullptr) << e;
      if (output) {
        EXPECT_EQ(output->format, &f) << e;
      }
    }
  }
  EXPECT_EQ(output_of("-")->format, find_format("json"));
  EXPECT_EQ(output_of("A.NGC")->format, find_format("linuxcnc"));
}

TEST(Formats, TextsForPeopleAreMadeOfTheTable) {
  EXPECT_EQ(written_endings(),
            ".p21, .stp, .stpnc, .238, .json, .ngc, .tbl, .nc, .mpf, .h, .gcode, .tap, .html, .pdf, .svg, "
            ".png or .yaml");
  EXPECT_EQ(written_text(),
            "ISO 14649 .p21 .stp, AP238 .stpnc .238, plan .json, program .ngc, tool table .tbl, program .nc, "
            "program .mpf, program .h, program .gcode, program .tap, "
            "report .html, set-up sheet .pdf, picture .svg, picture .png, edits .yaml");
  EXPECT_EQ(endings_of(Holds::kProgram), ".ngc, .nc, .mpf, .h, .gcode, .tap");
  EXPECT_EQ(read_text(),
            "ISO 14649 or AP238 file (.p21 .stp .stpnc .238), plan JSON, "
            "CAD part in STEP (AP203, AP214 or AP242), or STL mesh");
}

TEST(Formats, AByteOrderMarkIsNoPartOfTheContent) {
  EXPECT_EQ(content_of("\xEF\xBB\xBF {}"), Content::kPlanJson);
  EXPECT_EQ(content_of("{}"), Content::kPlanJson);
  EXPECT_EQ(content_of("T1 P1 D6"), Content::kToolTable);
  EXPECT_EQ(content_of("G0 X1"), Content::kProgram);
}

}  // namespace
}  // namespace capstan::service
