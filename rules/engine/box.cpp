#include "rules/engine/box.h"

#include <algorithm>

#include "planner/ground/base/number.h"

namespace capstan::rules {

Side domain_of(const FactType& fact) {
  if (fact.kind != FactKind::kSymbol) return {fact.from, fact.below, 0, false};
  const auto all = fact.symbols.size() >= 32 ? ~std::uint32_t{0}
                                             : (std::uint32_t{1} << fact.symbols.size()) - std::uint32_t{1};
  return {0.0, 0.0, all, true};
}

bool empty(const Side& side) { return side.symbolic ? side.symbols == 0 : !(side.from < side.below); }
bool empty(const Box& box) {
  return std::any_of(box.begin(), box.end(), [](const Side& s) { return empty(s); });
}

bool holds(const Side& side, double value) {
  if (side.symbolic) return (side.symbols >> static_cast<unsigned>(value) & 1U) != 0;
  return side.from <= value && value < side.below;
}

Side intersect(const Side& a, const Side& b) {
  if (a.symbolic) return {0.0, 0.0, a.symbols & b.symbols, true};
  return {std::max(a.from, b.from), std::min(a.below, b.below), 0, false};
}

Box intersect(const Box& a, const Box& b) {
  Box out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = intersect(a[i], b[i]);
  return out;
}

std::vector<Box> subtract(const Box& a, const Box& b) {
  if (empty(a)) return {};
  if (empty(intersect(a, b))) return {a};
  std::vector<Box> out;
  Box rest = a;  // the part of a that agrees with b on the sides looked at so far
  const auto cut = [&](std::size_t i, Side side) {
    if (empty(side)) return;
    out.push_back(rest);
    out.back()[i] = side;
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Side s = rest[i];
    if (s.symbolic) {
      cut(i, {0.0, 0.0, s.symbols & ~b[i].symbols, true});
    } else {
      cut(i, {s.from, std::min(s.below, b[i].from), 0, false});
      cut(i, {std::max(s.from, b[i].below), s.below, 0, false});
    }
    rest[i] = intersect(s, b[i]);
  }
  return out;
}

std::vector<Box> subtract(const std::vector<Box>& boxes, const Box& b) {
  std::vector<Box> out;
  for (const Box& a : boxes) {
    auto pieces = subtract(a, b);
    out.insert(out.end(), std::make_move_iterator(pieces.begin()), std::make_move_iterator(pieces.end()));
  }
  return out;
}

std::string to_text(const Box& box, const std::vector<std::size_t>& facts) {
  std::string out;
  for (std::size_t i = 0; i < box.size(); ++i) {
    const FactType& type = fact_types().at(facts.at(i));
    if (box[i] == domain_of(type)) continue;
    if (!out.empty()) out += ", ";
    out += std::string(type.name) + " in ";
    if (!box[i].symbolic) {
      out += "[" + shortest(box[i].from) + ", " + shortest(box[i].below) + ")";
      continue;
    }
    std::string set;
    for (std::size_t k = 0; k < type.symbols.size(); ++k) {
      if ((box[i].symbols >> k & 1U) == 0) continue;
      set += (set.empty() ? "" : ", ") + std::string(type.symbols[k]);
    }
    out += "{" + set + "}";
  }
  return out.empty() ? "everything" : out;
}

}  // namespace capstan::rules
