#include "tooling/shop/material/folded_text.h"

#include <array>

namespace capstan::tooling {
namespace {

struct Fold {
  std::string_view from, to;
};
/// UTF-8 first; then single bytes of ISO 8859-1, which files that should be UTF-8 have, too.
constexpr std::array kFolds = {
    Fold{"\xC3\x84", "AE"},    Fold{"\xC3\xA4", "AE"},    Fold{"\xC3\x96", "OE"},
    Fold{"\xC3\xB6", "OE"},    Fold{"\xC3\x9C", "UE"},    Fold{"\xC3\xBC", "UE"},
    Fold{"\xC3\x9F", "SS"},    Fold{"\xC3\xA9", "E"},     Fold{"\xC3\x89", "E"},
    Fold{"\xC3\xA8", "E"},     Fold{"\xC3\xAA", "E"},     Fold{"\xC3\xA3", "A"},
    Fold{"\xC3\xA1", "A"},     Fold{"\xC3\xA0", "A"},     Fold{"\xC3\xA7", "C"},
    Fold{"\xC3\xAD", "I"},     Fold{"\xC3\xB3", "O"},     Fold{"\xCC\x88", "E"},
    Fold{"\xC2\xB2", "2"},     Fold{"\xC2\xB1", "+"},     Fold{"\xE2\x80\x90", "-"},
    Fold{"\xE2\x80\x93", "-"}, Fold{"\xE2\x80\x94", "-"}, Fold{"\xE2\x88\x92", "-"},
    Fold{"\xE4", "AE"},        Fold{"\xC4", "AE"},        Fold{"\xF6", "OE"},
    Fold{"\xD6", "OE"},        Fold{"\xFC", "UE"},        Fold{"\xDC", "UE"},
    Fold{"\xB2", "2"},         Fold{"\xB1", "+"}};

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace

FoldedText folded(std::string_view text) {
  FoldedText out;
  const auto add = [&](std::string_view chars, std::size_t at) {
    for (const char c : chars) {
      out.text += c;
      out.at.push_back(at);
    }
  };
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) < 0x80) {
      const char upper = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
      add(std::string_view(&upper, 1), i++);
      continue;
    }
    std::size_t size = 0;
    std::string_view to = " ";
    for (const Fold& f : kFolds) {
      if (!text.substr(i).starts_with(f.from)) continue;
      // A single byte stands for a letter only where it does not lead a sequence of UTF-8.
      if (f.from.size() == 1 && i + 1 < text.size() && continues(text[i + 1])) continue;
      size = f.from.size();
      to = f.to;
      break;
    }
    if (size == 0)
      for (size = 1; i + size < text.size() && continues(text[i + size]);) ++size;
    add(to, i);
    i += size;
  }
  out.at.push_back(text.size());
  return out;
}

}  // namespace capstan::tooling
