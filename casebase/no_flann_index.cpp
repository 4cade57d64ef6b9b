#include "casebase/index.h"

namespace capstan::casebase {

std::unique_ptr<Index> make_index(std::vector<Point> points) { return make_tree_index(std::move(points)); }
std::string_view index_name() { return "tree"; }

}  // namespace capstan::casebase
