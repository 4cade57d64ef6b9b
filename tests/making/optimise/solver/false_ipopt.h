#pragma once

#include <cstdint>

namespace capstan::optimise {

/// What the library that stands for Ipopt in tests (false_ipopt.cpp) does; it exports one of these,
/// `capstan_false_ipopt`.
struct FalseIpopt {
  enum class Fault : std::uint8_t {
    kNone,
    kNoProblem,
    kThrowsAtProblem,
    kNoOption,
    kThrowsAtOption,
    kNoCallback,
    kThrowsAtSolving
  };
  Fault fault = Fault::kNone;
  bool asks = true;  ///< for the objective at the start, before it ends or throws
  int status = 0;    ///< of IpoptSolve
};

}  // namespace capstan::optimise
