#include "tooling/library/cutters/holders.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "planner/ground/base/job.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/model/plan/cutter/cutter_faults.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "planner/model/plan/cutter/generic_holder.h"
#include "tooling/library/cutters/complete.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::generic_holder;
using model::stated_holder;

const ShopHolder* find_holder(const std::vector<ShopHolder>& all, std::string_view id) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const ShopHolder& h) { return h.id == id; });
  return at == all.end() ? nullptr : &*at;
}

bool takes(const ShopHolder& h, double shank_mm) {
  const double most = h.shank_mm > 0.0 ? h.shank_mm : h.segments.front().lower_diameter_mm;
  return shank_mm <= most;
}

/// Whether the field was filled in by the generic library, for want of a statement.
bool assumed(const Cutter& c, std::string_view field) {
  if (!c.table_line && generic_holder(c.holder_id)) return true;
  const std::string* source = source_of(c, field);
  return source != nullptr && source->starts_with(kAsGeneric);
}

void set_source(Cutter& c, std::string_view field, const std::string& text) {
  c.sources.erase(
      std::remove_if(c.sources.begin(), c.sources.end(), [&](const auto& s) { return s.first == field; }),
      c.sources.end());
  c.sources.emplace_back(field, text);
}

/// One holder of the list; what is wrong with it goes to the faults.
ShopHolder read_holder(Fields& f) {
  ShopHolder out;
  out.id = f.text("id");
  out.shank_mm = f.number_or("shank", 0.0);
  const Node* list = f.child("holder", true);
  const std::size_t before = f.fault_count();
  if (list != nullptr) {
    for (const Node& n : list->items) {
      Fields s = f.below("holder", n);
      model::for_each_field(out.segments.emplace_back(),
                            [&](const auto& of, double& size) { size = s.number(of.own_key); });
      s.finish();
    }
    Cutter probe;
    probe.holder = out.segments;
    probe.shank_diameter_mm = out.shank_mm;
    for (const std::string& wrong : model::value_faults_of(probe))
      f.fault("DATA-VALUE", "holder '" + out.id + "': " + wrong, "holder", f.line_of("holder"));
    const bool flat = std::any_of(out.segments.begin(), out.segments.end(), [](const auto& s) {
      return !(s.height_mm > 0.0 && s.lower_diameter_mm > 0.0 && s.upper_diameter_mm > 0.0);
    });
    if (f.fault_count() == before && (flat || out.segments.empty()))
      f.fault("DATA-VALUE", "holder '" + out.id + "' has a segment without a size, or none", "holder",
              f.line_of("holder"), "height, lower_diameter and upper_diameter above 0 mm, from its face up");
    if (f.fault_count() == before && out.shank_mm > out.segments.front().lower_diameter_mm)
      f.fault("DATA-VALUE", "holder '" + out.id + "' takes a shank that is thicker than its face", "shank",
              f.line_of("shank"));
  }
  f.finish();
  return out;
}

}  // namespace

ShopHolders read_holders(const Node& node, const std::string& file, std::vector<Diagnostic>& faults) {
  ShopHolders out;
  out.source = file + ": holders";
  if (node.kind != Node::Kind::kMap) {
    faults.push_back({.code = "DATA-TYPE",
                      .message = "holders is not a map",
                      .file = file,
                      .line = node.line,
                      .expected = "{default: ER32, list: [{id: ER32, shank: 20, holder: [{height: 60, "
                                  "lower_diameter: 50, upper_diameter: 50}]}]}"});
    return out;
  }
  Fields f(node, file, "holders", "", faults);
  const Node* list = f.child("list", true);
  const Node* wanted = f.child("default", false);
  if (list != nullptr && list->kind != Node::Kind::kList)
    f.fault("DATA-TYPE", "list is not a list", "list", list->line,
            "holders in [ ], or one after a dash each");
  for (const Node& n : list != nullptr ? list->items : std::vector<Node>{}) {
    Fields one = f.below("list", n);
    ShopHolder h = read_holder(one);
    if (find_holder(out.all, h.id) != nullptr)
      one.fault("DATA-DUPLICATE", "holder '" + h.id + "' stands twice", "id", n.line);
    out.all.push_back(std::move(h));
  }
  f.finish();
  const auto take = [&](const Node& n) {
    if (n.kind != Node::Kind::kScalar)
      return f.fault("DATA-TYPE", "default is no name of a holder", "default", n.line,
                     "an id of the list, or a list of them");
    if (find_holder(out.all, n.text) == nullptr) {
      std::vector<std::string> known;
      for (const ShopHolder& h : out.all) known.push_back(h.id);
      Diagnostic d = unknown_name("holder", n.text, known, "capstan shop show");
      d.file = file;
      d.line = n.line;
      faults.push_back(std::move(d));
    }
    out.by_default.push_back(n.text);
  };
  if (wanted != nullptr && wanted->kind != Node::Kind::kList) take(*wanted);
  if (wanted != nullptr && wanted->kind == Node::Kind::kList) {
    for (const Node& n : wanted->items) take(n);
  }
  return out;
}

const ShopHolder* give_holder(Cutter& c, const ShopHolders& holders) {
  const bool outlined = !c.holder.empty() && !generic_holder(c.holder_id);
  if (outlined) return nullptr;
  const ShopHolder* h = find_holder(holders.all, c.holder_id);
  const bool stated = c.holder.empty() && c.holder_diameter_mm > 0.0 && !assumed(c, "holder_diameter_mm");
  if (h == nullptr && (stated || !stated_holder(c).empty())) return nullptr;
  for (std::size_t i = 0; h == nullptr && i < holders.by_default.size(); ++i) {
    const ShopHolder* one = find_holder(holders.all, holders.by_default[i]);
    if (one != nullptr && takes(*one, c.shank_diameter_mm)) h = one;
  }
  if (h == nullptr) return nullptr;
  const bool length = assumed(c, "functional_length_mm");
  c.holder_id = h->id;
  c.holder = h->segments;
  double widest = 0.0, high = 0.0;
  for (const model::HolderSegment& s : c.holder) {
    widest = std::max({widest, s.lower_diameter_mm, s.upper_diameter_mm});
    high += s.height_mm;
  }
  c.holder_diameter_mm = widest;
  const std::string source = holders.source + " " + h->id;
  set_source(c, "holder", source);
  set_source(c, "holder_diameter_mm", source);
  if (length) {
    c.functional_length_mm = c.stick_out_mm + high;
    set_source(c, "functional_length_mm", source + ", and the stick-out");
  }
  return h;
}

void give_holders(std::vector<Cutter>& library, const ShopHolders& holders, Job& job) {
  std::map<std::string, std::size_t> given;
  std::size_t too_thick = 0;
  for (Cutter& c : library) {
    const bool without = stated_holder(c).empty();
    if (const ShopHolder* h = give_holder(c, holders)) {
      ++given[h->id];
    } else if (without && assumed(c, "holder_diameter_mm")) {
      ++too_thick;
    }
  }
  std::string told;
  for (const auto& [id, count] : given)
    told += (told.empty() ? "" : ", ") + id + ": " + std::to_string(count);
  if (!holders.by_default.empty() && too_thick > 0)
    told += (told.empty() ? "" : "; ") + std::to_string(too_thick) +
            " have a shank that no default takes, and keep the holder that is assumed for them";
  if (!told.empty())
    job.note("SHOP-HOLDER", holders.source + ": tools without a holder of their own, by holder: " + told);
}

}  // namespace capstan::tooling
