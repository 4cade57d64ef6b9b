// One page: the template of page/page.html with the verdict, style, data and scripts put in their places.
#include <array>
#include <span>
#include <string_view>

#include "planner/door/report/data.h"
#include "planner/door/report/report.h"
#include "planner/ground/base/text.h"
#include "planner/model/plan/resources/shop_texts.h"

namespace capstan::report {

std::string_view embedded_file(std::string_view name);
std::span<const std::string_view> embedded_names();

namespace {

constexpr std::array<std::string_view, 9> kScripts = {
    "base.js", "path.js", "stock.js", "flat.js", "view.js", "charts.js", "tables.js", "sheets.js", "main.js"};

/// The file whose name ends so; empty when it was not there to compile in.
std::string_view ending(std::string_view end) {
  for (const std::string_view name : embedded_names())
    if (name.ends_with(end)) return embedded_file(name);
  return {};
}

std::string_view class_of(Judged j) {
  return j == Judged::kSafe ? "safe" : j == Judged::kNotSafe ? "unsafe" : "unchecked";
}

std::string library() {
  return std::string(ending("three.min.js")) + "\n" + std::string(ending("OrbitControls.js"));
}

std::string scripts() {
  std::string out;
  for (const std::string_view name : kScripts) out += std::string(embedded_file(name)) + "\n";
  return out;
}

/// `{{name}}` of the template.
std::string part(std::string_view name, const model::Plan& plan, const About& about) {
  if (name == "title") {
    const auto own = model::shop_texts(plan, model::kSheetTitle);
    return xml_escaped(own.empty() ? plan.file_name : own.front() + ": " + plan.file_name);
  }
  if (name == "judged") return std::string(class_of(about.judged));
  if (name == "verdict") return xml_escaped(about.verdict);
  if (name == "style") return std::string(embedded_file("style.css"));
  if (name == "data") return data_of(plan, about);
  if (name == "library") return draws_in_three_dimensions() ? library() : std::string();
  return scripts();
}

}  // namespace

bool draws_in_three_dimensions() {
  return !ending("three.min.js").empty() && !ending("OrbitControls.js").empty();
}

std::string html(const model::Plan& plan, const About& about) {
  std::string_view page = embedded_file("page.html");
  std::string out;
  while (true) {
    const std::size_t open = page.find("{{");
    out += page.substr(0, open);
    if (open == std::string_view::npos) return out;
    const std::size_t close = page.find("}}", open);
    out += part(page.substr(open + 2, close - open - 2), plan, about);
    page.remove_prefix(close + 2);
  }
}

}  // namespace capstan::report
