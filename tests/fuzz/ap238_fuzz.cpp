#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "planner/files/exchange/exchange.h"
#include "planner/files/p21/read/parse.h"

namespace {

void must(bool good, const char* what) {
  if (good) return;
  std::fputs(what, stderr);
  std::abort();
}

}  // namespace

/// Whatever parses as Part 21 is read as AP238 whatever schema it names: a refusal says something; what was
/// read can be written in both forms; what was written reads back without an error of spelling, and is
/// written the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace capstan;
  std::string bytes(reinterpret_cast<const char*>(data), size);
  Job job;
  const auto file = p21::parse(std::move(bytes), "input", {}, job);
  if (!file) return 0;
  const auto plan = exchange::read_ap238(*file, job);
  if (!plan) {
    must(job.has_errors() && !plan.error().message.empty(), "refused without a word\n");
    return 0;
  }
  Job writing;
  const auto iso = exchange::write_iso14649(*plan, writing);
  const auto first = exchange::write_ap238(*plan, writing);
  if (!first) return 0;
  Job again;
  const auto reparsed = p21::parse(first->bytes, "written", {}, again);
  must(reparsed.has_value(), "what was written is no Part 21\n");
  if (iso) must(p21::parse(iso->bytes, "iso", {}, again).has_value(), "the ISO 14649 form is no Part 21\n");
  (void)exchange::read_ap238(*reparsed, again);
  return 0;
}
