#include "planner/door/app/large_pages.h"

#if defined(__linux__) && defined(__GLIBC__)
#include <cstdlib>

#include "planner/ground/base/memory/large_pages.h"
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
  capstan::ask_for_large_pages(block, kStartOfHeap);
  std::free(block);
}
#else
void ask_for_large_pages() {}
#endif

}  // namespace capstan::app
