#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace capstan {

/// A text that does not change and that many things say: a copy refers to the same bytes and copies none.
/// Reads like a std::string; to change it, give it another.
///
/// Thread safety  that of std::shared_ptr: copies may be used in different threads.
class SharedText {
 public:
  SharedText() = default;
  SharedText(std::string text)  // NOLINT: a text is one
      : text_(text.empty() ? nullptr : std::make_shared<const std::string>(std::move(text))) {}
  SharedText(std::string_view text) : SharedText(std::string(text)) {}  // NOLINT
  SharedText(const char* text) : SharedText(std::string(text)) {}       // NOLINT

  [[nodiscard]] const std::string& text() const { return text_ == nullptr ? kEmpty : *text_; }
  operator const std::string&() const { return text(); }  // NOLINT

  [[nodiscard]] bool empty() const { return text_ == nullptr; }
  [[nodiscard]] bool starts_with(std::string_view head) const { return text().starts_with(head); }
  [[nodiscard]] bool ends_with(std::string_view tail) const { return text().ends_with(tail); }
  [[nodiscard]] std::size_t find(std::string_view part, std::size_t from = 0) const {
    return text().find(part, from);
  }

  friend bool operator==(const SharedText& a, const SharedText& b) {
    return a.text_ == b.text_ || a.text() == b.text();
  }
  template <class T>
  requires(!std::same_as<T, SharedText> && std::convertible_to<const T&, std::string_view>) friend bool
  operator==(const SharedText& a, const T& b) {
    return a.text() == std::string_view(b);
  }

 private:
  inline static const std::string kEmpty;
  std::shared_ptr<const std::string> text_;  ///< null: the empty text
};

/// What forms write as a text.
template <class T>
concept IsText = std::same_as<T, std::string> || std::same_as<T, SharedText>;

}  // namespace capstan
