#include "planner/model/plan/ranges.h"

#include "planner/ground/base/number.h"

namespace capstan::model {

std::string to_text(const Range& range) {
  return (range.or_zero ? "0, or " : "") + shortest(range.least) + " to " + shortest(range.most);
}

}  // namespace capstan::model
