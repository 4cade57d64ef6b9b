#include "planner/controls/controls.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/ground/vocabulary/control_rows.h"
#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/verify.h"
#include "tooling/shop/machine/machine.h"

// The three tables of controls: what one is and who writes its programs, how it follows a path, and who reads
// its programs back. The reader's copies agree with what the writer has.

namespace capstan::service {
namespace {

TEST(Controls, EachHasAWriterAReaderAndAWayToFollowPaths) {
  ASSERT_EQ(controls::dialects().size(), model::kControlRows.size());
  for (const model::ControlRow& follows : model::kControlRows) {
    EXPECT_GT(follows.turning_share, 0.0);
    EXPECT_GT(follows.along_share, 0.0);
    const controls::Dialect* control = controls::find_dialect(follows.dialect);
    ASSERT_NE(control, nullptr) << follows.dialect;
    EXPECT_NE(control->write_program, nullptr);
    EXPECT_FALSE(control->work_offsets.empty());
    const verify::DialectReader* reader = verify::reader_of(follows.dialect);
    ASSERT_NE(reader, nullptr) << follows.dialect;
    EXPECT_EQ(reader->name, control->name);
    EXPECT_EQ(reader->tool_table == nullptr, control->write_tool_table == nullptr);
    EXPECT_TRUE(std::equal(reader->work_offsets.begin(), reader->work_offsets.end(),
                           control->work_offsets.begin(), control->work_offsets.end()));
  }
}

TEST(Controls, EveryShippedMachineHasOne) {
  for (const std::string& id : tooling::shipped_machines()) {
    Job job;
    const auto machine = tooling::load_machine(id, job);
    ASSERT_TRUE(machine) << id;
    EXPECT_NE(controls::find_dialect(machine->control.dialect), nullptr) << id;
  }
}

TEST(Controls, OneThatNobodyKnowsHasNoProgramAndNothingIsProvedOfOne) {
  model::Plan plan;
  plan.machine.id = "lathe";
  plan.machine.control.dialect = "abacus";
  Job job;
  const auto text = controls::write_program(plan, job);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, "OUT-DIALECT");
  EXPECT_NE(text.error().message.find("abacus"), std::string::npos);
  EXPECT_EQ(controls::tool_table_of(plan), "");
  const auto findings = verify::check_program({"a.ngc", "G0 X0\nM2\n", ""}, nullptr, plan.machine, {}, job);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].code, "CHK-TEXT-DIALECT");
  EXPECT_EQ(findings[0].severity, Severity::kError);
}

}  // namespace
}  // namespace capstan::service
