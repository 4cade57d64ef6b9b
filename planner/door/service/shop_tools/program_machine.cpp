#include "planner/door/service/shop_tools/program_machine.h"

#include <algorithm>

#include "planner/proof/verify/program_signs.h"
#include "tooling/shop/machine/machine.h"

namespace capstan::service {
namespace {

/// Some controls write their comments in capitals.
bool same_name(std::string_view a, std::string_view b) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return small(x) == small(y); });
}

/// The shop's machine, or one that comes with the planner, of that id; nothing: nobody has it.
std::optional<std::string> having(const std::string& id, const std::optional<std::string>& of_shop) {
  if (of_shop) {
    Job quiet;  // whoever loads it says what is wrong with it
    const auto machine = tooling::load_machine(*of_shop, quiet);
    if (!machine || same_name(machine->id, id)) return of_shop;
  }
  for (const std::string& shipped : tooling::shipped_machines()) {
    if (same_name(shipped, id)) return shipped;
  }
  return std::nullopt;
}

}  // namespace

std::string machine_for_programs(const std::optional<std::string>& value, bool stated,
                                 const std::vector<NamedProgram>& programs, Job& job) {
  const std::string otherwise = value.value_or(std::string(tooling::kDefaultMachine));
  if (stated || programs.empty()) return otherwise;
  std::string id, file;
  for (const NamedProgram& p : programs) {
    id = verify::machine_of_program(p.text);
    file = p.file;
    if (!id.empty()) break;
  }
  const std::string judged = (value ? "the shop's " : "the built-in ") + otherwise;
  if (id.empty()) {
    if (!value) job.note("APP-DEFAULT", "no machine is named; programs are checked for " + judged);
    return otherwise;
  }
  if (const auto known = having(id, value)) {
    if (known != value)
      job.note("APP-MACHINE", "programs are checked for " + *known + ", which the header of " + file +
                                  " names; name another machine where that is not the one it runs on");
    return *known;
  }
  job.note("APP-MACHINE", "the header of " + file + " names the machine '" + id +
                              "', which is not known here; programs are checked for " + judged +
                              ": name the file of that machine");
  return otherwise;
}

}  // namespace capstan::service
