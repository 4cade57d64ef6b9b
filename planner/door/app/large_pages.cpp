#include "planner/door/app/large_pages.h"

#if defined(__linux__) && defined(__GLIBC__)
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#endif

namespace capstan::app {

#if defined(__linux__) && defined(__GLIBC__)
void ask_for_large_pages() {
  // A block this large is mapped apart; that it is freed tells glibc to take the next one from the heap, and
  // not to give the heap back at once (mallopt(3), M_MMAP_THRESHOLD).
  void* volatile apart = std::malloc(kStartOfHeap + 1);  // volatile, or the compiler leaves out both calls
  std::free(apart);
  void* const block = std::malloc(kStartOfHeap);
  if (block == nullptr) return;
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto from = (reinterpret_cast<std::uintptr_t>(block) + page - 1) / page * page;
  const auto to = (reinterpret_cast<std::uintptr_t>(block) + kStartOfHeap) / page * page;
  (void)madvise(reinterpret_cast<void*>(from), to - from, MADV_HUGEPAGE);
  std::free(block);
}
#else
void ask_for_large_pages() {}
#endif

}  // namespace capstan::app
