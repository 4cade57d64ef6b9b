#include "planner/files/exchange/common/ratio.h"

namespace capstan::exchange {
namespace {

constexpr double kSurelyPercent = 10.0;  // default, unsourced: below, a length in mm may be meant
bool may_exceed_one(std::string_view attribute) { return attribute == "feed_on_retract"; }

}  // namespace

bool beyond_ratio(std::string_view attribute, double value) {
  return value > (may_exceed_one(attribute) ? kSurelyPercent : 1.0);
}

bool is_percent(std::string_view attribute, double value) {
  return value <= (may_exceed_one(attribute) ? 1000.0 : 100.0) &&
         (value >= kSurelyPercent || attribute != "overlap");
}

}  // namespace capstan::exchange
