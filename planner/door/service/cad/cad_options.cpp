#include "planner/door/service/cad/cad_options.h"

#include <string>

namespace capstan::service {
namespace {

std::string add_thread(Request& r, const std::string& text) {
  auto t = from_cad::parse_thread(text);
  if (!t) return t.error().message + "; expected " + t.error().expected;
  r.tapped.push_back(*std::move(t));
  return {};
}

}  // namespace

std::vector<Option> cad_options() {
  return {
      {.name = "body",
       .value = Value::kText,
       .help = {"body of a CAD file that is the part: its number or name (capstan inspect)"},
       .set = [](Request& r, const std::string& t) { return r.body = t, std::string(); }},
      {.name = "tapped",
       .value = Value::kText,
       .help = {"threads of a CAD file's holes, which it draws plain: 'HOLE 3=M8:16', 'HOLE*=M10x1', "
                "'#120=M6-6H-LH:12'; names with * and ? or a face of the hole, the size, the depth of full "
                "thread"},
       .set = &add_thread,
       .repeatable = true},
      {.name = "features-only",
       .value = Value::kFlag,
       .help = {"of a CAD file write the features with their tolerances, and plan nothing"},
       .set = [](Request& r, const std::string& t) { return r.features_only = t == "yes", std::string(); }},
  };
}

}  // namespace capstan::service
