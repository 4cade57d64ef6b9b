#include "planner/files/exchange/common/text.h"

#include "planner/files/p21/print.h"

namespace capstan::exchange {

namespace detail {

void Pieces::text(std::string_view s) {
  if (pieces.empty() || !std::holds_alternative<std::string>(pieces.back()))
    pieces.emplace_back(std::string());
  std::get<std::string>(pieces.back()) += s;
}

// Recursion is bounded by p21::Limits::depth.
void Pieces::value(const p21::Value& v) {
  switch (v.kind()) {
    case p21::Kind::kOmitted:
      return text("$");
    case p21::Kind::kDerived:
      return text("*");
    case p21::Kind::kInteger:
    case p21::Kind::kReal:
      return text(v.lexeme());
    case p21::Kind::kString:
      text("'");
      text(p21::encode_text(v.as_text()));
      return text("'");
    case p21::Kind::kEnumeration:
      text(".");
      text(v.enumeration());
      return text(".");
    case p21::Kind::kBinary:
      text("\"");
      text(v.lexeme());
      return text("\"");
    case p21::Kind::kReference: {
      const model::AnyRef r = resolve(v.reference());
      if (r.set()) return reference(r);
      text("#");
      return text(std::to_string(v.reference()));
    }
    case p21::Kind::kTyped:
      text(v.keyword());
      text("(");
      value(v[0]);
      return text(")");
    case p21::Kind::kList:
      text("(");
      for (std::size_t i = 0; i < v.size(); ++i) {
        if (i != 0) text(",");
        value(v[i]);
      }
      return text(")");
  }
}

}  // namespace detail

namespace {

class Plain final : public detail::Pieces {
 protected:
  model::AnyRef resolve(std::uint64_t) const override { return {}; }
};

}  // namespace

std::string spelling(const p21::Value& v) {
  Plain out;
  out.value(v);
  return out.pieces.empty() ? std::string() : std::get<std::string>(out.pieces.front());
}

std::string lexeme_of(const p21::Value& v) { return v.is_number() ? std::string(v.lexeme()) : spelling(v); }

}  // namespace capstan::exchange
