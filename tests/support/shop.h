#pragma once

#include <string>

#include "planner/door/pipeline/program_check.h"
#include "planner/door/service/formats.h"
#include "planner/door/service/reading.h"
#include "planner/door/service/shop.h"

/// The service in few words, for tests of the pipeline: a shop, a part, a plan in a format. Needs
/// capstan::service.
namespace capstan::pipeline {

/// Files or ids; empty: what comes with the planner.
struct ShopFiles {
  std::string machine, tools, rules, material;
};

/// What nobody asks anything of. GCC 12 takes an optional that is made and assigned in one function for
/// uninitialised; a copy of this it does not.
inline const service::Request kAsksNothing{};

inline Result<Inputs> load_shop(const ShopFiles& files, Job& job) {
  service::Request request = kAsksNothing;
  if (!files.machine.empty()) request.machine.emplace(files.machine);
  if (!files.tools.empty()) request.tools.emplace(files.tools);
  if (!files.rules.empty()) request.rules.emplace(files.rules);
  if (!files.material.empty()) request.material.emplace(files.material);
  return service::gather(request, model::Plan{}, job);
}

inline Result<model::Plan> read_plan(std::string bytes, const std::string& name, Job& job) {
  return service::read_plan(std::move(bytes), name, job);
}

enum class Format : std::uint8_t { kIso14649, kJson, kLinuxCnc, kToolTable, kAp238 };

inline Result<std::string> write_plan(const model::Plan& plan, Format format, Job& job) {
  constexpr std::string_view kNames[] = {"iso14649", "json", "linuxcnc", "linuxcnc_tools", "ap238"};
  auto written = service::write(plan, *service::find_format(kNames[static_cast<int>(format)]), job);
  if (!written) return tl::unexpected(written.error());
  return std::move(written->bytes);
}

}  // namespace capstan::pipeline
