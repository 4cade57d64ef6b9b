#include "planner/files/p21/file.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner/files/p21/read/number.h"
#include "planner/files/p21/read/text.h"
#include "planner/files/p21/store.h"

namespace capstan::p21 {

using detail::start_of;
using detail::Tag;
using detail::tag_of;

namespace {

[[noreturn]] void wrong_kind(const char* wanted, Kind is) {
  throw std::logic_error(std::string("p21: asked for ") + wanted + " where there is " + to_text(is));
}

}  // namespace

const char* to_text(Kind kind) {
  switch (kind) {
    case Kind::kOmitted:
      return "an omitted value ($)";
    case Kind::kDerived:
      return "a derived value (*)";
    case Kind::kInteger:
      return "an integer";
    case Kind::kReal:
      return "a real";
    case Kind::kString:
      return "a string";
    case Kind::kEnumeration:
      return "an enumeration value";
    case Kind::kBinary:
      return "a binary";
    case Kind::kReference:
      return "a reference";
    case Kind::kList:
      return "a list";
    case Kind::kTyped:
      return "a typed parameter";
  }
  return "a parameter";
}

// ------------------------------------------------------------------------------------------- Value

std::int64_t Value::as_integer() const {
  if (tag_of(node_) != Tag::kInteger) wrong_kind("an integer", kind());
  return detail::to_integer(view());
}

double Value::as_real() const {
  if (tag_of(node_) != Tag::kReal && tag_of(node_) != Tag::kInteger) wrong_kind("a number", kind());
  return detail::to_real(view());
}

std::string_view Value::lexeme() const {
  const Tag tag = tag_of(node_);
  if (arena_ == nullptr) return "$";
  return tag == Tag::kList || tag == Tag::kTyped ? std::string_view() : view();
}

std::string_view Value::as_text(std::string& buffer) const {
  if (tag_of(node_) == Tag::kString) return view();
  if (tag_of(node_) != Tag::kEscapedString) wrong_kind("a string", kind());
  buffer.clear();
  detail::TextIssues ignored;  // the parser has reported them
  detail::decode_text(view(), buffer, ignored);
  return buffer;
}

std::string Value::as_text() const {
  std::string buffer;
  const std::string_view text = as_text(buffer);
  return tag_of(node_) == Tag::kString ? std::string(text) : buffer;
}

std::string_view Value::enumeration() const {
  if (tag_of(node_) != Tag::kEnumeration) wrong_kind("an enumeration value", kind());
  return view();
}

std::uint64_t Value::reference() const {
  if (tag_of(node_) != Tag::kReference) wrong_kind("a reference", kind());
  return detail::to_id(view());
}

void Value::no_element(std::size_t i) { throw std::out_of_range("p21: no element " + std::to_string(i)); }

std::string_view Value::keyword() const {
  if (tag_of(node_) != Tag::kTyped) wrong_kind("a typed parameter", kind());
  return Value(arena_, arena_->nodes[start_of(node_)]).view();
}

// ---------------------------------------------------------------------------------------- Instance

namespace {

const detail::Entity& entity_of(const detail::Store& store, std::uint32_t index, bool in_header) {
  return (in_header ? store.header : store.entities)[index];
}

}  // namespace

std::uint64_t Instance::id() const { return entity_of(*store_, index_, in_header_).id; }
std::uint64_t Instance::line() const { return entity_of(*store_, index_, in_header_).line; }
bool Instance::is_complex() const { return entity_of(*store_, index_, in_header_).complex != 0; }

std::size_t Instance::part_count() const {
  return entity_of(*store_, index_ + 1, in_header_).part - entity_of(*store_, index_, in_header_).part;
}

Record Instance::part(std::size_t i) const {
  if (i >= part_count()) throw std::out_of_range("p21: no part " + std::to_string(i));
  const detail::Part& part = store_->parts[entity_of(*store_, index_, in_header_).part + i];
  return {store_->view(part.keyword_start, part.keyword_length), Value(&store_->arena, part.parameters)};
}

std::string_view Instance::keyword() const { return is_complex() ? std::string_view() : part(0).keyword; }

Value Instance::parameters() const { return is_complex() ? Value() : part(0).parameters; }

std::optional<Value> Instance::part(std::string_view keyword) const {
  for (std::size_t i = 0; i < part_count(); ++i) {
    const Record record = part(i);
    if (record.keyword == keyword) return record.parameters;
  }
  return std::nullopt;
}

bool Instance::user_defined() const { return part(0).keyword.starts_with('!'); }

// -------------------------------------------------------------------------------------------- File

File::File(std::unique_ptr<const detail::Store> store) : store_(std::move(store)) {}
File::File(File&&) noexcept = default;
File& File::operator=(File&&) noexcept = default;
File::~File() = default;

const std::string& File::name() const { return store_->name; }
std::size_t File::header_count() const { return store_->header.size() - 1; }

Instance File::header(std::size_t i) const {
  if (i >= header_count()) throw std::out_of_range("p21: no header entity " + std::to_string(i));
  return {store_.get(), static_cast<std::uint32_t>(i), true};
}

std::optional<Instance> File::header(std::string_view keyword) const {
  for (std::size_t i = 0; i < header_count(); ++i) {
    if (header(i).keyword() == keyword) return header(i);
  }
  return std::nullopt;
}

std::vector<std::string> File::schemas() const {
  std::vector<std::string> names;
  const auto entity = header("FILE_SCHEMA");
  if (!entity || entity->parameters().empty()) return names;
  const Value list = entity->parameters()[0];
  if (list.is(Kind::kString)) names.push_back(list.as_text());
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].is(Kind::kString)) names.push_back(list[i].as_text());
  }
  return names;
}

const std::vector<DataSection>& File::data_sections() const { return store_->data; }
std::size_t File::size() const { return store_->entities.size() - 1; }

Instance File::instance(std::size_t i) const {
  if (i >= size()) throw std::out_of_range("p21: no instance at position " + std::to_string(i));
  return {store_.get(), static_cast<std::uint32_t>(i), false};
}

std::optional<Instance> File::find(std::uint64_t id) const {
  const auto at = store_->index.find(id);
  if (!at) return std::nullopt;
  return Instance(store_.get(), *at, false);
}

const std::vector<VerbatimSection>& File::verbatim_sections() const { return store_->verbatim; }
const std::vector<std::uint64_t>& File::external_ids() const { return store_->external_ids; }

// ------------------------------------------------------------------------------------ same_content

namespace {

bool same_leaf(const Value& a, const Value& b) {
  switch (a.kind()) {
    case Kind::kInteger:
      return a.as_integer() == b.as_integer();
    case Kind::kReal:
      return a.as_real() == b.as_real();
    case Kind::kString:
      return a.as_text() == b.as_text();
    case Kind::kReference:
      return a.reference() == b.reference();
    case Kind::kEnumeration:
    case Kind::kBinary:
      return a.lexeme() == b.lexeme();
    case Kind::kTyped:
      return a.keyword() == b.keyword();
    case Kind::kOmitted:
    case Kind::kDerived:
    case Kind::kList:
      return true;
  }
  return false;
}

bool same_content(const Instance& a, const Instance& b) {
  if (a.id() != b.id() || a.is_complex() != b.is_complex() || a.part_count() != b.part_count()) return false;
  for (std::size_t i = 0; i < a.part_count(); ++i) {
    const Record of_a = a.part(i);
    const Record of_b = b.part(i);
    if (of_a.keyword != of_b.keyword || !same_content(of_a.parameters, of_b.parameters)) return false;
  }
  return true;
}

}  // namespace

bool same_content(const Value& a, const Value& b) {
  std::vector<std::pair<Value, Value>> pending{{a, b}};
  while (!pending.empty()) {
    const auto [x, y] = pending.back();
    pending.pop_back();
    if (x.kind() != y.kind() || x.size() != y.size() || !same_leaf(x, y)) return false;
    for (std::size_t i = 0; i < x.size(); ++i) pending.emplace_back(x[i], y[i]);
  }
  return true;
}

bool same_content(const File& a, const File& b) {
  if (a.header_count() != b.header_count() || a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.header_count(); ++i) {
    if (!same_content(a.header(i), b.header(i))) return false;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!same_content(a.instance(i), b.instance(i))) return false;
  }
  const auto same_section = [](const DataSection& x, const DataSection& y) {
    return x.first == y.first && x.count == y.count && same_content(x.parameters, y.parameters);
  };
  const auto same_text = [](const VerbatimSection& x, const VerbatimSection& y) {
    return x.keyword == y.keyword && x.text == y.text;
  };
  return std::equal(a.data_sections().begin(), a.data_sections().end(), b.data_sections().begin(),
                    b.data_sections().end(), same_section) &&
         std::equal(a.verbatim_sections().begin(), a.verbatim_sections().end(), b.verbatim_sections().begin(),
                    b.verbatim_sections().end(), same_text);
}

}  // namespace capstan::p21
