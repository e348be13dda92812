/* Which vector width the machine runs. */
#include "preview/kernels.h"

const kernels *kernels_of_machine(int most)
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (most >= 8 && __builtin_cpu_supports("avx512f"))
        return &kernels_8;
    if (most >= 4 && __builtin_cpu_supports("avx2"))
        return &kernels_4;
#endif
    return most >= 2 ? &kernels_2 : &kernels_1;
}
