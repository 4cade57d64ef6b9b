#include "tests/mutation/lines.h"

// What the operator clamps the piece and loads the tools by, said otherwise: in comments of every control,
// some of which write capitals.

namespace capstan::mutation {
namespace {

std::string small(std::string l) {
  for (char& c : l) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return l;
}

/// A line that has this in it, whatever its letters; `f` gets the place behind that.
template <class F>
Made with_text(const Emitted& e, Random& r, const std::string& text, F f) {
  Lines lines = split(e.text);
  const auto i = pick(lines, r, [&](std::size_t k) {
    const std::string l = small(lines[k]);
    return holds(l, text) && !holds(l, "rest material");
  });
  if (!i) return std::nullopt;
  f(lines, *i, small(lines[*i]).find(text) + text.size());
  return Edit{joined(lines), e.table};
}

/// The first digit behind a place, made another one, and no 0.
void another_digit(std::string& l, std::size_t at, Random& r) {
  at = l.find_first_of("0123456789", at);
  if (at == std::string::npos) return;
  const auto digit = static_cast<char>('1' + static_cast<int>(r.below(9)));
  l[at] = digit != l[at] ? digit : digit == '9' ? '1' : static_cast<char>(digit + 1);
}

Made number_behind(const Emitted& e, Random& r, const std::string& text) {
  return with_text(e, r, text,
                   [&](Lines& lines, std::size_t i, std::size_t at) { another_digit(lines[i], at, r); });
}

Made line_removed(const Emitted& e, Random& r, const std::string& text) {
  return with_text(e, r, text, [](Lines& lines, std::size_t i, std::size_t /*at*/) {
    lines.erase(lines.begin() + static_cast<long>(i));
  });
}

}  // namespace

std::vector<Class> told_otherwise() {
  return {
      {"told: another place of the raw piece", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) { return number_behind(e, r, "the raw piece reaches from x"); }},
      {"told: another size of the raw piece", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) { return number_behind(e, r, "stock: "); }},
      {"told: another security plane", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) { return number_behind(e, r, "security="); }},
      {"told: zero at the other side", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return with_text(e, r, "x0 at its ", [](Lines& lines, std::size_t i, std::size_t at) {
           lines[i].replace(at, 4, "right");  // left
         });
       }},
      {"told: another side up", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return with_text(e, r, "the workpiece's ",
                          [](Lines& lines, std::size_t i, std::size_t at) { lines[i][at] = '-'; });
       }},
      {"told: another tool", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         // One that a step calls: of others nothing hangs on it.
         const std::string all = small(e.text), head = "capstan tool t";
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) {
           const std::string l = small(lines[k]);
           const std::size_t at = l.find(head);
           if (at == std::string::npos) return false;
           const std::size_t number = at + head.size();
           return holds(all, " tool=" + l.substr(number, l.find(' ', number) - number) + " ");
         });
         if (!i) return Made{};
         const std::size_t quote = lines[*i].find('"');
         lines[*i].insert(lines[*i].find('"', quote + 1), "9");
         return Made{Edit{joined(lines), e.table}};
       }},
      {"told: another tool of a step", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) { return number_behind(e, r, " tool="); }},
      {"told: another material", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return with_text(e, r, "material: ", [](Lines& lines, std::size_t i, std::size_t at) {
           lines[i].insert(at, "no ");
         });
       }},
      {"told: nothing of clamping anew", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) { return line_removed(e, r, ": clamp "); }},
      {"told: nothing of where zero is", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) { return line_removed(e, r, ": zero "); }},
      {"told: an operator's own words", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         const bool brackets = e.dialect != "siemens" && e.dialect != "heidenhain";
         return with_text(e, r, "set-up ", [&](Lines& lines, std::size_t i, std::size_t /*at*/) {
           // A block of Heidenhain's that goes on in the next line is not to be parted.
           while (i > 0 && lines[i - 1].ends_with("~")) --i;
           const char* const kWords[] = {"JAWS GREASED", "SET-UP 1: USE THE TORQUE WRENCH"};
           const std::string words = kWords[r.below(2)];
           lines.insert(lines.begin() + static_cast<long>(i), brackets ? "(" + words + ")" : "; " + words);
         });
       }},
  };
}

}  // namespace capstan::mutation
