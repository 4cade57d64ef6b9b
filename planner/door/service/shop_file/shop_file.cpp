#include "planner/door/service/shop_file/shop_file.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/door/service/edits/yaml_text.h"
#include "planner/door/service/options.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "tooling/shop/data/tree.h"

namespace capstan::service {
namespace {

namespace fs = std::filesystem;
using tooling::Node;

constexpr std::string_view kVersionKey = "capstan_shop", kMaterials = "materials";

Diagnostic fault(const std::string& file, std::uint64_t line, std::string what) {
  return {.code = "SHOP-FILE",
          .message = std::move(what),
          .file = file,
          .line = line,
          .expected = "capstan_shop: 1, then entries as `capstan shop init` writes them"};
}

std::vector<std::string> known_entries() {
  std::vector<std::string> out;
  for (const Option& o : options()) {
    if (o.of_shop) out.emplace_back(o.name);
  }
  out.emplace_back(kMaterials);
  return out;
}

/// Whether an entry may name a file or a folder.
bool names_a_file(std::string_view key) {
  static constexpr std::array<std::string_view, 7> kFiles = {"machine", "tools",       "material", "rules",
                                                             "cases",   "workholding", "cache"};
  return std::find(kFiles.begin(), kFiles.end(), key) != kFiles.end();
}

/// A path of the file counts from its folder; what is no file there is a name, or counts as it is.
std::string placed(const std::string& shop, std::string_view key, const std::string& text) {
  const fs::path folder = fs::path(shop).parent_path();
  if (folder.empty() || fs::path(text).is_absolute()) return text;
  const fs::path there = folder / text;
  std::error_code error;
  // Caches and case bases are made where they are not.
  const bool made = key == "cache" || (key == "cases" && text.find(':') == std::string::npos);
  return made || fs::exists(there, error) ? there.string() : text;
}

/// The root of a shop file's text, with its version looked at.
Result<Node> root_of(std::string_view text, const std::string& file) {
  auto root = tooling::parse_tree(text, file);
  if (!root) return tl::unexpected(root.error());
  const Node* version = root->kind == Node::Kind::kMap ? root->find(kVersionKey) : nullptr;
  if (version == nullptr) return fail(fault(file, root->line, "no shop's settings: capstan_shop is wanted"));
  if (version->text != "1")
    return fail(fault(file, version->line, "version '" + version->text + "' is not known"));
  return root;
}

Status take_materials(Request& r, const std::string& file, const Node& value) {
  if (value.kind != Node::Kind::kList) return fail(fault(file, value.line, "materials is no list of files"));
  for (const Node& n : value.items) {
    if (n.kind != Node::Kind::kScalar || n.text.empty())
      return fail(fault(file, n.line, "an entry of materials is no file"));
    r.materials.push_back(placed(file, "material", n.text));
  }
  return {};
}

Status take_entry(Request& r, const std::string& file, const std::string& key, const Node& value, Job& job) {
  if (key == kMaterials) return take_materials(r, file, value);
  const Option* o = find_option(key);
  if (o == nullptr || !o->of_shop) {
    Diagnostic d = unknown_name("entry", key, known_entries(), "capstan shop init");
    d.file = file;
    d.line = value.line;
    return fail(std::move(d));
  }
  if (value.kind != Node::Kind::kScalar) return fail(fault(file, value.line, key + " is no text"));
  if (r.given.contains(key)) return {};
  if (key == "control" && r.given.contains("machine")) {
    job.note("SHOP-CONTROL",
             file + ": its control is that of its own machine; the machine named here has its own");
    return {};
  }
  const std::string text = names_a_file(key) ? placed(file, key, value.text) : value.text;
  Request one = r;
  one.sign.clear();
  if (auto ok = set(one, key, text); !ok) {
    Diagnostic d = ok.error();
    d.file = file;
    d.line = value.line;
    return fail(std::move(d));
  }
  one.sign = r.sign;
  one.given = r.given;
  one.from_shop[key] = file;
  r = std::move(one);
  return {};
}

}  // namespace

namespace {

/// Whether a file says that it is a shop's settings: a line begins with the key of their version.
bool says_it_is_a_shop(const fs::path& path) {
  const auto text = read_file(path.string(), tooling::kDataFileCap);
  if (!text) return true;  // why it cannot be read is to be told
  const std::string key(kVersionKey);
  return text->starts_with(key) || text->find("\n" + key) != std::string::npos;
}

}  // namespace

std::optional<std::string> found_shop() {
  std::vector<fs::path> places = {kShopFile};
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  if (config != nullptr && *config != '\0') {
    places.push_back(fs::path(config) / "capstan" / kShopFile);
  } else if (home != nullptr && *home != '\0') {
    places.push_back(fs::path(home) / ".config" / "capstan" / kShopFile);
  }
  std::error_code error;
  for (const fs::path& p : places) {
    if (fs::is_regular_file(p, error) && says_it_is_a_shop(p)) return p.string();
  }
  return std::nullopt;
}

Result<Request> with_shop(Request request, Job& job) {
  if (!request.shop || *request.shop == kNoShop) return request;
  auto text = read_file(*request.shop, tooling::kDataFileCap);
  if (!text) return tl::unexpected(text.error());
  return with_shop_text(std::move(request), *text, job);
}

Result<Request> with_shop_text(Request request, std::string_view text, Job& job) {
  const std::string file = request.shop.value_or(kShopFile);
  const auto root = root_of(text, file);
  if (!root) return tl::unexpected(root.error());
  std::vector<Diagnostic> faults;
  for (const auto& [key, value] : root->entries) {
    if (key == kVersionKey) continue;
    if (auto ok = take_entry(request, file, key, value, job); !ok) faults.push_back(ok.error());
  }
  if (auto wrong = tooling::tell(std::move(faults), job)) return fail(*std::move(wrong));
  if (std::string wrong = contradiction(request); !wrong.empty())
    return fail({.code = "OPTION-VALUE", .message = std::move(wrong), .file = file});
  return request;
}

Result<std::string> shop_template(const std::vector<std::string>& given) {
  std::map<std::string, std::string> values;
  for (const std::string& one : given) {
    const auto sign = one.find('=');
    if (sign == std::string::npos || sign == 0)
      return fail({.code = "OPTION-VALUE",
                   .message = "'" + one + "' is no entry with its value",
                   .expected = "NAME=VALUE, e.g. machine=mill.yaml"});
    values[one.substr(0, sign)] = one.substr(sign + 1);
  }
  std::string out =
      "# The shop's own settings. capstan takes this file from the working folder, else from\n"
      "# ~/.config/capstan, or as --shop names it. An option on the command line wins over its\n"
      "# entry here. Take the # off what is to hold; paths count from this file's folder.\n"
      "capstan_shop: 1\n";
  const auto entry = [&](std::string_view name, std::string_view help, std::string_view example) {
    const auto holds = values.find(std::string(name));
    out += "\n# " + std::string(help) + "\n";
    out += holds == values.end() ? "# " + std::string(name) + ": " + std::string(example) + "\n"
                                 : holds->first + ": " + yaml_text(holds->second) + "\n";
    if (holds != values.end()) values.erase(holds);
  };
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 16> kExamples = {{
      {"machine", "mill.yaml"},
      {"control", "linuxcnc"},
      {"tools", "tool.tbl"},
      {"material", "C45"},
      {"stock", "block:+2"},
      {"objective", "cost"},
      {"margin", "careful"},
      {"feeds", "constant"},
      {"rules", "rules"},
      {"cases", "cases.db"},
      {"cache", "cache"},
      {"solver", "nlopt"},
      {"workholding", "auto"},
      {"general-tolerance", "ISO 2768-m"},
      {"assume", "tool-material=carbide"},
      {"edges", "0.3"},
  }};
  for (const Option& o : options()) {
    if (!o.of_shop) continue;
    const auto at =
        std::find_if(kExamples.begin(), kExamples.end(), [&](const auto& e) { return e.first == o.name; });
    entry(o.name, o.help_of(Verb::kPlan), at == kExamples.end() ? "..." : at->second);
  }
  entry(kMaterials, "files of materials of the shop's own, which parts may name", "[bronze.yaml]");
  if (!values.empty())
    return fail(unknown_name("entry", values.begin()->first, known_entries(), "capstan shop init"));
  Job job;
  if (auto taken = with_shop_text({}, out, job); !taken) {
    Diagnostic d = taken.error();
    d.line = 0;
    return fail(std::move(d));
  }
  return out;
}

Result<std::string> shop_text(const Request& request, Job& job) {
  if (!request.shop || *request.shop == kNoShop)
    return std::string("no shop file: ") + kShopFile +
           " is neither in this folder nor in ~/.config/capstan\n";
  const auto bytes = read_file(*request.shop, tooling::kDataFileCap);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto root = root_of(*bytes, *request.shop);
  if (!root) return tl::unexpected(root.error());
  const auto taken = with_shop_text(request, *bytes, job);
  if (!taken) return tl::unexpected(taken.error());
  std::string out = *request.shop + "\n";
  for (const auto& [key, value] : root->entries) {
    if (key == kVersionKey) continue;
    std::string text = value.text;
    for (const Node& n : value.items) text += (text.empty() ? "" : ", ") + n.text;
    out += "  " + key + ": " + text + "\n";
  }
  return out;
}

}  // namespace capstan::service
