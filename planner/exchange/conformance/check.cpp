#include "planner/exchange/conformance/check.h"

#include <algorithm>
#include <string>

#include "planner/exchange/conformance/faults.h"
#include "planner/exchange/conformance/population.h"
#include "planner/exchange/conformance/rules.h"
#include "planner/exchange/conformance/values.h"
#include "planner/exchange/embedded.h"
#include "planner/exchange/express/dictionary.h"

namespace capstan::exchange {

bool is_ap238_schema(std::string_view file_schema) {
  const std::string_view name = file_schema.substr(0, file_schema.find_first_of(" {"));
  std::string upper(name);
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return upper == "MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA" || upper == "INTEGRATED_CNC_SCHEMA";
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
