#include <gtest/gtest.h>

#include <algorithm>

#include "planner/ground/vocabulary/control_options.h"
#include "planner/model/plan/resources/control_options.h"
#include "tests/support/corpus.h"
#include "tooling/shop/machine/machine.h"

// What a machine's file says of its control's own ways.

namespace capstan::tooling {
namespace {

std::string file_with(const std::string& control) {
  std::string text = testing::slurp(testing::source_dir() + "/tooling/data/machines/generic_vmc.yaml");
  const std::string of_shipped = "dialect: linuxcnc,";
  return text.replace(text.find(of_shipped), of_shipped.size(), control + ",");
}

TEST(ControlOptions, AreReadInTheOrderOfTheTableAndAskedByName) {
  Job job;
  const auto m = read_machine(
      file_with("dialect: fanuc, retract: g28, cycles: explicit, program_number: 1234"), "vmc.yaml", job);
  ASSERT_TRUE(m) << to_text(m.error());
  ASSERT_TRUE(m->control_options);
  EXPECT_EQ(m->control_options->chosen.size(), 3u);
  EXPECT_EQ(model::control_option(*m, "retract"), "g28");
  EXPECT_EQ(model::control_option(*m, "cycles"), "explicit");
  EXPECT_EQ(model::control_number(*m, "program_number", 0.0), 1234.0);
}

TEST(ControlOptions, ThatAreNotStatedAreAtTheDefaultsOfTheControl) {
  Job job;
  const auto fanuc = read_machine(file_with("dialect: fanuc"), "vmc.yaml", job);
  const auto haas = read_machine(file_with("dialect: haas"), "vmc.yaml", job);
  ASSERT_TRUE(fanuc && haas);
  EXPECT_FALSE(fanuc->control_options);
  EXPECT_EQ(model::control_option(*fanuc, "dwell"), "milliseconds");
  EXPECT_EQ(model::control_option(*haas, "dwell"), "seconds");
  EXPECT_EQ(model::control_option(*fanuc, "smoothness"), "");
  EXPECT_EQ(model::control_number(*fanuc, "peck_clearance_mm", -1.0), -1.0);
}

TEST(ControlOptions, OfAnotherControlOrWithAnotherValueAreRefusedWithFileLineAndWhatIsMeant) {
  struct Wrong {
    const char *control, *code, *says;
  };
  for (const Wrong& w :
       {Wrong{"dialect: fanuc, retract: g30", "MACHINE-CONTROL", "'g30' is none of: g53 g28"},
        Wrong{"dialect: fanuc, program_number: 12345", "MACHINE-CONTROL", "no whole number from 1 to 9999"},
        Wrong{"dialect: fanuc, subprograms: 9001", "MACHINE-CONTROL", "no whole number from 1 to 7999"},
        Wrong{"dialect: fanuc, program_number: 12.5", "MACHINE-CONTROL", "'12.5' is no whole number"},
        Wrong{"dialect: siemens, program_number: 12", "DATA-UNKNOWN", "program_number"},
        Wrong{"dialect: haas, subprograms: 7001", "DATA-UNKNOWN", "subprograms"},
        Wrong{"dialect: fanuc, smoothness: yes", "DATA-UNKNOWN", "smoothness"},
        Wrong{"dialect: fanuc, through_coolant: m88/m89", "MACHINE-CONTROL", "two M codes as M88/M89"},
        Wrong{"dialect: fanuc, through_coolant: M88", "MACHINE-CONTROL", "two M codes as M88/M89"},
        Wrong{"dialect: siemens, shop_codes: \"M51, M52\"", "MACHINE-CONTROL",
              "M codes with a blank between"},
        Wrong{"dialect: haas, probe_macro: renishaw_9812", "MACHINE-CONTROL",
              "no shipped macro of this control: renishaw_9811"},
        Wrong{"dialect: linuxcnc, probe_macro: renishaw_9811", "DATA-UNKNOWN", "probe_macro"},
        Wrong{"dialect: linuxcnc, retract: g28", "DATA-UNKNOWN", "retract"}}) {
    Job job;
    const auto m = read_machine(file_with(w.control), "vmc.yaml", job);
    ASSERT_FALSE(m) << w.control;
    EXPECT_EQ(m.error().code, w.code) << w.control;
    EXPECT_NE(m.error().message.find(w.says), std::string::npos) << m.error().message;
    EXPECT_EQ(m.error().file, "vmc.yaml");
    EXPECT_GT(m.error().line, 0u);
  }
}

TEST(ControlOptions, EachHasASourceAMeaningAndALineInTheReadme) {
  const std::string readme = testing::slurp(testing::source_dir() + "/tooling/data/machines/README.md");
  for (const model::ControlOptionRow& row : model::kControlOptions) {
    EXPECT_FALSE(row.source.empty()) << row.name;
    EXPECT_FALSE(row.meaning.empty()) << row.name;
    EXPECT_NE(readme.find("| `" + std::string(row.name) + "` |"), std::string::npos) << row.name;
    bool has_it = false;
    for (const model::ControlRow& control : model::kControlRows) {
      const std::string_view dialect = control.dialect, value = model::default_of(row, dialect);
      has_it = has_it || value != "-";
      if (value == "-" || value.empty()) continue;
      EXPECT_EQ(model::control_option_fault(dialect, {std::string(row.name), std::string(value)}), "")
          << row.name;
    }
    EXPECT_TRUE(has_it) << row.name << " belongs to no control";
  }
}

TEST(ControlOptions, OfEachControlAreRowsOfTheTable) {
  for (const model::ControlRow& control : model::kControlRows) {
    const std::string_view dialect = control.dialect, options = control.options;
    std::size_t found = 0;
    for (const model::ControlOptionRow& row : model::kControlOptions)
      found += model::default_of(row, dialect) != "-";
    EXPECT_EQ(found, static_cast<std::size_t>(std::count(options.begin(), options.end(), '='))) << dialect;
  }
}

}  // namespace
}  // namespace capstan::tooling
