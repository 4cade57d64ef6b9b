#pragma once

#include <string>
#include <vector>

#include "planner/files/p21/file.h"
#include "planner/model/nouns/arena/kept.h"

namespace capstan::exchange {

/// A parameter as it is spelled in Part 21: "('a',#12,$)".
[[nodiscard]] std::string spelling(const p21::Value& v);

/// A number as the file spelled it; the whole spelling for anything else.
[[nodiscard]] std::string lexeme_of(const p21::Value& v);

/// An instance as text with its references apart, each replaced by what `resolve` gives; a reference that
/// resolves to nothing stays text.
template <class Resolve>
[[nodiscard]] model::KeptInstance keep(const p21::Instance& instance, const Resolve& resolve);

namespace detail {

/// Collects text and references. Needs values nested no deeper than the parser's limit.
class Pieces {
 public:
  virtual ~Pieces() = default;
  void value(const p21::Value& v);
  void text(std::string_view s);
  void reference(model::AnyRef r) { pieces.emplace_back(r); }
  std::vector<std::variant<std::string, model::AnyRef>> pieces;

 protected:
  virtual model::AnyRef resolve(std::uint64_t id) const = 0;
};

}  // namespace detail

template <class Resolve>
model::KeptInstance keep(const p21::Instance& instance, const Resolve& resolve) {
  class Bound final : public detail::Pieces {
   public:
    explicit Bound(const Resolve& r) : resolve_(r) {}

   protected:
    model::AnyRef resolve(std::uint64_t id) const override { return resolve_(id); }

   private:
    const Resolve& resolve_;
  };
  Bound out(resolve);
  model::KeptInstance kept;
  if (instance.is_complex()) out.text("(");
  for (std::size_t i = 0; i < instance.part_count(); ++i) {
    const p21::Record part = instance.part(i);
    if (!kept.keyword.empty()) kept.keyword += ' ';
    kept.keyword += part.keyword;
    out.text(part.keyword);
    out.value(part.parameters);
  }
  if (instance.is_complex()) out.text(")");
  kept.pieces = std::move(out.pieces);
  return kept;
}

}  // namespace capstan::exchange
