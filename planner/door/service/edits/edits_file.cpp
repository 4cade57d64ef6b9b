#include "planner/door/service/edits/edits_file.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "planner/door/service/edits/yaml_text.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/text.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/edit/restrictions.h"
#include "tooling/shop/data/tree.h"

namespace capstan::service {
namespace {

using model::Edit;
using model::EditKind;
using model::EditOf;
using tooling::Node;

constexpr const char* kShape =
    "capstan_edits: 1, edits: a list of set, pin, limit, forbid or order with its text";

Diagnostic fault(const std::string& file, std::uint64_t line, std::string what) {
  return {.code = "EDIT-FILE", .message = std::move(what), .file = file, .line = line, .expected = kShape};
}

/// One entry of the list: a kind and its text.
Result<Edit> edit_of(const Node& n, const std::string& file, std::size_t number) {
  if (n.kind != Node::Kind::kMap || n.entries.size() != 1)
    return fail(
        fault(file, n.line, "edit " + std::to_string(number) + " is not one kind of edit with its text"));
  const auto& [word, value] = n.entries.front();
  std::vector<std::string> known;
  for (const EditKind kind : model::kEditKinds) {
    known.emplace_back(to_text(kind));
    if (known.back() != word) continue;
    if (value.kind != Node::Kind::kScalar)
      return fail(fault(file, value.line, "edit " + std::to_string(number) + ": its text is no text"));
    auto e = model::parse_edit(
        kind, value.text,
        "edit " + std::to_string(number) + " of " + std::filesystem::path(file).filename().string());
    if (e) return e;
    Diagnostic d = e.error();
    d.file = file;
    d.line = value.line;
    return fail(std::move(d));
  }
  Diagnostic d = unknown_name("kind of edit", word, known, "capstan plan --help");
  d.file = file;
  d.line = n.line;
  return fail(std::move(d));
}

std::vector<std::string> operation_words() {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < model::kTypeCount; ++i) {
    const auto type = static_cast<model::TypeId>(i);
    if (!model::is_a(type, model::TypeId::kMachiningOperation)) continue;
    if (!model::noun_type(type).keyword.empty()) out.push_back(lower_text(model::noun_type(type).keyword));
  }
  return out;
}

std::vector<std::string> strategy_words() {
  std::vector<std::string> out;
  for (int k = 1; k <= static_cast<int>(model::StrategyKind::kCenterMilling); ++k)
    out.emplace_back(model::word_of(static_cast<model::StrategyKind>(k)));
  out.emplace_back(model::kConstantEngagementWord);
  return out;
}

bool is_number(std::string_view value) {
  return value.size() > 1 && value.front() == 'T' &&
         std::all_of(value.begin() + 1, value.end(), [](char c) { return c >= '0' && c <= '9'; });
}

Status known_word(const Edit& e, std::string_view what, const std::vector<std::string>& words) {
  const std::string value = lower_text(e.value);
  if (std::any_of(words.begin(), words.end(), [&](const std::string& w) { return model::names(value, w); }))
    return {};
  Diagnostic d = unknown_name(what, e.value, words, "capstan plan --help");
  d.message = words_of(e) + ": " + d.message;
  for (const std::string& w : words) d.expected += (d.expected.empty() ? "" : ", ") + w;
  return fail(std::move(d));
}

Status known_tool(const Edit& e, const std::vector<model::Cutter>& library, const model::Plan& plan) {
  if (e.value.empty()) return {};
  std::vector<std::string> known;
  bool numbers = false;
  for (const auto* cutters : {&library, &plan.cutters}) {
    for (const model::Cutter& c : *cutters) {
      known.push_back(c.id);
      if (c.pocket <= 0) continue;
      numbers = true;
      known.push_back("T" + std::to_string(c.pocket));
    }
  }
  const auto means = [&](const std::string& k) {
    return k == e.value || (e.kind == EditKind::kForbid && model::names(e.value, k));
  };
  if (std::any_of(known.begin(), known.end(), means)) return {};
  if (is_number(e.value) && !numbers) {
    // The numbers of a plan are known when it is planned without what is set.
    if (e.kind != EditKind::kForbid) return {};
    return fail(
        {.code = "EDIT-NUMBER",
         .message = words_of(e) + ": the library gives its tools no numbers",
         .hint = "forbid the tool by its name (capstan tools list), or name a list with tool numbers"});
  }
  Diagnostic d = unknown_name("tool", e.value, known, "capstan tools list");
  d.message = words_of(e) + ": " + d.message;
  return fail(std::move(d));
}

}  // namespace

Result<std::vector<Edit>> read_edits(std::string_view text, const std::string& file, Job& job) {
  const auto root = tooling::parse_tree(text, file);
  if (!root) return tl::unexpected(root.error());
  std::vector<Diagnostic> faults;
  const Node* list = root->find("edits");
  const Node* version = root->find("capstan_edits");
  if (root->kind != Node::Kind::kMap || list == nullptr || version == nullptr)
    return fail(fault(file, root->line, "no edits: capstan_edits and edits are wanted"));
  if (version->text != std::to_string(kEditsVersion))
    return fail(fault(file, version->line, "version '" + version->text + "' is not known"));
  for (const auto& [key, node] : root->entries) {
    if (key != "edits" && key != "capstan_edits")
      faults.push_back(fault(file, node.line, "'" + key + "' is not known"));
  }
  if (list->kind != Node::Kind::kList && list->kind != Node::Kind::kNull)
    faults.push_back(fault(file, list->line, "edits is no list"));
  if (list->items.size() > kMostEdits)
    return fail(fault(file, list->line, "more than " + std::to_string(kMostEdits) + " edits"));
  std::vector<Edit> out;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    auto e = edit_of(list->items[i], file, i + 1);
    if (e) {
      out.push_back(*std::move(e));
    } else {
      faults.push_back(e.error());
    }
  }
  if (auto wrong = tooling::tell(std::move(faults), job)) return fail(*std::move(wrong));
  return out;
}

Result<std::vector<Edit>> load_edits(const std::string& file, Job& job) {
  auto text = read_file(file, tooling::kDataFileCap);
  if (!text) return tl::unexpected(text.error());
  return read_edits(*text, file, job);
}

std::string edits_text(const std::vector<Edit>& edits) {
  std::string out = "# What a person decided of a plan; `capstan plan --edits` takes it.\ncapstan_edits: " +
                    std::to_string(kEditsVersion) + "\nedits:" + (edits.empty() ? " []\n" : "\n");
  for (const Edit& e : edits)
    out += "  - " + std::string(to_text(e.kind)) + ": " + yaml_text(model::text_of(e)) + "\n";
  return out;
}

Status known_names(const std::vector<Edit>& edits, const std::vector<model::Cutter>& library,
                   const model::Plan& plan) {
  for (const Edit& e : edits) {
    if (e.kind == EditKind::kLimit || e.kind == EditKind::kOrder) continue;
    Status ok;
    if (e.of == EditOf::kTool) ok = known_tool(e, library, plan);
    if (e.of == EditOf::kOperation) ok = known_word(e, "kind of operation", operation_words());
    if (e.of == EditOf::kStrategy) ok = known_word(e, "strategy", strategy_words());
    if (!ok) return ok;
  }
  return {};
}

}  // namespace capstan::service
