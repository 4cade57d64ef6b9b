// A plan whose file does not say what a tool is made of: what is taken, where it is told, and what settles
// it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "planner/door/service/options.h"
#include "planner/model/plan/assumed_tool_material.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/corpus.h"
#include "tests/support/scratch.h"
#include "tests/support/shop.h"

namespace capstan::pipeline {
namespace {

using model::Substrate;
using ::testing::HasSubstr;

const std::string kTool = "END MILL 12";

/// The plate's end mill of 12 mm runs at 21 turns a second, 47.5 m/min; the file states carbide, here it does
/// not. The plate's steel bears 20 with HSS and 60 with carbide. `turns`: the spindle, turns a second.
std::string plate(const std::string& turns = "-21.") {
  std::string text = testing::slurp(capstan::testing::source_dir() + "/examples/plate_bound.p21");
  const auto replace = [&](const std::string& what, const std::string& by) {
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), by);
  };
  [&] { replace("CUTTING_COMPONENT(60.,#91,", "CUTTING_COMPONENT(60.,$,"); }();
  [&] { replace("MILLING_TECHNOLOGY(0.004,.TCP.,$,-21.", "MILLING_TECHNOLOGY(0.004,.TCP.,$," + turns); }();
  return text;
}

struct Made {
  model::Plan plan;
  Job job;
};

void make(Made& out, std::string text, const std::string& name, const std::string& assume = {},
          const std::string& tools = {}) {
  service::Request request = kAsksNothing;
  request.material = "low_alloy_steel";
  request.reopen = Reopen::kTechnology;
  if (!assume.empty()) {
    ASSERT_TRUE(service::set(request, "assume", assume));
  }
  if (!tools.empty()) request.tools = tools;
  auto part = read_plan(std::move(text), name, out.job);
  ASSERT_TRUE(part) << to_text(part.error());
  const auto in = service::gather(request, *part, out.job);
  ASSERT_TRUE(in) << to_text(in.error());
  Policy policy;
  policy.reopen = Reopen::kTechnology;
  auto plan = bind(*std::move(part), *in, policy, out.job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  out.plan = *std::move(plan);
}

const Diagnostic* told(const Job& job) {
  const auto& all = job.diagnostics();
  const auto at =
      std::find_if(all.begin(), all.end(), [](const auto& d) { return d.code == "PIP-TOOL-MATERIAL"; });
  return at == all.end() ? nullptr : &*at;
}

bool the_check_tells(const model::Plan& plan) {
  Job job;
  const auto findings = verify::check_plan(plan, job);
  return std::any_of(findings.begin(), findings.end(), [](const auto& f) {
    return f.code == "CHK-TOOL-MATERIAL" && f.severity == Severity::kWarning &&
           f.message.find(kTool) != std::string::npos;
  });
}

Substrate taken(const model::Plan& plan) { return model::find_cutter(plan, kTool)->substrate; }

TEST(UnstatedToolMaterial, IsCarbideByTheSpeedOfTheFileAndToldOnceEverywhere) {
  Made p;
  make(p, plate(), "plate.p21");
  ASSERT_EQ(taken(p.plan), Substrate::kCarbide);
  const Diagnostic* d = told(p.job);
  ASSERT_NE(d, nullptr);
  EXPECT_EQ(d->severity, Severity::kWarning);
  EXPECT_THAT(d->message, HasSubstr("47.5 m/min"));
  EXPECT_THAT(d->hint, HasSubstr("--assume tool-material=carbide"));
  EXPECT_EQ(std::count_if(p.job.diagnostics().begin(), p.job.diagnostics().end(),
                          [](const auto& x) { return x.code == "PIP-TOOL-MATERIAL"; }),
            1);
  EXPECT_TRUE(the_check_tells(p.plan));
  Job job;
  EXPECT_THAT(write_plan(p.plan, Format::kLinuxCnc, job).value(), HasSubstr("carbide is assumed"));
  EXPECT_THAT(write_plan(p.plan, Format::kToolTable, job).value(), HasSubstr("assumed carbide"));
}

TEST(UnstatedToolMaterial, StaysHssWhereTheFileRunsItAsHss) {
  Made p;
  make(p, plate("-8."), "plate.p21");  // 18 m/min
  EXPECT_EQ(taken(p.plan), Substrate::kHss);
  const auto assumed = model::assumed_material_of(p.plan, kTool);
  ASSERT_TRUE(assumed);
  EXPECT_THAT(assumed->why, HasSubstr("a speed of HSS"));
  EXPECT_FALSE(the_check_tells(p.plan));
}

TEST(UnstatedToolMaterial, IsWhatTheCallerSettlesAndThenNoAssumption) {
  for (const Substrate wanted : {Substrate::kHss, Substrate::kCarbide}) {
    Made p;
    make(p, plate(), "plate.p21", "tool-material=" + std::string(model::to_text(wanted)));
    EXPECT_EQ(taken(p.plan), wanted);
    EXPECT_EQ(told(p.job), nullptr);
    EXPECT_FALSE(the_check_tells(p.plan));
    const auto assumed = model::assumed_material_of(p.plan, kTool);
    ASSERT_TRUE(assumed);
    EXPECT_TRUE(assumed->settled);
  }
}

TEST(UnstatedToolMaterial, IsTakenAgainWhenThePlanIsPlannedAgainInEachForm) {
  // The plan's own speeds are no speeds of the file: they follow from what was taken.
  for (const std::string assume : {"", "tool-material=hss"}) {
    Made first;
    make(first, plate(), "plate.p21", assume);
    for (const auto& [form, name] :
         {std::pair(Format::kJson, "plan.json"), std::pair(Format::kIso14649, "plan.p21"),
          std::pair(Format::kAp238, "plan.stpnc")}) {
      Job job;
      Made again;
      make(again, write_plan(first.plan, form, job).value(), name);
      EXPECT_EQ(taken(again.plan), taken(first.plan)) << name << assume;
      const auto before = model::assumed_material_of(first.plan, kTool);
      const auto after = model::assumed_material_of(again.plan, kTool);
      ASSERT_TRUE(before && after) << name;
      EXPECT_EQ(after->why, before->why) << name;
      EXPECT_EQ(after->settled, !assume.empty()) << name;
    }
  }
}

TEST(UnstatedToolMaterial, IsThatOfTheLoadedToolThatStatesIt) {
  const std::string path = capstan::testing::scratch_file("crib_of_hss.yaml");
  {
    std::ofstream out(path);
    out << "capstan_tools: 1\nunit: mm\nsource: \"crib\"\ntools:\n"
           "  - {id: crib 7, class: endmill, substrate: hss, cutting_diameter: 12, teeth: 3, "
           "maximum_depth_of_cut: 26, usable_length: 30, stick_out: 39, functional_length: 100, pocket: 7}\n";
  }
  for (const std::string assume : {"", "tool-material=carbide"}) {
    Made p;
    make(p, plate(), "plate.p21", assume, path);
    EXPECT_EQ(taken(p.plan), Substrate::kHss) << assume;
    EXPECT_FALSE(model::assumed_material_of(p.plan, kTool)) << assume;
    EXPECT_FALSE(the_check_tells(p.plan));
  }
}

TEST(AssumeOption, TakesNoOtherWords) {
  service::Request request = kAsksNothing;
  EXPECT_FALSE(service::set(request, "assume", "tool-material=ceramic"));
  EXPECT_FALSE(service::set(request, "assume", "carbide"));
  EXPECT_TRUE(service::set(request, "assume", "tool-material=hss"));
}

}  // namespace
}  // namespace capstan::pipeline
