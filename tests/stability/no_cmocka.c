/* What cmocka's fail() calls, for a program that is built where there is no cmocka. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

void print_error(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
}

void _fail(const char *file, const int line)
{
    fprintf(stderr, "%s:%d: failed\n", file, line);
    exit(1);
}
