#include "planner/files/json/tree/tree.h"
#include "planner/ground/base/stopping.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace capstan::json {
namespace {

using Tree = nlohmann::json;

/// Makes the tree as the parser meets its parts.
class Builder final : public nlohmann::json_sax<Tree> {
 public:
  Builder(std::vector<Column> columns, Tree& tree, TreeFault& fault)
      : columns_(std::move(columns)), tree_(tree), fault_(fault) {}

  bool null() override { return put(nullptr); }
  bool boolean(bool v) override { return put(v); }
  bool number_integer(number_integer_t v) override { return put(v); }
  bool number_unsigned(number_unsigned_t v) override { return put(v); }
  bool number_float(number_float_t v, const string_t& /*text*/) override { return put(v); }
  bool string(string_t& v) override { return put(std::move(v)); }
  bool binary(binary_t& /*v*/) override { return false; }  // no text has one
  bool start_object(std::size_t /*size*/) override { return open(Tree::object()); }
  bool key(string_t& name) override {
    next_ = &(*open_.back())[std::move(name)];
    return true;
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t /*size*/) override {
    const std::size_t array = arrays_++;
    if (taken_ == columns_.size() || columns_[taken_].array != array) return open(Tree::array());
    Column& c = columns_[taken_++];
    return open(Tree::binary(std::move(c.bytes), subtype_of(c.not_whole)));
  }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t byte, const std::string& token, const Tree::exception& e) override {
    constexpr int kNumberTooLarge = 406;
    fault_.byte = byte;
    if (e.id == kNumberTooLarge) fault_.too_large = token;
    return false;
  }

 private:
  template <class T>
  Tree* place(T&& v) {
    tick();
    if (open_.empty()) {
      tree_ = std::forward<T>(v);
      return &tree_;
    }
    if (open_.back()->is_array()) {
      open_.back()->push_back(std::forward<T>(v));
      return &open_.back()->back();
    }
    *next_ = std::forward<T>(v);
    return next_;
  }
  template <class T>
  bool put(T&& v) {
    place(std::forward<T>(v));
    return true;
  }
  bool open(Tree v) {
    open_.push_back(place(std::move(v)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  std::vector<Column> columns_;
  std::size_t taken_ = 0, arrays_ = 0;
  Tree& tree_;
  TreeFault& fault_;
  std::vector<Tree*> open_;
  Tree* next_ = nullptr;  ///< of the key that was met last
};

}  // namespace

template <class T>
bool make_tree(Columns taken, T& tree, TreeFault& fault) {
  Builder builder(std::move(taken.columns), tree, fault);
  return T::sax_parse(taken.rest, &builder);
}

template bool make_tree(Columns, Tree&, TreeFault&);

}  // namespace capstan::json
