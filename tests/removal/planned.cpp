#include "tests/removal/planned.h"

#include <cstdlib>
#include <sstream>
#include <utility>

#include "planner/ground/base/file.h"

namespace capstan::testing::removal {

Box block(double length_x, double width_y, double height, double raw) {
  return {{0.0, 0.0, -height}, {length_x, width_y, raw}};
}

Depth body(const Box& b) { return box(b.lo, {b.hi.x, b.hi.y, std::min(b.hi.z, 0.0)}); }

std::string Outcome::text() const {
  std::string out;
  for (const PlanMessage& m : plan.findings) out += "finding, " + m.severity + ": " + m.text + "\n";
  for (const PlanMessage& m : plan.diagnostics) {
    if (m.severity != "note") out += "said, " + m.severity + ": " + m.text + "\n";
  }
  out += std::to_string(plan.steps) + " steps, " + std::to_string(plan.unplanned) + " features unplanned\n";
  return out + (written() ? verdict.text() : "no program\n");
}

namespace {

// Seen from above, as a grey picture: the higher the lighter.
std::string heights(const Stock& stock) {
  const auto& n = stock.count();
  std::string out = "P5 " + std::to_string(n[0]) + " " + std::to_string(n[1]) + " 255\n";
  for (int y = n[1] - 1; y >= 0; --y) {
    for (int x = 0; x < n[0]; ++x) {
      int z = n[2] - 1;
      while (z >= 0 && !stock.present(x, y, z)) --z;
      out += static_cast<char>(255 * (z + 1) / n[2]);
    }
  }
  return out;
}

/// The program without its comments: they name the file.
std::string words_of(const std::string& program) {
  std::istringstream lines(program);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('(')) out += line + "\n";
  }
  return out;
}

}  // namespace

Outcome plan_and_simulate(const Part& part) {
  Outcome out;
  const char* keep = std::getenv("CAPSTAN_REMOVAL_KEEP");
  const auto write = [&](const char* ending, const std::string& text) {
    if (keep != nullptr) (void)write_file(std::string(keep) + "/" + part.name + ending, text);
  };
  write(".p21", part.text);
  out.plan = plan_bytes(part.text, part.name + ".p21", part.options);
  write(".ngc", out.plan.linuxcnc);
  write(".tbl", out.plan.tool_table);
  write(".json", out.plan.json);
  write(".planned.p21", out.plan.iso14649);
  if (!out.written()) return out;
  Stock remains(part.block, part.grid.cell_mm, part.grid.cell_z_mm);
  out.verdict = simulate({out.plan.linuxcnc, out.plan.tool_table, out.plan.json, out.plan.iso14649},
                         part.block, part.target, part.grid, &remains);
  if (keep != nullptr) write(".pgm", heights(remains));
  write(".txt", out.text());
  return out;
}

std::string lost_in_a_form(const Part& part, const PlanOutput& plan) {
  if (plan.linuxcnc.empty()) return {};
  std::string out;
  const std::pair<const char*, const std::string*> forms[] = {
      {"plan.json", &plan.json}, {"plan.p21", &plan.iso14649}, {"plan.stpnc", &plan.ap238}};
  for (const auto& [name, text] : forms) {
    const PlanOutput again = plan_bytes(*text, name, part.options);
    if (words_of(again.linuxcnc) == words_of(plan.linuxcnc)) continue;
    out += std::string(name) + " gives another program";
    for (const PlanMessage& m : again.diagnostics) {
      if (m.severity != "note") out += "; " + m.severity + ": " + m.text;
    }
    out += "\n";
  }
  return out;
}

}  // namespace capstan::testing::removal
