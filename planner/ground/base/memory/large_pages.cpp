#include "planner/ground/base/memory/large_pages.h"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#endif

namespace capstan {

#ifdef __linux__
void ask_for_large_pages(void* memory, std::size_t bytes) {
  if (memory == nullptr || bytes < 2 * kLargePage) return;
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const auto from = (begin + page - 1) / page * page, to = (begin + bytes) / page * page;
  (void)::madvise(reinterpret_cast<void*>(from), to - from, MADV_HUGEPAGE);
}
#else
void ask_for_large_pages(void*, std::size_t) {}
#endif

}  // namespace capstan
