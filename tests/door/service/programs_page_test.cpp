// docs/programs.md shows what the programs of one part say for each control: the lines are those of the
// program. CAPSTAN_UPDATE=1 writes them anew.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"
#include "planner/ground/vocabulary/control_options.h"
#include "tests/door/service/pockets/pocket_parts.h"
#include "tests/support/corpus.h"

namespace capstan::service {
namespace {

constexpr std::size_t kShownLines = 26;
constexpr const char* kPart = "bracket.p21";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

std::string with(std::string text, const std::string& own, const std::string& other) {
  const std::size_t at = text.find(own);
  EXPECT_NE(at, std::string::npos) << own;
  return at == std::string::npos ? text : text.replace(at, own.size(), other);
}

/// The bracket with mounting holes of 12 mm, which are drilled without pecks: its own of 6.6 mm peck. `row`:
/// three of them on a line, 38 mm apart, in place of four at the corners.
std::string wide_holes(bool row) {
  const std::string text = testing::slurp(testing::source_dir() + "/examples/" + kPart);
  const std::string wide =
      with(text, "#83=TOLERANCED_LENGTH_MEASURE(6.6,", "#83=TOLERANCED_LENGTH_MEASURE(12.,");
  if (!row) return wide;
  return with(with(wide, "#87=TOLERANCED_LENGTH_MEASURE(76.,", "#87=TOLERANCED_LENGTH_MEASURE(38.,"),
              "#22,2,2,#88", "#22,1,3,#88");
}

/// The part's program for that control, `cycles` as its machine's option, with " row" behind it for the row,
/// " slot" for a closed slot with round ends, " held" for the part in a vise.
std::string program(const std::string& control, std::string cycles) {
  static std::map<std::string, model::Plan> plans;
  const std::string kind = cycles.find(' ') == std::string::npos ? "" : cycles.substr(cycles.find(' '));
  cycles.resize(cycles.size() - kind.size());
  const std::string key = control + kind;
  if (!plans.contains(key)) {
    Request request;
    EXPECT_TRUE(set(request, "control", control));
    EXPECT_TRUE(kind != " held" || set(request, "workholding", "vise_125"));
    const std::string part = kind == " slot"   ? pocket_parts::closed_slot()
                             : kind == " held" ? pocket_parts::bracket()
                                               : wide_holes(kind == " row");
    Job job;
    const auto out = plan(request, {.name = kPart, .bytes = part}, job);
    EXPECT_TRUE(out) << (out ? "" : to_text(out.error().what));
    if (!out) return {};
    plans[key] = out->plan;
  }
  model::Plan& plan = plans[key];
  if (model::find_control_option(control, "cycles") != nullptr)
    plan.machine.control_options = model::ControlOptions{{{"cycles", cycles}}};
  plan.file_name = kPart;
  Job job;
  const auto text = controls::write_program(plan, job);
  EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
  return text.value_or("");
}

/// The block that the page shows for `<!-- program CONTROL CYCLES "STEP" -->`, or `CYCLES row` and the like.
std::string shown(const std::string& order) {
  const std::size_t first = order.find("program ") + 8, second = order.find(' ', first);
  const std::size_t quote = order.find('"'), last = order.rfind('"');
  const std::string control = order.substr(first, second - first);
  const std::string cycles = order.substr(second + 1, quote - second - 2);
  std::string id;
  for (const char c : order.substr(quote + 1, last - quote - 1)) id += c == ' ' ? "%20" : std::string(1, c);
  std::string capitals = id;
  for (char& c : capitals) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  std::string out = "```\n";
  std::size_t n = 0;
  bool within = false;
  for (const std::string& line : lines_of(program(control, cycles))) {
    std::string plain;  // a Fanuc's ids in capitals have marks of small letters
    for (const char c : line) plain += c == '$' ? "%" : c == '<' || c == '>' ? "" : std::string(1, c);
    const bool marker = line.find("CAPSTAN STEP ") != std::string::npos;
    if (marker)
      within = plain.find("id=\"" + id + "\"") != std::string::npos ||
               plain.find("ID=\"" + capitals + "\"") != std::string::npos;
    if (line.find("end") != std::string::npos && line.size() < 8) within = false;
    if (!within || line.empty()) continue;
    if (++n > kShownLines) continue;
    out += line + "\n";
  }
  EXPECT_GT(n, 0U) << order;
  return out + (n > kShownLines ? "... (" + std::to_string(n - kShownLines) + " more)\n" : "") + "```\n";
}

TEST(ProgramsPage, ShowsWhatTheProgramsSay) {
  const std::string path = testing::source_dir() + "/docs/programs.md";
  const std::string page = testing::slurp(path);
  std::string wanted;
  std::size_t orders = 0;
  bool fenced = false;
  for (const std::string& line : lines_of(page)) {
    if (line.starts_with("```")) {
      fenced = !fenced;
      continue;
    }
    if (fenced) continue;
    wanted += line + "\n";
    if (!line.starts_with("<!-- program ")) continue;
    ++orders;
    wanted += shown(line);
  }
  EXPECT_GE(orders, 10U);
  if (std::getenv("CAPSTAN_UPDATE") != nullptr) {
    std::ofstream(path) << wanted;
    return;
  }
  EXPECT_EQ(page, wanted);
}

}  // namespace
}  // namespace capstan::service
