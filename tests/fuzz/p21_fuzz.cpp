#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "planner/files/p21/print.h"
#include "planner/files/p21/read/parse.h"

namespace {

void must(bool good, const char* what) {
  if (good) return;
  std::fputs(what, stderr);
  std::abort();
}

}  // namespace

/// What reads must print, what was printed must read back to the same content, and printing that must give
/// the same bytes. A refusal must say something.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace capstan;
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(data[i]);
  Job job;
  const auto first = p21::parse(std::move(bytes), "input", {}, job);
  if (!first) {
    must(job.has_errors() && !first.error().message.empty(), "refused without a word\n");
    return 0;
  }
  must(!job.has_errors(), "read in spite of errors\n");
  p21::check_references(*first, job);
  const std::string printed = p21::print(*first);
  Job again;
  const auto second = p21::parse(printed, "printed", {}, again);
  must(second.has_value(), "what was printed does not read\n");
  must(p21::same_content(*first, *second), "what was printed reads differently\n");
  must(p21::print(*second) == printed, "printing is not a fixed point\n");
  return 0;
}
