#include "planner/door/service/shop_tools/program_machine.h"

#include <gtest/gtest.h>

namespace capstan::service {
namespace {

struct Chosen {
  std::string machine, codes;
};

Chosen chosen(const std::optional<std::string>& value, bool stated, const std::string& program) {
  Job job;
  Chosen out;
  out.machine = machine_for_programs(value, stated, {{"a.ngc", program}}, job);
  for (const Diagnostic& d : job.take_diagnostics()) out.codes += d.code + " ";
  return out;
}

TEST(ProgramMachine, TheHeadersIsTakenWhereTheCallNamesNoneAndItIsKnown) {
  for (const char* named : {"(machine: grbl_600x400)\n", "(MACHINE: GRBL_600X400)\n"}) {
    const Chosen c = chosen(std::nullopt, false, named);
    EXPECT_EQ(c.machine, "grbl_600x400");
    EXPECT_EQ(c.codes, "APP-MACHINE ");
  }
}

TEST(ProgramMachine, WhatTheCallNamesHoldsBeforeIt) {
  const Chosen c = chosen("small_router", true, "(machine: grbl_600x400)\n");
  EXPECT_EQ(c.machine, "small_router");
  EXPECT_EQ(c.codes, "");
}

TEST(ProgramMachine, TheShopsOwnHoldsWhereTheHeaderNamesIt) {
  const Chosen same = chosen("small_router", false, "(machine: small_router)\n");
  EXPECT_EQ(same.machine, "small_router");
  EXPECT_EQ(same.codes, "");
  EXPECT_EQ(chosen("small_router", false, "(machine: grbl_600x400)\n").machine, "grbl_600x400");
}

TEST(ProgramMachine, OneThatNobodyKnowsIsTold) {
  const Chosen c = chosen(std::nullopt, false, "(machine: mill 7)\n");
  EXPECT_EQ(c.machine, "generic_vmc");
  EXPECT_EQ(c.codes, "APP-MACHINE ");
}

TEST(ProgramMachine, WithoutAHeaderItIsTheShopsOrTheBuiltIn) {
  EXPECT_EQ(chosen("small_router", false, "G21\n").machine, "small_router");
  const Chosen c = chosen(std::nullopt, false, "G21\n");
  EXPECT_EQ(c.machine, "generic_vmc");
  EXPECT_EQ(c.codes, "APP-DEFAULT ");
}

}  // namespace
}  // namespace capstan::service
