#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/base/tables/data_tree.h"
#include "rules/engine/stray.h"
#include "rules/engine/table.h"
#include "rules/strategy/action.h"

namespace capstan::rules {

std::string_view embedded_file(std::string_view name);
std::string_view embedded_tree(std::string_view name);
std::span<const std::string_view> embedded_names();

namespace {

// A fault while reading one file: caught in `add_text`, so that it never leaves this source.
struct Fault {
  std::string code, message;
  std::uint64_t line;
};

[[noreturn]] void refuse(const char* code, std::string message, const DataNode& at) {
  throw Fault{code, std::move(message), at.line};
}

bool is_scalar(const DataNode& node) { return node.kind == DataNode::Kind::kScalar; }
bool is_map(const DataNode& node) { return node.kind == DataNode::Kind::kMap; }
bool is_filled_list(const DataNode& node) {
  return node.kind == DataNode::Kind::kList && !node.items.empty();
}

std::string text_of(const DataNode& owner, const char* what) {
  const DataNode* node = owner.find(what);
  if (node == nullptr || !is_scalar(*node))
    refuse("RULE-ROW", std::string(what) + " is missing or not a text", owner);
  return node->text;
}

/// The scalar as a number; yaml-cpp's own reading where it is not plainly one ("+.5", ".inf").
std::optional<double> number_in(const std::string& text) {
  if (!text.empty() && text.front() != '+') {
    if (const auto plain = parse_double(text)) return plain;
  }
  double value = 0.0;
  if (!YAML::convert<double>::decode(YAML::Node(text), value) || !std::isfinite(value)) return std::nullopt;
  return value;
}

double number_of(const DataNode& node, const std::string& what) {
  const auto value = is_scalar(node) ? number_in(node.text) : std::nullopt;
  if (!value) refuse("RULE-ROW", what + " is not a finite number", node);
  return *value;
}

Side interval(const DataNode& node, const FactType& type) {
  const std::string name(type.name);
  if (!is_map(node)) refuse("RULE-ROW", name + " needs {from: , below: } or {from: , to: }", node);
  Side side{type.from, type.below, 0, false};
  for (const auto& [key, bound] : node.entries) {
    const double value = number_of(bound, name + "." + key);
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

Side symbol_set(const DataNode& node, const FactType& type) {
  if (!is_filled_list(node)) refuse("RULE-ROW", std::string(type.name) + " needs a list of symbols", node);
  Side side{0.0, 0.0, 0, true};
  for (const DataNode& item : node.items) {
    const std::string& symbol = item.text;
    const auto it = std::find(type.symbols.begin(), type.symbols.end(), symbol);
    if (it == type.symbols.end())
      refuse("RULE-ROW", std::string(type.name) + " has no symbol '" + symbol + "'", node);
    side.symbols |= std::uint32_t{1} << (it - type.symbols.begin());
  }
  return side;
}

void read_conditions(const DataNode* node, const Table& table, Row& row) {
  for (const std::size_t fact : table.facts) row.when.push_back(domain_of(fact_types()[fact]));
  if (node == nullptr) return;
  if (!is_map(*node)) refuse("RULE-ROW", "when is not a map of facts", *node);
  for (const auto& [name, condition] : node->entries) {
    const auto fact = find_fact(name);
    if (!fact) refuse("RULE-FACT", "there is no fact named " + name, *node);
    const auto at = std::find(table.facts.begin(), table.facts.end(), *fact);
    if (at == table.facts.end())
      refuse("RULE-FACT", "table " + table.name + " does not ask about " + name, *node);
    const FactType& type = fact_types()[*fact];
    row.when[static_cast<std::size_t>(at - table.facts.begin())] =
        type.kind == FactKind::kSymbol ? symbol_set(condition, type) : interval(condition, type);
    row.conditional = true;
  }
}

constexpr std::size_t kLongestChain = 32;
constexpr std::size_t kMostChains = 64;

/// No parameter of a step and no value of a table means anything below zero; what is a part of a size is no
/// more than all of it.
void check_range(const std::string& key, double value, const DataNode& at) {
  if (value < 0.0) refuse("RULE-ROW", key + " is " + trimmed(value, 3) + ", below zero", at);
  const bool part = key.starts_with("of_") && key != "of_thickness";
  if (part && !(value > 0.0 && value <= 1.0))
    refuse("RULE-ROW", key + " is " + trimmed(value, 3) + "; a part of a size lies above 0 and at most at 1",
           at);
}

StepSpec read_step(const DataNode& node) {
  StepSpec step;
  if (is_scalar(node)) {
    step.action = node.text;
  } else if (is_map(node)) {
    step.action = text_of(node, "do");
    for (const auto& [key, value] : node.entries)
      if (key != "do") step.parameters.emplace_back(key, number_of(value, key));
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

void read_chains(const DataNode& chains, Row& row) {
  if (!is_filled_list(chains)) refuse("RULE-ROW", "chains is not a list of chains", chains);
  if (chains.items.size() > kMostChains)
    refuse("RULE-ROW",
           std::to_string(chains.items.size()) + " chains; a row has at most " + std::to_string(kMostChains),
           chains);
  for (const DataNode& chain : chains.items) {
    if (!is_filled_list(chain)) refuse("RULE-ROW", "a chain is not a list of steps", chain);
    if (chain.items.size() > kLongestChain)
      refuse("RULE-ROW",
             "a chain of " + std::to_string(chain.items.size()) + " steps; it has at most " +
                 std::to_string(kLongestChain),
             chain);
    row.chains.emplace_back();
    for (const DataNode& step : chain.items) row.chains.back().push_back(read_step(step));
  }
}

void read_values(const DataNode& values, Row& row) {
  if (!is_map(values)) refuse("RULE-ROW", "values is not a map", values);
  static const std::vector<std::string> kValues{"as_grade",        "machined", "probe", "flood",     "peck",
                                                "coolant_through", "under_mm", "none",  "retract_mm"};
  for (const auto& [key, value] : values.entries) {
    if (std::find(kValues.begin(), kValues.end(), key) == kValues.end())
      refuse("RULE-ROW", "no table asks for a value named " + key, values);
  }
  for (const auto& [key, value] : values.entries) {
    row.values.emplace_back(key, number_of(value, key));
    check_range(key, row.values.back().second, value);
  }
  std::sort(row.values.begin(), row.values.end());
}

void read_conclusion(const DataNode& node, Row& row) {
  const DataNode* chains = node.find("chains");
  const DataNode* cannot = node.find("cannot");
  const DataNode* values = node.find("values");
  if ((chains != nullptr ? 1 : 0) + (cannot != nullptr ? 1 : 0) + (values != nullptr ? 1 : 0) != 1)
    refuse("RULE-ROW", "a row has exactly one of chains, cannot and values", node);
  if (chains != nullptr) {
    read_chains(*chains, row);
  } else if (cannot != nullptr) {
    row.cannot = text_of(node, "cannot");
    if (row.cannot.empty()) refuse("RULE-ROW", "cannot gives no reason", node);
  } else {
    read_values(*values, row);
  }
}

/// Refuses a key that is none of `known`.
void check_keys(const DataNode& node, const std::vector<std::string>& known, const char* what) {
  for (const auto& [key, value] : node.entries)
    if (std::find(known.begin(), known.end(), key) == known.end())
      refuse("RULE-ROW", std::string(what) + " has no " + key, node);
}

Row read_row(const DataNode& node, const Table& table, const std::string& file) {
  if (!is_map(node)) refuse("RULE-ROW", "a row is not a map", node);
  static const std::vector<std::string> kKnown{"id",     "priority", "when", "chains",
                                               "cannot", "values",   "text", "source"};
  check_keys(node, kKnown, "a row");
  Row row;
  row.id = text_of(node, "id");
  row.source = text_of(node, "source");
  if (row.id.empty() || row.source.empty()) refuse("RULE-ROW", "id and source must not be empty", node);
  if (node.find("text") != nullptr) row.text = text_of(node, "text");
  if (const DataNode* priority = node.find("priority")) {
    const double p = number_of(*priority, "priority");
    if (p != std::floor(p) || std::abs(p) > 1e6) refuse("RULE-ROW", "priority is not a whole number", node);
    row.priority = static_cast<int>(p);
  }
  row.file = file;
  row.line = node.line;
  read_conditions(node.find("when"), table, row);
  read_conclusion(node, row);
  return row;
}

Table& open_table(RuleBase& base, const DataNode& root, const std::string& file, bool shipped) {
  const std::string name = text_of(root, "table");
  const auto it =
      std::find_if(base.tables.begin(), base.tables.end(), [&](const Table& t) { return t.name == name; });
  if (it != base.tables.end()) {
    if (root.find("facts") != nullptr && shipped)
      refuse("RULE-TABLE", "table " + name + " is defined twice", root);
    return *it;
  }
  if (!shipped) refuse("RULE-TABLE", "there is no table named " + name, root);
  Table table{name, {}, {}, file};
  const DataNode* facts = root.find("facts");
  if (facts == nullptr || facts->kind != DataNode::Kind::kList)
    refuse("RULE-TABLE", "table " + name + " names no facts", root);
  for (const DataNode& item : facts->items) {
    const auto fact = find_fact(item.text);
    if (!fact) refuse("RULE-FACT", "there is no fact named " + item.text, *facts);
    table.facts.push_back(*fact);
  }
  base.tables.push_back(std::move(table));
  return base.tables.back();
}

/// A shop's row replaces the shipped one of its id; of the shipped rows none replaces another.
void add_row(Table& table, Row row, const std::vector<std::string>& of_this_file, bool shipped,
             const DataNode& at) {
  const auto same =
      std::find_if(table.rows.begin(), table.rows.end(), [&](const Row& r) { return r.id == row.id; });
  const bool here = std::find(of_this_file.begin(), of_this_file.end(), row.id) != of_this_file.end();
  if (here || (shipped && same != table.rows.end()))
    refuse("RULE-ROW", "the id " + row.id + " occurs twice", at);
  if (same != table.rows.end()) {
    *same = std::move(row);
  } else {
    table.rows.push_back(std::move(row));
  }
}

void read_capabilities(const DataNode& node, RuleBase& base, bool shipped) {
  if (is_map(node)) refuse("RULE-ROW", "capabilities is not a list", node);
  for (const DataNode& item : node.items) {
    Capability c;
    c.action = text_of(item, "action");
    if (find_action(c.action) == nullptr) refuse("RULE-ROW", "there is no action named " + c.action, item);
    static const std::vector<std::string> kKnown{"action",      "finest_grade", "finest_ra_um",
                                                 "position_mm", "form_mm",      "source"};
    check_keys(item, kKnown, "a capability");
    const auto claimed = [&item](const char* key) -> std::optional<double> {
      const DataNode* given = item.find(key);
      if (given == nullptr) return std::nullopt;
      const double value = number_of(*given, key);
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
    c.source = text_of(item, "source");
    const auto it = std::find_if(base.capabilities.begin(), base.capabilities.end(),
                                 [&](const Capability& k) { return k.action == c.action; });
    if (shipped && it != base.capabilities.end())
      refuse("RULE-ROW", "the capability of " + c.action + " occurs twice", item);
    if (it != base.capabilities.end()) {
      *it = std::move(c);
    } else {
      base.capabilities.push_back(std::move(c));
    }
  }
}

void add_document(RuleBase& base, const DataNode& root, const std::string& file, bool shipped) {
  if (!is_map(root)) refuse("RULE-SYNTAX", "the file is not a map", root);
  const DataNode* capabilities = root.find("capabilities");
  if (capabilities != nullptr) read_capabilities(*capabilities, base, shipped);
  if (root.find("table") == nullptr) {
    if (capabilities == nullptr) refuse("RULE-SYNTAX", "the file has neither table nor capabilities", root);
    return;
  }
  Table& table = open_table(base, root, file, shipped);
  const DataNode* rows = root.find("rows");
  if (rows == nullptr || rows->kind != DataNode::Kind::kList) refuse("RULE-ROW", "rows is not a list", root);
  std::vector<std::string> ids;
  for (const DataNode& node : rows->items) {
    Row row = read_row(node, table, file);
    const std::string id = row.id;
    add_row(table, std::move(row), ids, shipped, node);
    ids.push_back(id);
  }
}

/// A document as yaml-cpp reads it: aliases stand for what they name. So it can be larger than its text, or
/// hold itself, and is read within bounds.
DataNode tree_of(const YAML::Node& node, int depth, std::size_t& values) {
  constexpr int kDeepest = 64;
  constexpr std::size_t kMostValues = std::size_t{1} << 20;
  DataNode out{.line = static_cast<std::uint64_t>(node.Mark().line + 1)};
  if (depth > kDeepest) refuse("RULE-SYNTAX", "nested deeper than " + std::to_string(kDeepest), out);
  // A long text counts for its length: an alias repeats it.
  constexpr std::size_t kBytesPerValue = 64;
  values += 1 + node.Scalar().size() / kBytesPerValue;
  if (values > kMostValues)
    refuse("RULE-SYNTAX",
           "more than " + std::to_string(kMostValues) + " values, or as much text, with what aliases repeat",
           out);
  if (node.IsScalar()) {
    out.kind = DataNode::Kind::kScalar;
    out.text = node.Scalar();
  } else if (node.IsSequence()) {
    out.kind = DataNode::Kind::kList;
    for (const auto& item : node) out.items.push_back(tree_of(item, depth + 1, values));
  } else if (node.IsMap()) {
    out.kind = DataNode::Kind::kMap;
    for (const auto& item : node)
      out.entries.emplace_back(item.first.as<std::string>(), tree_of(item.second, depth + 1, values));
  }
  return out;
}

/// One document of a file; a file may hold several.
struct Document {
  std::string file;
  DataNode root;
};

/// Does `work` on the file `name`, and returns the fault that ended it.
template <class Work>
Status on_file(const std::string& name, Work work) {
  Diagnostic d;
  d.file = name;
  try {
    work();
    return {};
  } catch (const Fault& f) {
    d.code = f.code;
    d.message = f.message;
    d.line = f.line;
  } catch (const YAML::Exception& e) {
    d.code = "RULE-SYNTAX";
    d.message = e.msg;
    d.line = static_cast<std::uint64_t>(e.mark.line + 1);
  }
  return fail(std::move(d));
}

/// Adds the documents of a text to those that are there.
Status read_text(const std::string& name, const std::string& text, std::vector<Document>& documents) {
  if (const std::uint64_t line = stray_sign(text); line != 0)
    return fail({.code = "RULE-SYNTAX",
                 .message = "this line belongs to no value",
                 .file = name,
                 .line = line,
                 .expected = "a map of table, facts and rows, or of capabilities"});
  return on_file(name, [&] {
    std::size_t values = 0;
    for (const YAML::Node& root : YAML::LoadAll(text)) documents.push_back({name, tree_of(root, 0, values)});
  });
}

Status add(RuleBase& base, const Document& document, bool shipped) {
  return on_file(document.file, [&] { add_document(base, document.root, document.file, shipped); });
}

/// The base that these documents make by themselves. A table's facts stand in one of them, rows of it in any.
Result<RuleBase> base_of(std::vector<Document> documents) {
  std::stable_partition(documents.begin(), documents.end(),
                        [](const Document& d) { return is_map(d.root) && d.root.find("facts") != nullptr; });
  RuleBase base;
  for (const Document& d : documents) {
    poll();
    if (auto ok = add(base, d, true); !ok) return fail(ok.error());
  }
  return base;
}

/// What is compiled in, without parsing.
Result<RuleBase> shipped_rules() {
  std::vector<Document> documents;
  for (const std::string_view name : embedded_names())
    for (DataNode& root : unpack(embedded_tree(name))) {
      poll();
      documents.push_back({std::string(name), std::move(root)});
    }
  return base_of(std::move(documents));
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
  std::vector<Document> documents;
  for (const auto& [name, text] : named_texts)
    if (auto ok = read_text(name, text, documents); !ok) return fail(ok.error());
  auto base = base_of(std::move(documents));
  if (base) sort_all(*base);
  return base;
}

Result<RuleBase> load_rules(const std::string& extra_directory, Job& job) {
  auto base = shipped_rules();
  if (!base) return base;
  sort_all(*base);
  if (extra_directory.empty()) return base;
  const auto files = yaml_files(extra_directory);
  if (!files) return fail(files.error());
  if (files->empty())
    job.warn("RULE-NONE", "no *.yaml in " + extra_directory + ": the shipped rules are used alone");
  for (const std::string& file : *files) {
    constexpr std::size_t kTableCap = std::size_t{4} << 20;  // the shipped tables have 20 kB at most
    auto text = read_file(file, kTableCap);
    if (!text) return fail(text.error());
    std::vector<Document> documents;
    if (auto ok = read_text(file, *text, documents); !ok) return fail(ok.error());
    for (const Document& d : documents)
      if (auto ok = add(*base, d, false); !ok) return fail(ok.error());
  }
  sort_all(*base);
  return base;
}

}  // namespace capstan::rules
