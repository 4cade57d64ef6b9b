#include "tooling/library/formats/item/losses.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "planner/ground/base/number.h"
#include "tooling/library/formats/item/iso_names.h"
#include "tooling/library/formats/values.h"

namespace capstan::tooling {
namespace {

/// So many fields of one line are named, then their number: what a person still reads. Default, unsourced.
constexpr std::size_t kFieldsShown = 6;

enum class Rank { kSymbol, kOther, kPath, kBookkeeping };

/// By which systems know their own records again, and when they wrote them: no machinist misses it.
constexpr std::array<std::string_view, 4> kBookkeeping = {"guid", "version", "toolbit_id", "last_modified"};

/// "presets.0.guid", "reference_guid", "fusion:read" (what a reader notes for the writer of its format).
bool is_bookkeeping(std::string_view field) {
  if (field.find(':') != std::string_view::npos) return true;
  return std::ranges::any_of(kBookkeeping, [&](std::string_view name) {
    if (!field.ends_with(name)) return false;
    const std::string_view before = field.substr(0, field.size() - name.size());
    return before.empty() || std::string_view("./_").find(before.back()) != std::string_view::npos;
  });
}

/// "post-process.length-offset", "parameter/Crest" is a place in the file of another system, which its
/// readers keep whole.
Rank rank_of(const std::string& field) {
  if (symbol_fact(field) != nullptr || find_symbol(field) != nullptr) return Rank::kSymbol;
  if (is_bookkeeping(field)) return Rank::kBookkeeping;
  return field.find_first_of("./") != std::string::npos ? Rank::kPath : Rank::kOther;
}

/// Fields of one reason and rank, and the tools that lose them all.
struct Group {
  std::string what;
  Rank rank;
  std::vector<std::string> fields;
  std::vector<std::string> tools;
};

std::vector<Group> by_field(const std::vector<LossReport::Line>& lines) {
  std::vector<Group> out;
  std::map<std::pair<std::string, std::string>, std::size_t> at;
  for (const LossReport::Line& l : lines) {
    const auto [it, fresh] = at.emplace(std::pair{l.field, l.what}, out.size());
    if (fresh) out.push_back({l.what, rank_of(l.field), {l.field}, {}});
    out[it->second].tools.push_back(l.tool);
  }
  return out;
}

std::vector<Group> by_reason(std::vector<Group> fields) {
  std::vector<Group> out;
  std::map<std::tuple<Rank, std::string, std::vector<std::string>>, std::size_t> at;
  for (Group& g : fields) {
    const auto [it, fresh] = at.emplace(std::tuple{g.rank, g.what, g.tools}, out.size());
    if (fresh)
      out.push_back(std::move(g));
    else
      out[it->second].fields.push_back(std::move(g.fields.front()));
  }
  std::ranges::stable_sort(out, {}, &Group::rank);
  return out;
}

}  // namespace

std::string line_text(const LossReport::Line& line) {
  std::string out = line.tool;
  if (!line.field.empty()) out += (out.empty() ? "" : ", ") + line.field;
  return out + (out.empty() ? "" : ": ") + line.what;
}

std::vector<std::string> lines_together(const std::vector<LossReport::Line>& lines) {
  std::vector<std::string> out;
  for (const Group& g : by_reason(by_field(lines))) {
    const std::set<std::string> tools(g.tools.begin(), g.tools.end());
    LossReport::Line all{
        tools.size() == 1 ? g.tools.front() : counted(tools.size(), "tool", "tools"), {}, g.what};
    const std::size_t shown = g.fields.size() <= kFieldsShown + 1 ? g.fields.size() : kFieldsShown;
    for (std::size_t k = 0; k < shown; ++k) {
      if (k > 0) all.field += ", ";
      all.field += g.fields[k];
    }
    if (shown < g.fields.size()) all.field += " and " + std::to_string(g.fields.size() - shown) + " more";
    out.push_back(line_text(all));
  }
  return out;
}

}  // namespace capstan::tooling
