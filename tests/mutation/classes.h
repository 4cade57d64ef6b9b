#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/mutation/emitted.h"

namespace capstan::mutation {

/// Numbers from a seed; the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15U + 0x2545f4914f6cdd1dU) {}
  [[nodiscard]] std::uint64_t next();
  [[nodiscard]] std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(next() % n); }
  /// In [lo, hi), on hundredths.
  [[nodiscard]] double between(double lo, double hi);

 private:
  std::uint64_t state_;
};

struct Edit {
  std::string text, table;
};

enum class Kind {
  kDangerous,  ///< may break a tool or the piece, or hurt somebody
  kDifferent,  ///< the machine does something else
  kBenign,     ///< the same in other words
  kUnknown     ///< LinuxCNC's interpreter says whether it differs
};

/// One way to spoil, or to rewrite, a program or its tool table.
struct Class {
  const char* name;
  Kind kind;
  bool in_any_program;  ///< dangerous whatever the plan: must be found without it
  std::optional<Edit> (*make)(const Emitted&, Random&);
};

[[nodiscard]] std::vector<Class> dangerous_in_any();
[[nodiscard]] std::vector<Class> dangerous_by_plan();
[[nodiscard]] std::vector<Class> not_dangerous();
/// What the operator is told, said otherwise: of every control's programs.
[[nodiscard]] std::vector<Class> told_otherwise();
/// All of them, as programs of LinuxCNC are edited.
[[nodiscard]] const std::vector<Class>& classes();
/// Ways to spoil what only FANUC's and Haas's programs have: cycles, M29, decimal points, G43 with Z, G187.
[[nodiscard]] std::vector<Class> dangerous_in_fanuc();
/// And those of Siemens: modal calls and their parameters, SUPA, CYCLE832, TURN=.
[[nodiscard]] std::vector<Class> dangerous_in_siemens();
/// And those of Grbl: lengths as numbers, characters that are commands.
[[nodiscard]] std::vector<Class> dangerous_in_grbl();
[[nodiscard]] std::vector<Class> dangerous_in_mach3();
/// Those of Heidenhain's cycles, and what is not dangerous in its programs.
[[nodiscard]] std::vector<Class> heidenhain_cycles();
/// All ways to edit Heidenhain's, which share no word with the others.
[[nodiscard]] std::vector<Class> classes_in_heidenhain();
/// Those of that control's programs.
[[nodiscard]] std::vector<Class> classes_of(const std::string& dialect);

}  // namespace capstan::mutation
