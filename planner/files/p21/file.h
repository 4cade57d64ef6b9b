#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::p21 {

/// What a parameter is, as its spelling says; no schema is consulted.
enum class Kind : std::uint8_t {
  kOmitted,      ///< $
  kDerived,      ///< *
  kInteger,      ///< 12
  kReal,         ///< 1.5E-3
  kString,       ///< 'text'
  kEnumeration,  ///< .METRE.
  kBinary,       ///< "0FA"
  kReference,    ///< #12
  kList,         ///< (a, b)
  kTyped,        ///< LENGTH_MEASURE(1.5)
};

[[nodiscard]] const char* to_text(Kind kind);

namespace detail {

/// One parameter in eight bytes: where it stands (offset into the text, or first child in the arena)
/// in bits 0-31, its length or number of children in bits 32-59, its tag in bits 60-63.
using Node = std::uint64_t;

/// What a Value needs of its File: the text and the nodes.
struct Arena {
  const char* text = nullptr;
  const Node* nodes = nullptr;
};
struct Store;

/// What a node is: the kinds in their order, then two that only the store tells apart.
enum class Tag : std::uint8_t {
  kOmitted,
  kDerived,
  kInteger,
  kReal,
  kString,  ///< needs no decoding
  kEnumeration,
  kBinary,
  kReference,
  kList,           ///< children are contiguous from `start`
  kTyped,          ///< two nodes at `start`: the keyword and the parameter
  kEscapedString,  ///< holds '', an escape or a byte outside printable ASCII
  kKeyword,
};

inline constexpr std::uint64_t kMaxLength = (std::uint64_t{1} << 28) - 1;

[[nodiscard]] constexpr Node make_node(Tag tag, std::uint64_t start, std::uint64_t length) {
  return start | length << 32 | static_cast<std::uint64_t>(tag) << 60;
}
[[nodiscard]] constexpr Tag tag_of(Node n) { return static_cast<Tag>(n >> 60); }
[[nodiscard]] constexpr std::size_t start_of(Node n) { return n & 0xFFFFFFFFU; }
[[nodiscard]] constexpr std::size_t length_of(Node n) { return n >> 32 & kMaxLength; }

}  // namespace detail

/// A read-only cursor to one parameter; cheap to copy, valid while its File lives (moving the File is
/// fine). Asking a value for what its kind does not have throws std::logic_error: ask kind() first.
class Value {
 public:
  Value() = default;  ///< an omitted parameter
  Value(const detail::Arena* arena, detail::Node node) : arena_(arena), node_(node) {}

  [[nodiscard]] Kind kind() const {
    const detail::Tag tag = detail::tag_of(node_);
    return tag == detail::Tag::kEscapedString ? Kind::kString : static_cast<Kind>(tag);
  }
  [[nodiscard]] bool is(Kind k) const { return kind() == k; }
  [[nodiscard]] bool is_number() const { return is(Kind::kInteger) || is(Kind::kReal); }

  /// kInteger only; the parser has verified that it fits.
  [[nodiscard]] std::int64_t as_integer() const;
  /// kReal or kInteger; finite, correctly rounded.
  [[nodiscard]] double as_real() const;
  /// As written in the file: numbers, references with #, binaries, strings and enumerations without
  /// their delimiters; empty for lists and typed parameters.
  [[nodiscard]] std::string_view lexeme() const;
  /// kString: decoded to UTF-8.
  [[nodiscard]] std::string as_text() const;
  /// As as_text without an allocation where none is needed: a view into the file or into `buffer`.
  [[nodiscard]] std::string_view as_text(std::string& buffer) const;
  /// kEnumeration: its name without dots, upper case.
  [[nodiscard]] std::string_view enumeration() const;
  /// kReference: the instance number.
  [[nodiscard]] std::uint64_t reference() const;
  /// kList: the number of elements. kTyped: 1. Others: 0.
  [[nodiscard]] std::size_t size() const {
    const detail::Tag tag = detail::tag_of(node_);
    return tag == detail::Tag::kList ? detail::length_of(node_) : tag == detail::Tag::kTyped ? 1 : 0;
  }
  [[nodiscard]] bool empty() const { return size() == 0; }
  /// kList or kTyped: the i-th element, in constant time. Throws std::out_of_range.
  [[nodiscard]] Value operator[](std::size_t i) const {
    if (i >= size()) no_element(i);
    const std::size_t skipped = detail::tag_of(node_) == detail::Tag::kTyped ? 1 : 0;
    return {arena_, arena_->nodes[detail::start_of(node_) + skipped + i]};
  }
  /// kTyped: the keyword, upper case, with its leading ! where user-defined.
  [[nodiscard]] std::string_view keyword() const;

 private:
  [[noreturn]] static void no_element(std::size_t i);
  [[nodiscard]] std::string_view view() const {
    return {arena_->text + detail::start_of(node_), detail::length_of(node_)};
  }

  const detail::Arena* arena_ = nullptr;
  detail::Node node_ = 0;
};

/// KEYWORD(parameters): a simple instance, or one part of a complex one.
struct Record {
  std::string_view keyword;  ///< upper case, with its leading ! where user-defined
  Value parameters;          ///< a kList
};

/// One instance of a data section, or one entity of the header (id 0).
class Instance {
 public:
  Instance(const detail::Store* store, std::uint32_t index, bool in_header)
      : store_(store), index_(index), in_header_(in_header) {}

  [[nodiscard]] std::uint64_t id() const;
  [[nodiscard]] std::uint64_t line() const;  ///< 1-based, where the instance begins
  [[nodiscard]] bool is_complex() const;     ///< #1=(A()B())
  [[nodiscard]] std::size_t part_count() const;
  [[nodiscard]] Record part(std::size_t i) const;  ///< throws std::out_of_range
  /// Of a simple instance; empty for a complex one.
  [[nodiscard]] std::string_view keyword() const;
  /// Of a simple instance, a kList; of a complex one, an omitted value.
  [[nodiscard]] Value parameters() const;
  /// The part of a complex instance (or the one of a simple instance) with this keyword.
  [[nodiscard]] std::optional<Value> part(std::string_view keyword) const;
  /// !KEYWORD(...): not of the schema.
  [[nodiscard]] bool user_defined() const;
  /// Position among the instances (or header entities) of the file, from 0.
  [[nodiscard]] std::size_t index() const { return index_; }

 private:
  const detail::Store* store_;
  std::uint32_t index_;
  bool in_header_;
};

/// A section of edition 3 that is kept as it was written, between its keyword and its ENDSEC.
struct VerbatimSection {
  std::string_view keyword;  ///< ANCHOR, REFERENCE or SIGNATURE
  std::string_view text;
  std::uint64_t line = 0;
};

/// DATA; or, in edition 2 and 3, DATA('name',('SCHEMA'));
struct DataSection {
  Value parameters;       ///< a kList, empty for a plain DATA;
  std::size_t first = 0;  ///< index of its first instance
  std::size_t count = 0;
};

/// A parsed exchange file. Owns the text; everything read from it is a view.
///
/// Thread safety   const members may be called from any number of threads.
class File {
 public:
  explicit File(std::unique_ptr<const detail::Store> store);
  File(File&&) noexcept;
  File& operator=(File&&) noexcept;
  ~File();

  /// As the caller named it.
  [[nodiscard]] const std::string& name() const;

  [[nodiscard]] std::size_t header_count() const;
  [[nodiscard]] Instance header(std::size_t i) const;
  /// The first header entity of this keyword.
  [[nodiscard]] std::optional<Instance> header(std::string_view keyword) const;
  /// The names in FILE_SCHEMA, decoded, as written ("AUTOMOTIVE_DESIGN { 1 0 10303 214 ...}").
  [[nodiscard]] std::vector<std::string> schemas() const;

  [[nodiscard]] const std::vector<DataSection>& data_sections() const;

  /// Instances of all data sections, in file order.
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] Instance instance(std::size_t i) const;
  [[nodiscard]] std::optional<Instance> find(std::uint64_t id) const;

  [[nodiscard]] const std::vector<VerbatimSection>& verbatim_sections() const;
  /// Instance numbers that the REFERENCE section binds to other files (which are never opened), sorted.
  [[nodiscard]] const std::vector<std::uint64_t>& external_ids() const;

  class Iterator {
   public:
    Iterator(const File* file, std::size_t i) : file_(file), i_(i) {}
    Instance operator*() const { return file_->instance(i_); }
    Iterator& operator++() {
      ++i_;
      return *this;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.i_ == b.i_; }

   private:
    const File* file_;
    std::size_t i_;
  };
  [[nodiscard]] Iterator begin() const { return {this, 0}; }
  [[nodiscard]] Iterator end() const { return {this, size()}; }

 private:
  std::unique_ptr<const detail::Store> store_;
};

/// Whether two parameters say the same: numbers of one kind by value, strings decoded, lists by element.
[[nodiscard]] bool same_content(const Value& a, const Value& b);

/// Whether two files hold the same header, sections and instances, in the same order; lines, comments,
/// spacing and the spelling of numbers and strings do not matter.
[[nodiscard]] bool same_content(const File& a, const File& b);

}  // namespace capstan::p21
