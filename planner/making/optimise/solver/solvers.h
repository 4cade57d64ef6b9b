#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "planner/making/optimise/solver/backend.h"

/// Which solvers there are, from the rows of solvers.inc.
namespace capstan::optimise {

enum class Solver : std::uint8_t {
#define CAPSTAN_SOLVER(noun, word) k##noun,
#include "planner/making/optimise/solver/solvers.inc"
#undef CAPSTAN_SOLVER
};

struct NamedSolver {
  Solver solver;
  const char* word;  ///< in options, in plans and as a Solution's method
};

inline constexpr auto kSolvers = std::to_array<NamedSolver>({
#define CAPSTAN_SOLVER(noun, word) {Solver::k##noun, #word},
#include "planner/making/optimise/solver/solvers.inc"
#undef CAPSTAN_SOLVER
});

[[nodiscard]] constexpr const char* word_of(Solver s) { return kSolvers[static_cast<std::size_t>(s)].word; }

/// The solvers that a program brings. NLopt is part of this room; a program that wants the others links
/// capstan::optimise_solvers and takes all_backends(). A null pointer is a backend that is absent.
class Backends {
 public:
  Backends() { (*this)[Solver::kNlopt] = &solve_with_nlopt; }
  [[nodiscard]] Backend& operator[](Solver s) { return of_[static_cast<std::size_t>(s)]; }
  [[nodiscard]] Backend operator[](Solver s) const { return of_[static_cast<std::size_t>(s)]; }

 private:
  std::array<Backend, kSolvers.size()> of_ = {};
};

/// Every solver there is; one that this build lacks answers OPT-BACKEND-ABSENT. In capstan::optimise_solvers.
[[nodiscard]] Backends all_backends();

}  // namespace capstan::optimise
