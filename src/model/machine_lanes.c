/* Which vector width the machine runs. */
#include "model/machine_lanes.h"

size_t machine_lanes(size_t most)
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (most >= 16 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
        return 16;
    if (most >= 8 && __builtin_cpu_supports("avx2"))
        return 8;
    if (most >= 4 && __builtin_cpu_supports("sse4.1"))
        return 4;
#elif defined(__aarch64__)
    if (most >= 4)
        return 4;
#endif
    (void)most;
    return 1;
}
