#include "tooling/library/cutters/edges.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "planner/ground/base/text.h"
#include "planner/model/plan/assumed_tool_material.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/shop/data/data.h"
#include "tooling/shop/material/iso_groups.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterTrait;

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Where a word begins, not as a part of another; npos: nowhere. "tin" is not in "setting".
std::size_t word_in(std::string_view text, std::string_view word) {
  for (auto at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const auto end = at + word.size();
    const bool begins = at == 0 || !in_word(text[at - 1]);
    const bool ends = end == text.size() || !in_word(text[end]);
    if (begins && ends) return at;
  }
  return std::string_view::npos;
}

/// Words of cobalt steel, in lower case; "hss-co8" and its like are asked for apart. M35 and M42 alone are
/// threads, too: only beside "hss".
constexpr std::array kCobaltWords = {"hss-e",   "hsse",    "hss-e-pm",  "hsse-pm",   "hss-co",
                                     "hssco",   "hss co",  "cobalt",    "kobalt",    "co5",
                                     "co8",     "hss m35", "hss-m35",   "hss (m35)", "m35 hss",
                                     "hss m42", "hss-m42", "hss (m42)", "m42 hss"};
/// Coatings as makers write them, in lower case. Nitride of titanium is asked for apart, in its own letters:
/// tin is a metal that is cut.
constexpr std::array kCoatings = {"tialn",  "altin",   "ticn",        "alcrn",     "tisin",    "altisin",
                                  "coated", "coating", "beschichtet", "revestida", "revestido"};
/// What comes after these is the work, not the tool.
constexpr std::array kFor = {" for ", " fuer ", " für ", " para "};
/// Of tools with inserts, in lower case.
constexpr std::array kInserts = {"insert", "inserts", "indexable", "wendeplatten", "wendeschneidplatten"};
/// What says that there is none.
constexpr std::array kBare = {"uncoated", "not coated", "unbeschichtet", "no coating", "bright finish"};

template <std::size_t N>
std::string_view said(std::string_view text, const std::array<const char*, N>& words) {
  for (const char* w : words)
    if (word_in(text, w) != std::string_view::npos) return w;
  return {};
}

/// A description up to where it begins to speak of the work.
std::string about_the_tool(const std::string& description) {
  const std::string lower = lower_text(description);
  std::size_t end = lower.size();
  for (const char* w : kFor) end = std::min(end, lower.find(w));
  return description.substr(0, end);
}

}  // namespace

Edges read_edges(const Node& node, Fields top) {
  Edges out;
  for (const auto& [name, child] : node.entries) {
    (void)top.child(name, true);
    Fields f = top.below(name, child);
    Edge& edge = out[name];
    edge.source = f.source();
    for (const IsoGroup& g : kIsoGroups) {
      const std::string group(g.letter);
      edge.over_bare[group] = f.number(group);
      if (f.has(group) && !(edge.over_bare[group] > 0.0))
        f.fault("DATA-RANGE", "an edge's speed over a bare one's is above 0", group, f.line_of(group));
    }
    f.finish();
  }
  return out;
}

const Edges& shipped_edges() {
  static const Edges kEdges = [] {
    constexpr const char* kFile = "cutters.yaml";
    const auto root = shipped_tree(kFile);
    if (!root) return Edges{};
    std::vector<Diagnostic> faults;
    const Node* n = root->find("edges");
    Edges out = n == nullptr ? Edges{} : read_edges(*n, Fields(*n, kFile, "edges", "", faults));
    return faults.empty() ? out : Edges{};
  }();
  return kEdges;
}

Grade grade_of(const Cutter& c) {
  std::string as_written = about_the_tool(c.description);
  if (const std::string* source = source_of(c, "substrate");
      source != nullptr && !source->starts_with("default") && source != source_of(c, "*"))
    as_written += " | " + *source;
  const std::string text = lower_text(as_written);
  // What a plan's own table says that it assumes is nobody's statement.
  if (text.find(model::kAssumedWord) != std::string::npos) return {};
  Grade g;
  const bool bare = !said(text, kBare).empty();
  std::string_view coating = bare ? std::string_view() : said(text, kCoatings);
  if (coating.empty() && !bare && word_in(as_written, "TiN") != std::string_view::npos) coating = "tin";
  const std::string_view cobalt =
      c.substrate == model::Substrate::kHss ? said(text, kCobaltWords) : std::string_view();
  g.coated = !coating.empty();
  g.cobalt = !cobalt.empty();
  g.inserts = !said(text, kInserts).empty();
  g.said = std::string(cobalt) + (g.cobalt && g.coated ? ", " : "") + std::string(coating);
  return g;
}

std::string edge_of(const Grade& g, const Cutter& c) {
  const bool drills = model::has(c.cutter_class, CutterTrait::kDrills);
  const bool mills = !model::has(c.cutter_class, CutterTrait::kAlongAxis) &&
                     c.cutter_class != model::CutterClass::kTouchProbe;
  if (!drills && !mills) return {};
  if (c.substrate == model::Substrate::kCarbide)
    return !g.coated ? "" : drills ? "coated_drill" : g.inserts ? "coated_insert" : "coated_mill";
  return g.coated && g.cobalt ? "coated_cobalt_hss" : g.coated ? "coated_hss" : g.cobalt ? "cobalt_hss" : "";
}

}  // namespace capstan::tooling
