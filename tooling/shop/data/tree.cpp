#include "tooling/shop/data/tree.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <unordered_set>

#include "planner/ground/base/foreign/foreign_file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/no_number.h"
#include "planner/ground/base/number.h"

namespace capstan::tooling {
namespace {

struct Refused {
  std::string code, message;
  std::uint64_t line;
};

std::uint64_t line_of(const YAML::Mark& m) { return m.line < 0 ? 0 : static_cast<std::uint64_t>(m.line) + 1; }

/// Builds the tree from events: a stack of open containers, no recursion of our own.
class Builder final : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& m, YAML::anchor_t) override { value({.line = line_of(m)}); }
  void OnAlias(const YAML::Mark& m, YAML::anchor_t) override {
    throw Refused{"DATA-SYNTAX", "aliases (*) are not read; write the values out", line_of(m)};
  }
  void OnScalar(const YAML::Mark& m, const std::string&, YAML::anchor_t, const std::string& v) override {
    if (!open_.empty() && open_.back().kind == Node::Kind::kMap && !keys_.back()) {
      key(v, line_of(m));
      return;
    }
    value({.kind = Node::Kind::kScalar, .text = v, .line = line_of(m)});
  }
  void OnSequenceStart(const YAML::Mark& m, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    start(Node::Kind::kList, line_of(m));
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& m, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    start(Node::Kind::kMap, line_of(m));
  }
  void OnMapEnd() override { end(); }

  Node root;

 private:
  void key(const std::string& name, std::uint64_t line) {
    if (!names_.back().insert(name).second)
      throw Refused{"DATA-DUPLICATE", "'" + name + "' is given twice", line};
    open_.back().entries.emplace_back(name, Node{});
    keys_.back() = true;
  }
  void start(Node::Kind kind, std::uint64_t line) {
    if (open_.size() >= static_cast<std::size_t>(kDataDepthCap))
      throw Refused{"DATA-SYNTAX", "nested deeper than " + std::to_string(kDataDepthCap), line};
    check_key(line);
    open_.push_back({.kind = kind, .line = line});
    keys_.push_back(false);
    names_.emplace_back();
  }
  void end() {
    Node done = std::move(open_.back());
    open_.pop_back();
    keys_.pop_back();
    names_.pop_back();
    value(std::move(done));
  }
  void check_key(std::uint64_t line) const {
    if (!open_.empty() && open_.back().kind == Node::Kind::kMap && !keys_.back())
      throw Refused{"DATA-SYNTAX", "a key must be a word", line};
  }
  void value(Node n) {
    if (open_.empty()) {
      root = std::move(n);
      return;
    }
    check_key(n.line);
    Node& top = open_.back();
    if (top.kind == Node::Kind::kMap) {
      top.entries.back().second = std::move(n);
      keys_.back() = false;
    } else {
      top.items.push_back(std::move(n));
    }
  }

  std::vector<Node> open_;
  std::vector<bool> keys_;                              // whether a map's key waits for its value
  std::vector<std::unordered_set<std::string>> names_;  // of its keys
};

enum class Documents : std::uint8_t { kFirst, kAll };

Result<std::vector<Node>> read(std::string_view text, const std::string& file, Documents which) {
  if (text.size() > kDataFileCap) {
    return fail({.code = "FILE-TOO-LARGE",
                 .message = "more than " + std::to_string(kDataFileCap) + " bytes",
                 .file = file});
  }
  std::vector<Node> out;
  try {
    std::istringstream in{std::string(text)};
    YAML::Parser parser(in);
    for (;;) {
      Builder builder;
      if (!parser.HandleNextDocument(builder)) return out;
      out.push_back(std::move(builder.root));
      if (which == Documents::kFirst) return out;
    }
  } catch (const Refused& r) {
    return fail({.code = r.code, .message = r.message, .file = file, .line = r.line});
  } catch (const YAML::Exception& e) {
    return fail({.code = "DATA-SYNTAX", .message = e.msg, .file = file, .line = line_of(e.mark)});
  }
}

/// The keys that `name` may be meant for; where none is near, those there are, if they are few.
std::string like(std::string_view name, const std::vector<std::string>& known) {
  constexpr std::size_t kFew = 8;
  std::vector<std::string> keys = nearest_names(name, known);
  if (keys.empty() && known.size() <= kFew) keys = known;
  std::string out;
  for (const std::string& k : keys) out += (out.empty() ? "'" : ", '") + k + "'";
  return out;
}

}  // namespace

Result<Node> parse_tree(std::string_view text, const std::string& file) {
  if (const auto foreign = foreign_file(text))
    return fail({.code = "DATA-FOREIGN",
                 .message = "this is " + std::string(foreign->what) + ", not the data that were named",
                 .file = file,
                 .expected = "a text in YAML or JSON",
                 .hint = "was another file meant?"});
  auto documents = read(text, file, Documents::kFirst);
  if (!documents) return fail(documents.error());
  return documents->empty() ? Node{} : std::move(documents->front());
}

Result<std::vector<Node>> parse_documents(std::string_view text, const std::string& file) {
  return read(text, file, Documents::kAll);
}

Fields::Fields(const Node& node, std::string file, std::string path, std::string source,
               std::vector<Diagnostic>& faults)
    : node_(node),
      file_(std::move(file)),
      path_(std::move(path)),
      source_(std::move(source)),
      faults_(faults) {
  asked_.emplace_back("source");
  if (node_.kind != Node::Kind::kMap) fault("DATA-KIND", "named values were expected", "", node_.line);
  if (const Node* s = node_.find("source"); s != nullptr && s->kind == Node::Kind::kScalar) source_ = s->text;
}

std::string Fields::path_of(std::string_view key) const {
  if (key.empty()) return path_;
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

std::uint64_t Fields::line_of(std::string_view key) const {
  const Node* n = node_.find(key);
  return n == nullptr ? node_.line : n->line;
}

void Fields::fault(std::string code, std::string message, std::string_view key, std::uint64_t line,
                   std::string expected) {
  faults_.push_back({.code = std::move(code),
                     .message = std::move(message),
                     .file = file_,
                     .line = line,
                     .path = path_of(key),
                     .expected = std::move(expected)});
}

const Node* Fields::child(std::string_view key, bool required) {
  asked_.emplace_back(key);
  const Node* n = node_.find(key);
  if (n == nullptr && required)
    fault("DATA-MISSING", "'" + std::string(key) + "' is missing", key, node_.line);
  return n;
}

Fields Fields::below(std::string_view key, const Node& child) {
  return {child, file_, path_of(key), source_, faults_};
}

const Node* Fields::scalar(std::string_view key, bool required) {
  const Node* n = child(key, required);
  if (n == nullptr) return nullptr;
  std::string source = source_;
  if (n->kind == Node::Kind::kMap) {
    for (const auto& [name, entry] : n->entries) {
      if (name != "value" && name != "source")
        fault("DATA-UNKNOWN", "'" + name + "' is not known here", key, entry.line, "value, source");
    }
    if (const Node* s = n->find("source")) source = s->text;
    n = n->find("value");
  }
  if (n == nullptr || n->kind != Node::Kind::kScalar) {
    fault("DATA-KIND", "a single value was expected", key, n == nullptr ? node_.line : n->line);
    return nullptr;
  }
  sources_.emplace_back(path_of(key), source);
  return n;
}

std::optional<double> Fields::optional_number(std::string_view key) {
  if (!has(key)) {
    asked_.emplace_back(key);
    return std::nullopt;
  }
  const Node* n = scalar(key, true);
  if (n == nullptr) return std::nullopt;
  const auto v = parse_double(n->text);
  if (!v) fault("DATA-NUMBER", no_number(n->text), key, n->line, "a finite decimal number");
  return v;
}

double Fields::number(std::string_view key) {
  if (!has(key)) {
    (void)child(key, true);
    return 0.0;
  }
  return optional_number(key).value_or(0.0);
}

double Fields::number_or(std::string_view key, double other) { return optional_number(key).value_or(other); }

std::optional<long> Fields::optional_integer(std::string_view key) {
  const auto v = optional_number(key);
  if (!v) return std::nullopt;
  if (*v != std::floor(*v) || std::abs(*v) > 1e9) {
    fault("DATA-NUMBER", trimmed(*v, 6) + " is not a whole number", key, line_of(key));
    return std::nullopt;
  }
  return static_cast<long>(*v);
}

std::string Fields::text(std::string_view key) {
  const Node* n = scalar(key, true);
  return n == nullptr ? std::string() : n->text;
}

std::string Fields::text_or(std::string_view key, std::string other) {
  if (!has(key)) {
    asked_.emplace_back(key);
    return other;
  }
  return text(key);
}

bool Fields::flag_or(std::string_view key, bool other) {
  const std::string t = text_or(key, other ? "true" : "false");
  if (t == "true" || t == "yes") return true;
  if (t != "false" && t != "no")
    fault("DATA-KIND", "'" + t + "' is neither true nor false", key, line_of(key));
  return false;
}

void Fields::finish() {
  for (const auto& [name, child] : node_.entries) {
    if (std::find(asked_.begin(), asked_.end(), name) == asked_.end())
      fault("DATA-UNKNOWN", "'" + name + "' is no key here", name, child.line, like(name, asked_));
  }
}

std::optional<Diagnostic> tell(std::vector<Diagnostic> faults, Job& job) {
  if (faults.empty()) return std::nullopt;
  Diagnostic last = std::move(faults.back());
  faults.pop_back();
  for (Diagnostic& d : faults) job.report(std::move(d));
  return last;
}

}  // namespace capstan::tooling
