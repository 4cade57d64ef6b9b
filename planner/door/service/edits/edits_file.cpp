#include "planner/door/service/edits/edits_file.h"

#include <filesystem>
#include <utility>

#include "planner/door/service/edits/yaml_text.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "tooling/shop/data/tree.h"

namespace capstan::service {
namespace {

using model::Edit;
using model::EditKind;
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
      return fail(
          fault(file, value.line, "edit " + std::to_string(number) + ": its text is a list or a map"));
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

}  // namespace

Result<std::vector<Edit>> read_edits(std::string_view text, const std::string& file, Job& job) {
  const auto root = tooling::parse_tree(text, file);
  if (!root) return tl::unexpected(root.error());
  std::vector<Diagnostic> faults;
  const Node* list = root->find("edits");
  const Node* version = root->find("capstan_edits");
  if (root->kind != Node::Kind::kMap || list == nullptr || version == nullptr)
    return fail(
        fault(file, root->line,
              "it does not say that it holds edits: the entries capstan_edits and edits are missing"));
  if (version->text != std::to_string(kEditsVersion))
    return fail(fault(file, version->line,
                      "version '" + version->text + "' of a file of edits is not known; this program reads " +
                          std::to_string(kEditsVersion)));
  for (const auto& [key, node] : root->entries) {
    if (key != "edits" && key != "capstan_edits")
      faults.push_back(fault(file, node.line, "the entry '" + key + "' is not known"));
  }
  if (list->kind != Node::Kind::kList && list->kind != Node::Kind::kNull)
    faults.push_back(fault(file, list->line, "edits is not a list"));
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

}  // namespace capstan::service
