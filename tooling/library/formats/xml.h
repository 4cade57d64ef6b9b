#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::tooling {

inline constexpr std::size_t kXmlDepthCap = 64;
inline constexpr std::size_t kXmlNodesCap = 5'000'000;

/// An element. Entities of a document type are not expanded, nothing is fetched.
struct XmlNode {
  std::string name, text;  ///< `text`: all text within, blanks at the ends removed
  std::uint64_t line = 0;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlNode> children;

  [[nodiscard]] const XmlNode* find(std::string_view child) const;  ///< first of that name, or null
  [[nodiscard]] std::string text_of(std::string_view child) const;  ///< its text, empty when absent
  [[nodiscard]] std::string attribute(std::string_view name) const;
};

/// The root element; names without their namespace prefix.
/// Fails  XML-SYNTAX, XML-DEPTH, FILE-TOO-LARGE, with file and line.
[[nodiscard]] Result<XmlNode> parse_xml(std::string_view bytes, const std::string& file);

}  // namespace capstan::tooling
