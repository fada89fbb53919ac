#include "lightproof/core/heap.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace lightproof {

void keep_no_freed_memory() {
#ifdef __GLIBC__
  constexpr int kFromTheSystem = 128 << 10;  // bytes: glibc's own threshold, but fixed
  mallopt(M_MMAP_THRESHOLD, kFromTheSystem);
#endif
}

void give_back_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace lightproof
