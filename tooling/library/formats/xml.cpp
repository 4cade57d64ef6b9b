#include "tooling/library/formats/xml.h"

#include <algorithm>
#include <pugixml.hpp>

#include "tooling/library/formats/byte_cap.h"
#include "tooling/library/formats/values.h"

// The one file that knows pugixml.

namespace capstan::tooling {
namespace {

std::string_view local(std::string_view name) {
  const auto colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// Lines of ascending offsets.
class Lines {
 public:
  explicit Lines(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t at(std::ptrdiff_t offset) {
    if (offset < 0) return 0;
    const auto end = std::min(static_cast<std::size_t>(offset), bytes_.size());
    if (end < at_) {
      at_ = 0;
      line_ = 1;
    }
    line_ += static_cast<std::uint64_t>(std::count(bytes_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                   bytes_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at_ = end;
    return line_;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
};

XmlNode shallow(const pugi::xml_node& n, Lines& lines) {
  XmlNode out;
  out.name = local(n.name());
  out.line = lines.at(n.offset_debug());
  for (const auto& a : n.attributes()) out.attributes.emplace_back(local(a.name()), a.value());
  for (const auto& c : n.children())
    if (c.type() == pugi::node_pcdata || c.type() == pugi::node_cdata) out.text += c.value();
  out.text = trimmed_text(out.text);
  return out;
}

}  // namespace

const XmlNode* XmlNode::find(std::string_view child) const {
  for (const XmlNode& c : children)
    if (c.name == child) return &c;
  return nullptr;
}

std::string XmlNode::text_of(std::string_view child) const {
  const XmlNode* c = find(child);
  return c == nullptr ? std::string() : c->text;
}

std::string XmlNode::attribute(std::string_view wanted) const {
  for (const auto& [key, value] : attributes)
    if (key == wanted) return value;
  return {};
}

Result<XmlNode> parse_xml(std::string_view bytes, const std::string& file) {
  if (bytes.size() > kLibraryBytesCap)
    return fail({.code = "FILE-TOO-LARGE",
                 .message = "more than " + std::to_string(kLibraryBytesCap) + " bytes",
                 .file = file});
  Lines lines(bytes);
  pugi::xml_document doc;
  const auto parsed = doc.load_buffer(bytes.data(), bytes.size(), pugi::parse_default, pugi::encoding_auto);
  if (!parsed)
    return fail({.code = "XML-SYNTAX",
                 .message = parsed.description(),
                 .file = file,
                 .line = lines.at(parsed.offset),
                 .expected = "a whole XML document",
                 .hint = "export it again"});
  const pugi::xml_node root = doc.document_element();
  if (!root) return fail({.code = "XML-SYNTAX", .message = "there is no element", .file = file});
  struct Level {
    pugi::xml_node next;
    XmlNode node;
  };
  std::vector<Level> open;
  const auto first = [](const pugi::xml_node& n) {
    pugi::xml_node c = n.first_child();
    while (c && c.type() != pugi::node_element) c = c.next_sibling();
    return c;
  };
  open.push_back({first(root), shallow(root, lines)});
  std::size_t nodes = 1;
  while (true) {
    Level& top = open.back();
    if (!top.next) {
      XmlNode done = std::move(top.node);
      open.pop_back();
      if (open.empty()) return done;
      open.back().node.children.push_back(std::move(done));
      continue;
    }
    const pugi::xml_node n = top.next;
    do {
      top.next = top.next.next_sibling();
    } while (top.next && top.next.type() != pugi::node_element);
    if (open.size() >= kXmlDepthCap || ++nodes > kXmlNodesCap)
      return fail({.code = open.size() >= kXmlDepthCap ? "XML-DEPTH" : "FILE-TOO-LARGE",
                   .message = open.size() >= kXmlDepthCap
                                  ? "nested deeper than " + std::to_string(kXmlDepthCap)
                                  : "more than " + std::to_string(kXmlNodesCap) + " elements",
                   .file = file,
                   .line = lines.at(n.offset_debug()),
                   .expected = "a tool library"});
    open.push_back({first(n), shallow(n, lines)});
  }
}

}  // namespace capstan::tooling
