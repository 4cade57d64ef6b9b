#include "tooling/shop/data/data.h"

#include <cstdlib>
#include <optional>

#include "planner/ground/base/file.h"

namespace capstan::tooling {
namespace {

std::optional<std::string> in_data_folder(std::string_view name) {
  const char* folder = std::getenv("CAPSTAN_DATA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  auto text = read_file(std::string(folder) + "/tooling/data/" + std::string(name), kDataFileCap);
  if (!text) return std::nullopt;
  return std::move(*text);
}

}  // namespace

std::string shipped_text(std::string_view name) {
  if (auto text = in_data_folder(name)) return std::move(*text);
  return std::string(embedded_file(name));
}

Result<Node> shipped_tree(std::string_view name) {
  if (const auto text = in_data_folder(name)) return parse_tree(*text, std::string(name));
  const std::string_view packed = embedded_tree(name);
  if (packed.empty()) return Node{};
  std::vector<Node> documents = unpack(packed);
  return documents.empty() ? Node{} : std::move(documents.front());
}

}  // namespace capstan::tooling
