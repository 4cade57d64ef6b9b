#include <nlohmann/json.hpp>

#include "planner/door/app/command/session.h"

namespace capstan::app {
namespace {

using Tree = nlohmann::ordered_json;

// Text of files need not be UTF-8: what is not becomes U+FFFD.
std::string dump(const Tree& t, int indent) {
  return t.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::string diagnostic_json(const Diagnostic& d) {
  Tree t;
  t["severity"] = to_text(d.severity);
  t["code"] = d.code;
  if (!d.file.empty()) t["file"] = d.file;
  if (d.line != 0) t["line"] = d.line;
  if (d.instance != 0) t["instance"] = d.instance;
  if (!d.path.empty()) t["path"] = d.path;
  t["message"] = d.message;
  if (!d.expected.empty()) t["expected"] = d.expected;
  if (!d.hint.empty()) t["hint"] = d.hint;
  return dump(t, -1);
}

std::string findings_json(const std::vector<FileFinding>& findings) {
  Tree list = Tree::array();
  for (const FileFinding& one : findings) {
    const model::Finding& f = one.finding;
    Tree t;
    t["file"] = one.file;
    t["property"] = f.property;
    t["code"] = f.code;
    t["severity"] = to_text(f.severity);
    if (!f.step.empty()) t["step"] = f.step;
    if (f.move >= 0) t[one.program ? "line" : "move"] = f.move;
    t["message"] = f.message;
    list.push_back(std::move(t));
  }
  Tree out;
  out["findings"] = std::move(list);
  return dump(out, 2) + "\n";
}

}  // namespace capstan::app
