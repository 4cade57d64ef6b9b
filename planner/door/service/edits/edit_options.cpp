#include "planner/door/service/edits/edit_options.h"

#include <string>

#include "planner/model/plan/edit/edit.h"

namespace capstan::service {
namespace {

template <model::EditKind kKind>
std::string add_edit(Request& r, const std::string& text) {
  auto e = model::parse_edit(kKind, text, r.sign + std::string(to_text(kKind)));
  if (!e) return e.error().message + (e.error().expected.empty() ? "" : "; expected " + e.error().expected);
  r.edits.push_back(*std::move(e));
  return {};
}

template <model::EditKind kKind>
Option row(const char* help) {
  return {.name = to_text(kKind),
          .value = Value::kText,
          .help = {help, help, nullptr},
          .set = &add_edit<kKind>,
          .repeatable = true};
}

}  // namespace

std::vector<Option> edit_options() {
  using model::EditKind;
  constexpr const char* kFile =
      "a file of edits (-o NAME.edits.yaml writes one); those given here are added to its own";
  return {
      {.name = "edits",
       .value = Value::kText,
       .help = {kFile, kFile, nullptr},
       .set = [](Request& r, const std::string& t) { return r.edits_file = t, std::string(); }},
      row<EditKind::kSet>("set a value of some steps and plan anew what depends on it: 'POCKET*/tool=T5', "
                          "'SLOT*/feed=900', 'HOLE*/cycles=explicit'; tool, feed, speed, depth or cycles; "
                          "the part before / names features or "
                          "workingsteps, with * and ?"),
      row<EditKind::kPin>("hold a value as it is planned: 'POCKET*/tool'"),
      row<EditKind::kLimit>("bound a number: 'feed<=2000', 'POCKET*/tool.diameter<=8'; feed, speed, "
                            "tool.diameter, tool.stick_out or tool.teeth"),
      row<EditKind::kForbid>("rule out a tool, a kind of operation or a strategy: 'tool=em12*', "
                             "'HOLE*/operation=reaming'"),
      row<EditKind::kOrder>("one before another: 'HOLE*<POCKET*'"),
  };
}

}  // namespace capstan::service
