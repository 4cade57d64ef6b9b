#include "planner/files/exchange/conformance/check.h"

#include <algorithm>
#include <string>

#include "planner/files/exchange/common/embedded.h"
#include "planner/files/exchange/conformance/faults.h"
#include "planner/files/exchange/conformance/population.h"
#include "planner/files/exchange/conformance/rules.h"
#include "planner/files/exchange/conformance/values.h"
#include "planner/files/exchange/express/dictionary.h"

namespace capstan::exchange {

namespace {

std::string in_upper_case(std::string_view s) {
  std::string out(s);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return out;
}

}  // namespace

bool is_ap238_schema(std::string_view file_schema) {
  const std::string name = in_upper_case(file_schema.substr(0, file_schema.find_first_of(" {")));
  return name == "MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA" || name == "INTEGRATED_CNC_SCHEMA";
}

bool declares_ap238(std::string_view bytes) {
  constexpr std::size_t kHead = std::size_t{1} << 20;
  const std::string head = in_upper_case(bytes.substr(0, kHead));
  if (head.find("ISO-10303-21") == std::string::npos) return false;
  for (std::size_t at = head.find("FILE_SCHEMA"); at != std::string::npos;
       at = head.find("FILE_SCHEMA", at + 1)) {
    const std::string_view entity = std::string_view(head).substr(at, head.find(';', at) - at);
    for (std::size_t quote = entity.find('\''); quote != std::string_view::npos;
         quote = entity.find('\'', quote + 1)) {
      if (is_ap238_schema(entity.substr(quote + 1, entity.find('\'', quote + 1) - quote - 1))) return true;
    }
  }
  return false;
}

std::size_t check_schema(const p21::File& file, Job& job) {
  conformance::Faults faults(file, job);
  const auto schemas = file.schemas();
  if (std::none_of(schemas.begin(), schemas.end(), is_ap238_schema)) {
    faults.add({"SCH-SCHEMA",
                "the schema " + (schemas.empty() ? std::string("(none)") : schemas.front()) +
                    " is not one whose dictionary is known",
                {},
                "MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA or INTEGRATED_CNC_SCHEMA"});
    return faults.finish();
  }
  const conformance::Population population(file, express::Dictionary::ap238());
  conformance::check_values(population, faults);
  static const auto rules =
      conformance::read_rules(embedded_file("conformance/rules.table"), express::Dictionary::ap238());
  conformance::check_rules(population, rules, faults);
  return faults.finish();
}

}  // namespace capstan::exchange
