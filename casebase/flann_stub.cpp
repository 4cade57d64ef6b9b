#include "casebase/index.h"

namespace capstan::casebase {

std::unique_ptr<Index> make_index(std::vector<Point> points) { return make_linear_index(std::move(points)); }
std::string_view index_name() { return "linear"; }

}  // namespace capstan::casebase
