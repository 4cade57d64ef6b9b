#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace capstan::step {

/// Collects why each of several cutters does not fit, and states a reason that many share once:
/// "em10: it is too short, the same for 7 more cutters; em20: ...".
class GroupedReasons {
 public:
  void add(const std::string& cutter, const std::string& why);
  [[nodiscard]] std::string text() const;

 private:
  struct Group {
    std::string first, why;
    std::size_t more = 0;
  };
  std::vector<Group> groups_;
};

}  // namespace capstan::step
