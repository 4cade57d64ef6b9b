#include "tooling/library/cutters/check.h"

#include <map>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/ground/base/text.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;

}  // namespace

std::string unlikely_of(const Cutter& c) {
  // default, unsourced: beyond these only face mills, discs and bored-in heads are common
  constexpr double kWideMm = 100.0, kLongFlutesMm = 300.0;
  if (c.cutting_diameter_mm > kWideMm && !model::has(c.cutter_class, model::CutterTrait::kWide))
    return "a diameter of " + mm_text(c.cutting_diameter_mm, 4) + " is unlikely for a " +
           std::string(model::to_text(c.cutter_class));
  if (c.maximum_depth_of_cut_mm > kLongFlutesMm && c.cutter_class != CutterClass::kGunDrill)
    return "flutes of " + mm_text(c.maximum_depth_of_cut_mm, 4) + " are unlikely";
  return {};
}

std::vector<Diagnostic> check_cutters(const std::vector<Cutter>& cutters, const std::string& file,
                                      const std::vector<std::uint64_t>& lines) {
  std::vector<Diagnostic> out;
  std::map<std::string, std::size_t> ids;
  std::map<int, std::size_t> numbers;
  for (std::size_t i = 0; i < cutters.size(); ++i) {
    tick();
    const Cutter& c = cutters[i];
    const std::uint64_t line = i < lines.size() ? lines[i] : 0;
    for (std::string& what : faults_of(c))
      out.push_back(
          {.code = "TOOL-VALUE", .message = std::move(what), .file = file, .line = line, .path = c.id});
    if (c.id.empty())
      out.push_back({.code = "TOOL-ID", .message = "a tool has no id", .file = file, .line = line});
    if (!ids.emplace(c.id, i).second)
      out.push_back({.code = "TOOL-ID",
                     .message = "the id '" + c.id + "' is given twice",
                     .file = file,
                     .line = line,
                     .path = c.id});
    if (c.pocket > 0) {
      const auto [it, fresh] = numbers.emplace(c.pocket, i);
      if (!fresh)
        out.push_back({.code = "TOOL-NUMBER",
                       .message = "tool number " + std::to_string(c.pocket) + " is given twice, first to '" +
                                  cutters[it->second].id + "'",
                       .file = file,
                       .line = line,
                       .path = c.id});
    }
  }
  return out;
}

}  // namespace capstan::tooling
