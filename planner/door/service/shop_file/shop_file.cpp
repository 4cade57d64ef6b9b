#include "planner/door/service/shop_file/shop_file.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "planner/door/service/edits/yaml_text.h"
#include "planner/door/service/options.h"
#include "planner/door/service/shop.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/model/plan/resources/shop_texts.h"
#include "tooling/shop/data/tree.h"
#include "tooling/shop/material/material.h"

namespace capstan::service {
namespace {

namespace fs = std::filesystem;
using tooling::Node;

constexpr std::string_view kVersionKey = "capstan_shop", kMaterials = "materials", kFixtures = "fixtures",
                           kTexts = "texts", kHolders = "holders";

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
  for (const std::string_view more : {kMaterials, kFixtures, kHolders, kTexts}) out.emplace_back(more);
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
  if (version == nullptr)
    return fail(fault(file, root->line,
                      "it does not say that it holds a shop's settings: the entry capstan_shop is missing"));
  if (version->text != "1")
    return fail(
        fault(file, version->line,
              "version '" + version->text + "' of a shop's settings is not known; this program reads 1"));
  return root;
}

Status take_files(std::vector<std::string>& into, const std::string& file, const std::string& key,
                  const Node& value) {
  if (value.kind != Node::Kind::kList)
    return fail(fault(file, value.line, key + " is not a list of files, e.g. [ours.yaml]"));
  for (const Node& n : value.items) {
    if (n.kind != Node::Kind::kScalar || n.text.empty())
      return fail(fault(file, n.line, "an entry of " + key + " is not the name of a file"));
    into.push_back(placed(file, key, n.text));
  }
  return {};
}

/// A title, and lines of comment in each program.
Status take_texts(Request& r, const std::string& file, const Node& value) {
  if (value.kind != Node::Kind::kMap)
    return fail(fault(file, value.line, "texts is not a map: {title: TEXT, header: [TEXT], footer: [TEXT]}"));
  const auto add = [&](std::string_view what, const Node& n) -> Status {
    if (n.kind != Node::Kind::kScalar || n.text.empty())
      return fail(fault(file, n.line, "a text of texts is empty, or is none"));
    const std::string wrong = what == model::kSheetTitle ? std::string() : model::comment_fault(n.text);
    if (!wrong.empty())
      return fail(fault(file, n.line, "'" + n.text + "' can be no comment of a program: " + wrong));
    r.texts.push_back({std::string(what), n.text, file + ": texts"});
    return {};
  };
  for (const auto& [key, own] : value.entries) {
    if (key == "title") {
      if (auto ok = add(model::kSheetTitle, own); !ok) return ok;
      continue;
    }
    if (key != "header" && key != "footer") {
      Diagnostic d = unknown_name("entry of texts", key, {"title", "header", "footer"}, "capstan shop init");
      d.file = file;
      d.line = own.line;
      return fail(std::move(d));
    }
    if (own.kind != Node::Kind::kList)
      return fail(fault(file, own.line, key + " of texts is not a list of lines, e.g. [\"ACME, CELL 3\"]"));
    for (const Node& n : own.items) {
      if (auto ok = add(key == "header" ? model::kProgramHeader : model::kProgramFooter, n); !ok) return ok;
    }
  }
  return {};
}

Status take_entry(Request& r, const std::string& file, const std::string& key, const Node& value, Job& job) {
  if (key == kMaterials) return take_files(r.materials, file, key, value);
  if (key == kFixtures) return take_files(r.fixtures, file, key, value);
  if (key == kTexts) return take_texts(r, file, value);
  if (key == kHolders) {
    std::vector<Diagnostic> faults;
    r.holders = tooling::read_holders(value, file, faults);
    if (auto wrong = tooling::tell(std::move(faults), job)) return fail(*std::move(wrong));
    return {};
  }
  const Option* o = find_option(key);
  if (o == nullptr || !o->of_shop) {
    Diagnostic d = unknown_name("entry", key, known_entries(), "capstan shop init");
    d.file = file;
    d.line = value.line;
    return fail(std::move(d));
  }
  if (value.kind != Node::Kind::kScalar)
    return fail(fault(file, value.line, key + " takes one value, not a list or a map"));
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

/// Whether a file is there that says that it is a shop's settings.
Result<bool> is_shop(const fs::path& path) {
  Diagnostic wrong = {.code = "SHOP-FILE",
                      .message = "the shop's settings cannot be looked at",
                      .file = path.string(),
                      .hint = "mend or rename the file, or leave the shop's settings out: --shop none"};
  std::error_code error;
  const fs::file_status there = fs::symlink_status(path, error);
  if (there.type() == fs::file_type::not_found || there.type() == fs::file_type::directory) return false;
  if (there.type() == fs::file_type::none) {
    // A folder that this user may not look into is another's: a service keeps the HOME of whom it was begun
    // by.
    if (error == std::errc::permission_denied) return false;
    wrong.message += ": " + error.message();
    return fail(std::move(wrong));
  }
  // A pipe or a device is no file of settings, nor is what a link leads to, but for a file.
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) return false;
  const auto text = read_file(path.string(), tooling::kDataFileCap);
  if (!text) {
    Diagnostic d = text.error();
    d.hint = wrong.hint;
    return fail(std::move(d));
  }
  const auto root = tooling::parse_tree(*text, path.string());
  if (!root) {
    Diagnostic d = root.error();
    d.hint = wrong.hint;
    return fail(std::move(d));
  }
  return root->kind == Node::Kind::kMap && root->find(kVersionKey) != nullptr;
}

}  // namespace

Result<std::optional<std::string>> found_shop() {
  std::vector<fs::path> places = {kShopFile};
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  if (config != nullptr && *config != '\0') {
    places.push_back(fs::path(config) / "capstan" / kShopFile);
  } else if (home != nullptr && *home != '\0') {
    places.push_back(fs::path(home) / ".config" / "capstan" / kShopFile);
  }
  for (const fs::path& p : places) {
    const auto shop = is_shop(p);
    if (!shop) return tl::unexpected(shop.error());
    if (*shop) return p.string();
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

namespace {

/// What no plan would take of a shop's settings; nothing: all of it can be read.
std::optional<Diagnostic> not_taken(Request request, Job& job) {
  request.cache.reset();  // a plan makes it where it is not
  Job reading;            // what is noted or warned of is told when it is used
  const auto shop = gather(request, model::Plan{}, reading);
  if (!shop) {
    for (Diagnostic& d : reading.take_diagnostics()) {
      if (d.severity == Severity::kError && !(d == shop.error())) job.report(std::move(d));
    }
    return shop.error();
  }
  if (!shop->material_name) return std::nullopt;
  const auto material =
      tooling::find_material({*shop->material_name}, shop->materials, reading, tooling::Families::kRefused);
  return material ? std::nullopt : std::optional(material.error());
}

}  // namespace

Result<std::string> shop_template(const std::vector<std::string>& given, const std::string& path, Job& job) {
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
  entry(kFixtures, "files of the shop's own fixtures (capstan_fixtures: 1), which workholding may name",
        "[vises.yaml]");
  entry(kHolders,
        "what tools stand in, mm from the face up to the gage line; a tool without a holder of its own gets\n"
        "# the first default that takes its shank, or the one that its list names",
        "{default: ER32, list: [{id: ER32, shank: 20, holder: [{height: 60, lower_diameter: 50, "
        "upper_diameter: 50}]}]}");
  entry(kTexts,
        "the title of reports and set-up sheets, and lines of comment at head and end of each program",
        "{title: \"ACME, cell 3\", header: [\"ACME, CELL 3\"], footer: [\"CLEAN THE VISE\"]}");
  if (!values.empty())
    return fail(unknown_name("entry", values.begin()->first, known_entries(), "capstan shop init"));
  Request asked;
  asked.shop = path;
  Job trial;
  const auto taken = with_shop_text(asked, out, trial);
  auto wrong = taken ? not_taken(*taken, trial) : std::optional(taken.error());
  if (!wrong) return out;
  const auto unwritten = [&](Diagnostic d) {
    if (d.file == path) d.line = 0;  // there is no such file
    return d;
  };
  for (Diagnostic& d : trial.take_diagnostics()) job.report(unwritten(std::move(d)));
  return fail(unwritten(*std::move(wrong)));
}

namespace {

/// An entry's values with commas between; of a map with their names.
std::string in_words(const Node& value) {
  std::string out = value.text;
  for (const Node& n : value.items) out += (out.empty() ? "" : ", ") + in_words(n);
  for (const auto& [key, own] : value.entries) out += (out.empty() ? "" : "; ") + key + " " + in_words(own);
  return out;
}

}  // namespace

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
    out += "  " + key + ": " + in_words(value) + "\n";
  }
  return out;
}

}  // namespace capstan::service
