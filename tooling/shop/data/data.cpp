#include "tooling/shop/data/data.h"

#include <cstdlib>

#include "planner/ground/base/file.h"
#include "tooling/shop/data/tree.h"

namespace capstan::tooling {

std::string shipped_text(std::string_view name) {
  if (const char* folder = std::getenv("CAPSTAN_DATA"); folder != nullptr && *folder != '\0') {
    if (auto text = read_file(std::string(folder) + "/tooling/data/" + std::string(name), kDataFileCap))
      return std::move(*text);
  }
  return std::string(embedded_file(name));
}

}  // namespace capstan::tooling
