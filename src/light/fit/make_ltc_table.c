/* Writes src/light/ltc_table.c to standard output and the residual of every fit to standard error.
 *
 *     build/release/bin/make_ltc_table > src/light/ltc_table.c 2> residuals.csv
 */
#include <math.h>
#include <stdio.h>

#include "ltc_fit.h"

static void write_row(const ltc_fit row[LTC_FIT_SIDE])
{
    printf("        {\n");
    for (int j = 0; j < LTC_FIT_SIDE; j++)
        printf("            { %.6eF, %.6eF, %.6eF, %.6eF, %.6eF, %.6eF },\n", row[j].p[0], row[j].p[1], row[j].p[2],
               row[j].albedo, row[j].schlick, row[j].facets);
    printf("        },\n");
}

int main(void)
{
    static const char *const names[] = { "GGX", "Beckmann" };
    printf("/* Made by src/light/fit/make_ltc_table.c, which says how. Do not edit. */\n"
           "#include \"light/ltc.h\"\n\n"
           "/* clang-format off */\n"
           "const float ltc_table[2][LTC_SIDE][LTC_SIDE][LTC_STRIDE] = {\n");
    fprintf(stderr, "distribution,alpha,view_deg,residual\n");
    for (int d = 0; d < 2; d++) {
        printf("    { /* %s */\n", names[d]);
        for (int i = 0; i < LTC_FIT_SIDE; i++) {
            ltc_fit row[LTC_FIT_SIDE];
            ltc_fit_row(d, ltc_fit_alpha(i), row);
            write_row(row);
            for (int j = 0; j < LTC_FIT_SIDE; j++)
                fprintf(stderr, "%s,%.6g,%.2f,%.4f\n", names[d], ltc_fit_alpha(i),
                        acos(ltc_fit_cosine(j)) * 57.29577951308232, row[j].residual);
        }
        printf("    },\n");
    }
    printf("};\n");
    return 0;
}
