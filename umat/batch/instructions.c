/* The instruction sets of the processor, of those that the kernel of the batch is compiled for. */
#include "batch.h"

int hypofab_batch_best_instructions(void) {
#ifdef HYPOFAB_BATCH_X86
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
      return BATCH_AVX512;
    return BATCH_AVX2;
  }
#endif
  return BATCH_PORTABLE;
}
