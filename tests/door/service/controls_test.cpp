#include "planner/controls/controls.h"

#include <gtest/gtest.h>

#include "planner/ground/vocabulary/control_kind.h"
#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/verify.h"
#include "tooling/shop/machine/machine.h"

// The three tables of controls: what one is, who writes its programs, who reads them back.

namespace capstan::service {
namespace {

TEST(Controls, EachHasAKindAWriterAndAReader) {
  ASSERT_EQ(controls::dialects().size(), model::kControlKinds.size());
  for (const model::ControlKind& kind : model::kControlKinds) {
    const controls::Dialect* writer = controls::find_dialect(kind.dialect);
    ASSERT_NE(writer, nullptr) << kind.dialect;
    EXPECT_NE(writer->write_program, nullptr);
    EXPECT_NE(writer->write_tool_table, nullptr);
    const verify::DialectReader* reader = verify::reader_of(kind.dialect);
    ASSERT_NE(reader, nullptr) << kind.dialect;
    EXPECT_FALSE(kind.work_offsets.empty());
    EXPECT_GT(kind.turning_share, 0.0);
    EXPECT_GT(kind.along_share, 0.0);
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
