#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "rules/engine/stray.h"
#include "rules/engine/table.h"
#include "rules/strategy/action.h"

namespace capstan::rules {

std::string_view embedded_file(std::string_view name);
std::span<const std::string_view> embedded_names();

namespace {

// A fault while reading one file: caught in `add_text`, so that it never leaves this source.
struct Fault {
  std::string code, message;
  YAML::Mark mark;
};

[[noreturn]] void refuse(const char* code, std::string message, const YAML::Node& at) {
  throw Fault{code, std::move(message), at.Mark()};
}

std::string text_of(const YAML::Node& node, const char* what, const YAML::Node& owner) {
  if (!node || !node.IsScalar()) refuse("RULE-ROW", std::string(what) + " is missing or not a text", owner);
  return node.Scalar();
}

double number_of(const YAML::Node& node, const std::string& what) {
  double value = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value))
    refuse("RULE-ROW", what + " is not a finite number", node);
  return value;
}

Side interval(const YAML::Node& node, const FactType& type) {
  const std::string name(type.name);
  if (!node.IsMap()) refuse("RULE-ROW", name + " needs {from: , below: } or {from: , to: }", node);
  Side side{type.from, type.below, 0, false};
  for (const auto& item : node) {
    const std::string key = item.first.as<std::string>();
    const double value = number_of(item.second, name + "." + key);
    const bool integer = type.kind == FactKind::kInteger;
    if (integer && value != std::floor(value)) refuse("RULE-ROW", name + "." + key + " is not whole", node);
    if (key == "from") {
      side.from = value;
    } else if (key == "below") {
      side.below = value;
    } else if (key == "to" && integer) {
      side.below = value + 1.0;
    } else {
      refuse("RULE-ROW", name + " has no bound named " + key, node);
    }
  }
  if (empty(side)) refuse("RULE-ROW", "the interval of " + name + " is empty", node);
  if (side.from < type.from || side.below > type.below)
    refuse("RULE-ROW", "the interval of " + name + " leaves the fact's domain", node);
  return side;
}

Side symbol_set(const YAML::Node& node, const FactType& type) {
  if (!node.IsSequence() || node.size() == 0)
    refuse("RULE-ROW", std::string(type.name) + " needs a list of symbols", node);
  Side side{0.0, 0.0, 0, true};
  for (const auto& item : node) {
    const std::string symbol = item.IsScalar() ? item.Scalar() : std::string();
    const auto it = std::find(type.symbols.begin(), type.symbols.end(), symbol);
    if (it == type.symbols.end())
      refuse("RULE-ROW", std::string(type.name) + " has no symbol '" + symbol + "'", node);
    side.symbols |= std::uint32_t{1} << (it - type.symbols.begin());
  }
  return side;
}

void read_conditions(const YAML::Node& node, const Table& table, Row& row) {
  for (const std::size_t fact : table.facts) row.when.push_back(domain_of(fact_types()[fact]));
  if (!node) return;
  if (!node.IsMap()) refuse("RULE-ROW", "when is not a map of facts", node);
  for (const auto& item : node) {
    const std::string name = item.first.as<std::string>();
    const auto fact = find_fact(name);
    if (!fact) refuse("RULE-FACT", "there is no fact named " + name, node);
    const auto at = std::find(table.facts.begin(), table.facts.end(), *fact);
    if (at == table.facts.end())
      refuse("RULE-FACT", "table " + table.name + " does not ask about " + name, node);
    const FactType& type = fact_types()[*fact];
    row.when[static_cast<std::size_t>(at - table.facts.begin())] =
        type.kind == FactKind::kSymbol ? symbol_set(item.second, type) : interval(item.second, type);
    row.conditional = true;
  }
}

constexpr std::size_t kLongestChain = 32;
constexpr std::size_t kMostChains = 64;

/// No parameter of a step and no value of a table means anything below zero; what is a part of a size is no
/// more than all of it.
void check_range(const std::string& key, double value, const YAML::Node& at) {
  if (value < 0.0) refuse("RULE-ROW", key + " is " + trimmed(value, 3) + ", below zero", at);
  const bool part = key.starts_with("of_") && key != "of_thickness";
  if (part && !(value > 0.0 && value <= 1.0))
    refuse("RULE-ROW", key + " is " + trimmed(value, 3) + "; a part of a size lies above 0 and at most at 1",
           at);
}

StepSpec read_step(const YAML::Node& node) {
  StepSpec step;
  if (node.IsScalar()) {
    step.action = node.Scalar();
  } else if (node.IsMap()) {
    step.action = text_of(node["do"], "do", node);
    for (const auto& item : node) {
      const std::string key = item.first.as<std::string>();
      if (key != "do") step.parameters.emplace_back(key, number_of(item.second, key));
    }
  } else {
    refuse("RULE-ROW", "a step is an action's name or a map with `do`", node);
  }
  const Action* action = find_action(step.action);
  if (action == nullptr) refuse("RULE-ROW", "there is no action named " + step.action, node);
  for (const auto& [key, value] : step.parameters) {
    if (std::none_of(action->parameters.begin(), action->parameters.end(),
                     [&k = key](const ActionParameter& p) { return p.name == k; }))
      refuse("RULE-ROW", step.action + " takes no " + key, node);
    check_range(key, value, node);
  }
  return step;
}

void read_conclusion(const YAML::Node& node, Row& row) {
  const int given = (node["chains"] ? 1 : 0) + (node["cannot"] ? 1 : 0) + (node["values"] ? 1 : 0);
  if (given != 1) refuse("RULE-ROW", "a row has exactly one of chains, cannot and values", node);
  if (const YAML::Node chains = node["chains"]) {
    if (!chains.IsSequence() || chains.size() == 0)
      refuse("RULE-ROW", "chains is not a list of chains", chains);
    if (chains.size() > kMostChains)
      refuse("RULE-ROW",
             std::to_string(chains.size()) + " chains; a row has at most " + std::to_string(kMostChains),
             chains);
    for (const auto& chain : chains) {
      if (!chain.IsSequence() || chain.size() == 0)
        refuse("RULE-ROW", "a chain is not a list of steps", chain);
      if (chain.size() > kLongestChain)
        refuse("RULE-ROW",
               "a chain of " + std::to_string(chain.size()) + " steps; it has at most " +
                   std::to_string(kLongestChain),
               chain);
      row.chains.emplace_back();
      for (const auto& step : chain) row.chains.back().push_back(read_step(step));
    }
  } else if (node["cannot"]) {
    row.cannot = text_of(node["cannot"], "cannot", node);
    if (row.cannot.empty()) refuse("RULE-ROW", "cannot gives no reason", node);
  } else {
    if (!node["values"].IsMap()) refuse("RULE-ROW", "values is not a map", node);
    static const std::vector<std::string> kValues{"as_grade", "machined",        "probe",    "flood",
                                                  "peck",     "coolant_through", "under_mm", "none"};
    for (const auto& item : node["values"]) {
      const std::string key = item.first.as<std::string>();
      if (std::find(kValues.begin(), kValues.end(), key) == kValues.end())
        refuse("RULE-ROW", "no table asks for a value named " + key, node);
    }
    for (const auto& item : node["values"]) {
      const std::string key = item.first.as<std::string>();
      row.values.emplace_back(key, number_of(item.second, key));
      check_range(key, row.values.back().second, item.second);
    }
    std::sort(row.values.begin(), row.values.end());
  }
}

Row read_row(const YAML::Node& node, const Table& table, const std::string& file) {
  if (!node.IsMap()) refuse("RULE-ROW", "a row is not a map", node);
  static const std::vector<std::string> kKnown{"id",     "priority", "when", "chains",
                                               "cannot", "values",   "text", "source"};
  for (const auto& item : node) {
    const std::string key = item.first.as<std::string>();
    if (std::find(kKnown.begin(), kKnown.end(), key) == kKnown.end())
      refuse("RULE-ROW", "a row has no " + key, node);
  }
  Row row;
  row.id = text_of(node["id"], "id", node);
  row.source = text_of(node["source"], "source", node);
  if (row.id.empty() || row.source.empty()) refuse("RULE-ROW", "id and source must not be empty", node);
  if (node["text"]) row.text = text_of(node["text"], "text", node);
  if (node["priority"]) {
    const double p = number_of(node["priority"], "priority");
    if (p != std::floor(p) || std::abs(p) > 1e6) refuse("RULE-ROW", "priority is not a whole number", node);
    row.priority = static_cast<int>(p);
  }
  row.file = file;
  row.line = static_cast<std::uint64_t>(node.Mark().line + 1);
  read_conditions(node["when"], table, row);
  read_conclusion(node, row);
  return row;
}

Table& open_table(RuleBase& base, const YAML::Node& root, const std::string& file, bool shipped) {
  const std::string name = text_of(root["table"], "table", root);
  const auto it =
      std::find_if(base.tables.begin(), base.tables.end(), [&](const Table& t) { return t.name == name; });
  if (it != base.tables.end()) {
    if (root["facts"] && shipped) refuse("RULE-TABLE", "table " + name + " is defined twice", root);
    return *it;
  }
  if (!shipped) refuse("RULE-TABLE", "there is no table named " + name, root);
  Table table{name, {}, {}, file};
  if (!root["facts"] || !root["facts"].IsSequence())
    refuse("RULE-TABLE", "table " + name + " names no facts", root);
  for (const auto& item : root["facts"]) {
    const auto fact = find_fact(item.as<std::string>());
    if (!fact) refuse("RULE-FACT", "there is no fact named " + item.as<std::string>(), root["facts"]);
    table.facts.push_back(*fact);
  }
  base.tables.push_back(std::move(table));
  return base.tables.back();
}

void add_row(Table& table, Row row, const std::vector<std::string>& of_this_file, const YAML::Node& at) {
  if (std::find(of_this_file.begin(), of_this_file.end(), row.id) != of_this_file.end())
    refuse("RULE-ROW", "the id " + row.id + " stands twice", at);
  const auto same =
      std::find_if(table.rows.begin(), table.rows.end(), [&](const Row& r) { return r.id == row.id; });
  if (same != table.rows.end()) {
    *same = std::move(row);
  } else {
    table.rows.push_back(std::move(row));
  }
}

void read_capabilities(const YAML::Node& node, RuleBase& base) {
  for (const auto& item : node) {
    Capability c;
    c.action = text_of(item["action"], "action", item);
    if (find_action(c.action) == nullptr) refuse("RULE-ROW", "there is no action named " + c.action, item);
    static const std::vector<std::string> kKnown{"action",      "finest_grade", "finest_ra_um",
                                                 "position_mm", "form_mm",      "source"};
    for (const auto& field : item) {
      const std::string key = field.first.as<std::string>();
      if (std::find(kKnown.begin(), kKnown.end(), key) == kKnown.end())
        refuse("RULE-ROW", "a capability has no " + key, item);
    }
    const auto claimed = [&item](const char* key) -> std::optional<double> {
      if (!item[key]) return std::nullopt;
      const double value = number_of(item[key], key);
      if (value < 0.0) refuse("RULE-ROW", std::string(key) + " is negative", item);
      return value;
    };
    if (const auto grade = claimed("finest_grade")) {
      if (*grade != std::floor(*grade) || *grade > 18.0)
        refuse("RULE-ROW", "finest_grade is no ISO 286 grade of 0 to 18", item);
      c.finest_grade = static_cast<int>(*grade);
    }
    c.finest_ra_um = claimed("finest_ra_um");
    c.position_mm = claimed("position_mm");
    c.form_mm = claimed("form_mm");
    c.source = text_of(item["source"], "source", item);
    const auto it = std::find_if(base.capabilities.begin(), base.capabilities.end(),
                                 [&](const Capability& k) { return k.action == c.action; });
    if (it != base.capabilities.end()) {
      *it = std::move(c);
    } else {
      base.capabilities.push_back(std::move(c));
    }
  }
}

void add_document(RuleBase& base, const YAML::Node& root, const std::string& file, bool shipped) {
  if (!root.IsMap()) refuse("RULE-SYNTAX", "the file is not a map", root);
  if (root["capabilities"]) read_capabilities(root["capabilities"], base);
  if (!root["table"]) {
    if (!root["capabilities"]) refuse("RULE-SYNTAX", "the file has neither table nor capabilities", root);
    return;
  }
  Table& table = open_table(base, root, file, shipped);
  const YAML::Node rows = root["rows"];
  if (!rows || !rows.IsSequence()) refuse("RULE-ROW", "rows is not a list", root);
  std::vector<std::string> ids;
  for (const auto& node : rows) {
    Row row = read_row(node, table, file);
    const std::string id = row.id;
    add_row(table, std::move(row), ids, node);
    ids.push_back(id);
  }
}

Status add_text(RuleBase& base, const std::string& name, const std::string& text, bool shipped) {
  Diagnostic d;
  d.file = name;
  if (const std::uint64_t line = stray_sign(text); line != 0)
    return fail({.code = "RULE-SYNTAX",
                 .message = "what stands here belongs to no value",
                 .file = name,
                 .line = line,
                 .expected = "a map of table, facts and rows, or of capabilities"});
  try {
    for (const YAML::Node& root : YAML::LoadAll(text)) add_document(base, root, name, shipped);
    return {};
  } catch (const Fault& f) {
    d.code = f.code;
    d.message = f.message;
    d.line = static_cast<std::uint64_t>(f.mark.line + 1);
  } catch (const YAML::Exception& e) {
    d.code = "RULE-SYNTAX";
    d.message = e.msg;
    d.line = static_cast<std::uint64_t>(e.mark.line + 1);
  }
  return fail(std::move(d));
}

void sort_all(RuleBase& base) {
  std::sort(base.tables.begin(), base.tables.end(),
            [](const Table& a, const Table& b) { return a.name < b.name; });
  for (Table& t : base.tables) {
    std::sort(t.rows.begin(), t.rows.end(), [](const Row& a, const Row& b) {
      return a.priority != b.priority ? a.priority < b.priority : a.id < b.id;
    });
  }
}

Result<std::vector<std::string>> yaml_files(const std::string& directory) {
  std::error_code error;
  std::vector<std::string> files;
  std::filesystem::directory_iterator it(directory, error);
  for (; !error && it != std::filesystem::directory_iterator(); it.increment(error)) {
    const std::string extension = it->path().extension().string();
    if (extension == ".yaml" || extension == ".yml") files.push_back(it->path().string());
  }
  if (error) return fail("RULE-IO", directory + ": " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> shipped_texts() {
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string_view name : embedded_names()) out.emplace_back(name, embedded_file(name));
  return out;
}

Result<RuleBase> rules_from_texts(const std::vector<std::pair<std::string, std::string>>& named_texts) {
  RuleBase base;
  for (const auto& [name, text] : named_texts) {
    if (auto s = add_text(base, name, text, true); !s) return fail(s.error());
  }
  sort_all(base);
  return base;
}

Result<RuleBase> load_rules(const std::string& extra_directory, Job& job) {
  auto base = rules_from_texts(shipped_texts());
  if (!base || extra_directory.empty()) return base;
  const auto files = yaml_files(extra_directory);
  if (!files) return fail(files.error());
  if (files->empty())
    job.warn("RULE-NONE", "no *.yaml in " + extra_directory + ": the shipped rules stand alone");
  for (const std::string& file : *files) {
    constexpr std::size_t kTableCap = std::size_t{4} << 20;  // the shipped tables have 20 kB at most
    auto text = read_file(file, kTableCap);
    if (!text) return fail(text.error());
    if (auto s = add_text(*base, file, *text, false); !s) return fail(s.error());
  }
  sort_all(*base);
  return base;
}

}  // namespace capstan::rules
