#include "planner/door/pipeline/given/shop.h"

#include "planner/controls/linuxcnc/linuxcnc.h"
#include "planner/files/exchange/exchange.h"
#include "planner/files/json/json.h"
#include "planner/proof/verify/verify.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/library.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan::pipeline {
namespace {

const char* const kBuiltIn = "built-in default";

}  // namespace

Result<Inputs> load_shop(const ShopFiles& files, Job& job) {
  Inputs in;
  const std::string machine = files.machine.empty() ? std::string(tooling::kDefaultMachine) : files.machine;
  auto m = tooling::load_machine(machine, job);
  if (!m) return tl::unexpected(m.error());
  in.machine = *std::move(m);
  in.provenance.push_back({"machine", in.machine.id, files.machine.empty() ? kBuiltIn : files.machine});
  auto library = files.tools.empty()
                     ? tooling::generic_library()
                     : tooling::load_library(
                           files.tools, job,
                           {.mm_per_unit = {},
                            .offsets_against_reference = in.machine.control.offsets_against_reference});
  if (!library) return tl::unexpected(library.error());
  in.library = *std::move(library);
  in.provenance.push_back({"tools", files.tools.empty() ? "generic library, not purchasable" : files.tools,
                           files.tools.empty() ? kBuiltIn : files.tools});
  auto materials = tooling::shipped_materials();
  if (!materials) return tl::unexpected(materials.error());
  in.materials = *std::move(materials);
  in.provenance.push_back({"materials", "shipped table", kBuiltIn});
  auto tables = rules::load_rules(files.rules, job);
  if (!tables) return tl::unexpected(tables.error());
  in.rules = *std::move(tables);
  in.provenance.push_back({"rules",
                           files.rules.empty() ? "shipped tables" : "shipped tables and " + files.rules,
                           files.rules.empty() ? kBuiltIn : files.rules});
  if (!files.material.empty()) {
    if (auto ok = name_material(in, files.material, job); !ok) return tl::unexpected(ok.error());
    in.provenance.push_back({"material", *in.material_name, "named by the caller"});
  }
  return in;
}

Status name_material(Inputs& in, model::WorkMaterial own) {
  if (auto ok = tooling::add_start_values(own, in.library); !ok) return ok;
  in.material_name = own.id;
  in.materials.push_back(std::move(own));
  return {};
}

Status name_material(Inputs& in, const std::string& given, Job& job) {
  if (!tooling::names_a_material_file(given)) {
    in.material_name = given;
    return {};
  }
  auto own = tooling::load_material(given, in.materials, job);
  if (!own) return tl::unexpected(own.error());
  return name_material(in, *std::move(own));
}

Result<model::Plan> read_plan(std::string bytes, const std::string& name, Job& job) {
  const auto first = bytes.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && bytes[first] == '{') return json::read_json(std::move(bytes), name, job);
  exchange::ReadOptions options;
  options.strict = false;
  return exchange::read_bytes(std::move(bytes), name, options, job);
}

std::vector<model::Finding> findings_of(const model::Plan& plan, Job& job) {
  return findings_of(checked(plan, job), job);
}

std::vector<model::Finding> findings_of(const Checked& checked, Job& job) {
  const model::Plan& plan = checked.plan;
  std::vector<model::Finding> out = checked.findings;
  if (plan.steps.empty()) return out;
  const auto program = controls::write_linuxcnc(plan, job);
  if (!program) {
    model::Finding f;
    f.property = 33;
    f.code = program.error().code;
    f.message = program.error().message;
    out.push_back(std::move(f));
    return out;
  }
  const verify::ProgramText text{"program", *program, controls::write_tool_table(plan)};
  const auto more = verify::check_program(text, &plan, plan.machine, plan.cutters, job);
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

Result<std::string> write_plan(const model::Plan& plan, Format format, Job& job) {
  switch (format) {
    case Format::kJson:
      return json::write_json(plan);
    case Format::kLinuxCnc:
      return controls::write_linuxcnc(plan, job);
    case Format::kToolTable:
      return controls::write_tool_table(plan);
    case Format::kIso14649:
    case Format::kAp238:
      break;
  }
  auto written =
      format == Format::kAp238 ? exchange::write_ap238(plan, job) : exchange::write_iso14649(plan, job);
  if (!written) return tl::unexpected(written.error());
  return std::move(written->bytes);
}

}  // namespace capstan::pipeline
