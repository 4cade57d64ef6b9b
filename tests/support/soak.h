#pragma once

#include <cstdlib>

namespace capstan {

/// Whether `./dev soak` repeats the tests: then each takes all of what otherwise is a sample.
inline bool soaking() { return std::getenv("CAPSTAN_SOAK") != nullptr; }

/// How often a test repeats its claim: a short sample in CI, all of it where tests soak.
inline int rounds(int sample, int whole) { return soaking() ? whole : sample; }

}  // namespace capstan
