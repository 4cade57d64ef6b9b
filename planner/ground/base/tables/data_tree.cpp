// Packed form: a count of documents, then each node as its kind (one byte), its line, and
//
//   scalar   length, bytes
//   list     count, nodes
//   map      count, then for each entry: length and bytes of the key, node
//
// Numbers are unsigned, seven bits a byte, the lowest first; the eighth bit says that more follow.

#include "planner/ground/base/tables/data_tree.h"

#include <stdexcept>

namespace capstan {
namespace {

constexpr unsigned kSevenBits = 0x7f, kMore = 0x80;

void put(std::uint64_t n, std::string& out) {
  for (; n > kSevenBits; n >>= 7) out += static_cast<char>((n & kSevenBits) | kMore);
  out += static_cast<char>(n);
}

void put(std::string_view text, std::string& out) {
  put(text.size(), out);
  out += text;
}

void put(const DataNode& node, std::string& out) {
  out += static_cast<char>(node.kind);
  put(node.line, out);
  switch (node.kind) {
    case DataNode::Kind::kNull:
      return;
    case DataNode::Kind::kScalar:
      put(node.text, out);
      return;
    case DataNode::Kind::kList:
      put(node.items.size(), out);
      for (const DataNode& item : node.items) put(item, out);
      return;
    case DataNode::Kind::kMap:
      put(node.entries.size(), out);
      for (const auto& [key, value] : node.entries) {
        put(key, out);
        put(value, out);
      }
      return;
  }
}

class Packed {
 public:
  explicit Packed(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t number() {
    std::uint64_t n = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes(1).front());
      n |= std::uint64_t{byte & kSevenBits} << shift;
      if ((byte & kMore) == 0) return n;
    }
  }
  std::string_view text() { return bytes(number()); }

  void node(DataNode& out) {
    out.kind = static_cast<DataNode::Kind>(bytes(1).front());
    out.line = number();
    if (out.kind == DataNode::Kind::kScalar) {
      out.text = text();
    } else if (out.kind == DataNode::Kind::kList) {
      out.items.resize(number());
      for (DataNode& item : out.items) node(item);
    } else if (out.kind == DataNode::Kind::kMap) {
      out.entries.resize(number());
      for (auto& [key, value] : out.entries) {
        key = text();
        node(value);
      }
    }
  }

 private:
  std::string_view bytes(std::size_t count) {
    if (count > bytes_.size() - at_) throw std::logic_error("a packed data file ends early");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace

const DataNode* DataNode::find(std::string_view key) const {
  for (const auto& [name, node] : entries)
    if (name == key) return &node;
  return nullptr;
}

std::string pack(const std::vector<DataNode>& documents) {
  std::string out;
  put(documents.size(), out);
  for (const DataNode& d : documents) put(d, out);
  return out;
}

std::vector<DataNode> unpack(std::string_view packed) {
  Packed in(packed);
  std::vector<DataNode> out(in.number());
  for (DataNode& d : out) in.node(d);
  return out;
}

}  // namespace capstan
