#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/door/app/command/session.h"
#include "planner/door/service/shop.h"
#include "planner/door/service/shop_file/shop_file.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/probe_macros.h"
#include "tooling/shop/data/data.h"
#include "tooling/shop/fixtures/fixtures.h"
#include "tooling/shop/machine/machine.h"

// What a shop has: the built-in machines, fixtures and controls one by one, and its own settings.

namespace capstan::app {
namespace {

using tooling::Node;

/// A node as YAML, for people.
std::string yaml_of(const Node& n, std::size_t indent) {
  const std::string margin(indent, ' ');
  std::string out;
  for (const auto& [key, value] : n.entries) {
    out += margin + key + ":";
    const bool nested = value.kind == Node::Kind::kMap || value.kind == Node::Kind::kList;
    out += nested ? "\n" + yaml_of(value, indent + 2) : " " + value.text + "\n";
  }
  for (const Node& item : n.items) {
    const bool nested = item.kind == Node::Kind::kMap || item.kind == Node::Kind::kList;
    std::string text = nested ? yaml_of(item, indent + 2) : std::string(indent + 2, ' ') + item.text + "\n";
    text[indent] = '-';
    out += text;
  }
  return out;
}

/// The entry of that id, anywhere in a data file.
const Node* with_id(const Node& n, const std::string& id) {
  if (const Node* own = n.find("id"); own != nullptr && own->text == id) return &n;
  for (const auto& [key, value] : n.entries) {
    if (const Node* found = with_id(value, id)) return found;
  }
  for (const Node& item : n.items) {
    if (const Node* found = with_id(item, id)) return found;
  }
  return nullptr;
}

std::string page_of(const controls::Dialect& d) {
  std::string out = std::string(d.id) + ": " + std::string(d.name) + "\n";
  const auto row = [&](const std::string& name, const std::string& value) {
    out += "  " + name + std::string(name.size() < 24 ? 24 - name.size() : 1, ' ') + value + "\n";
  };
  const auto yes = [&](const std::string& name, bool v) { row(name, v ? "yes" : "no"); };
  const auto number = [&](const std::string& name, double v, const std::string& unit) {
    row(name, v > 0.0 ? trimmed(v, 4) + unit : std::string("not limited"));
  };
  const controls::Conformance& c = d.conformance;
  row("programs", std::string(d.program.ending));
  row("tool table", d.tool_table.ending.empty() ? "none" : std::string(d.tool_table.ending));
  row("decimals of mm", std::to_string(d.decimals));
  std::string offsets;
  for (const std::string_view o : d.work_offsets) offsets += (offsets.empty() ? "" : " ") + std::string(o);
  row("work offsets", offsets);
  yes("arcs", c.arcs);
  yes("helices", c.helices);
  yes("rigid tapping", c.rigid_tapping);
  yes("path tolerance", c.path_tolerance);
  yes("tool changes", c.tool_changes);
  number("largest tool number", c.largest_tool_number, "");
  number("largest radius", c.largest_radius_mm, " mm");
  number("largest feed", c.largest_feed_mm_min, " mm/min");
  number("look-ahead", static_cast<double>(c.look_ahead_moves), " moves");
  for (const model::ProbeMacroRow& m : model::kProbeMacros) {
    if (model::find_probe_macro(d.id, m.id) != &m) continue;
    row("probe_macro", std::string(m.id) + ", which the shop confirms (probe_macro_confirmed: yes)");
    row("  blocks", std::string(m.blocks));
    row("  what it does", std::string(m.meaning));
    row("  before it is confirmed", std::string(m.first));
    row("  source", std::string(m.source));
  }
  return out;
}

}  // namespace

int run_shown(Session& s) {
  const std::string& id = s.options.words.front();
  if (s.options.command == Command::kControlsShow) {
    std::vector<std::string> ids;
    for (const controls::Dialect* d : controls::dialects()) ids.emplace_back(d->id);
    const controls::Dialect* found = controls::find_dialect(id);
    if (found == nullptr) return s.end(unknown_name("control", id, ids, "capstan controls list"), kUsage);
    return print(page_of(*found)) ? kDone : kImpossible;
  }
  if (s.options.command == Command::kMachinesShow) {
    const auto ids = tooling::shipped_machines();
    if (std::find(ids.begin(), ids.end(), id) == ids.end())
      return s.end(unknown_name("machine", id, ids, "capstan machines list"), kUsage);
    return print(tooling::shipped_text("machines/" + id + ".yaml")) ? kDone : kImpossible;
  }
  auto own = service::own_fixtures(s.options.inputs.fixtures, s.job);
  if (!own) return s.end(own.error(), kUnreadable);
  for (const std::string& file : s.options.inputs.fixtures) {
    const auto text = read_file(file, tooling::kDataFileCap);
    const auto tree = text ? tooling::parse_tree(*text, file) : tl::unexpected(text.error());
    if (!tree) return s.end(tree.error(), kUnreadable);
    if (const Node* found = with_id(*tree, id)) return print(yaml_of(*found, 0)) ? kDone : kImpossible;
  }
  const auto fixtures = tooling::known_fixtures(*std::move(own), s.job);
  if (!fixtures) return s.end(fixtures.error(), kUnreadable);
  const auto root = tooling::shipped_tree("fixtures.yaml");
  if (!root) return s.end(root.error(), kUnreadable);
  const Node* found = with_id(*root, id);
  if (found == nullptr)
    return s.end(unknown_name("fixture", id, tooling::ids_of(*fixtures), tooling::kListFixtures), kUsage);
  return print(yaml_of(*found, 0)) ? kDone : kImpossible;
}

int run_shop_init(Session& s) {
  const std::string path = s.options.outputs.empty() ? service::kShopFile : s.options.outputs.front();
  std::error_code error;
  if (std::filesystem::exists(path, error))
    return s.end({.code = "OUT-INPUT",
                  .message = "the file is there already, and stays as it is",
                  .file = path,
                  .hint = "edit it, or name another with -o"},
                 kUsage);
  const auto text = service::shop_template(s.options.words, path, s.job);
  if (!text) return s.end(text.error(), kUsage);
  if (auto ok = write_file(path, *text); !ok) return s.end(ok.error(), kUsage);
  s.summary = "wrote " + path + "; take the # off what else is to hold";
  return kDone;
}

int run_shop_show(Session& s) {
  const auto text = service::shop_text(s.options.inputs, s.job);
  if (!text) return s.end(text.error(), kUnreadable);
  return print(*text) ? kDone : kImpossible;
}

}  // namespace capstan::app
