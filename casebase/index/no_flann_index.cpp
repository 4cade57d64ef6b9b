#include "casebase/index/index.h"

namespace capstan::casebase {

std::unique_ptr<Index> make_index(Points points) { return make_tree_index(std::move(points)); }
bool built_with_flann() { return false; }

}  // namespace capstan::casebase
