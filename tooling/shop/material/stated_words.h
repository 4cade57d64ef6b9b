#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tooling/shop/material/hardness_scales.h"

namespace capstan::tooling {

/// A hardness or strength as it is stated, and what it is in Brinell.
struct StatedHardness {
  Scale scale = Scale::kBrinell;
  double brinell = 0.0;  ///< infinite: harder than any card, or not to be read; 0: no conversion (kOther)
  std::string text;      ///< "48 HRC"
};

/// A state of heat treatment that a text says in words.
enum class State : std::uint8_t {
  kSoft,      ///< annealed, normalized, not hardened: the grade's own card
  kTempered,  ///< quenched and tempered, prehardened
  kAged,      ///< precipitation hardened
  kHard,      ///< hardened, quenched
  kSurface    ///< case-hardened, induction hardened, nitrided: a hard skin over a soft core
};
struct StatedState {
  State state = State::kSoft;
  std::string text;  ///< as it stands there: "case-hardened"
};

/// What a text says of a material beside its grade's name. English and German, the commonest words of
/// French, Italian, Portuguese and Spanish.
struct StatedWords {
  std::vector<StatedHardness> hardness;  ///< in their order
  std::vector<StatedState> states;
  std::string before;  ///< what stands before the first hardness; all where there is none
  std::string plain;   ///< the same without the words of states
  [[nodiscard]] bool none() const { return hardness.empty() && states.empty(); }
};

/// Reads "42CrMo4 300 HB", "hardened, HRC 48", "58+2 HRC", "Rm 900-1100 N/mm2", "16MnCr5 case-hardened". Of a
/// range the hard end. A hardness beside whose unit no number can be read is infinite: the piece is refused.
[[nodiscard]] StatedWords stated_words(std::string_view text);

/// The words that states of heat treatment have right behind a grade: "42CrMo4V", "4140 HT", "4140 PH".
[[nodiscard]] std::vector<StatedState> states_behind_grade(std::string_view rest);

}  // namespace capstan::tooling
