/* Ctrl-C ends long work cleanly the first time and kills the process the second time. */
#ifndef CLI_INTERRUPT_H
#define CLI_INTERRUPT_H

#include <stdatomic.h>

/* The first call catches SIGINT and SIGTERM once each, unless the parent has them ignored (as nohup and background jobs
 * do). The result turns true with the first one and lives as long as the process. */
const atomic_bool *interrupt_watch(void);

/* 128 + the number of the signal that came, as shells count (130 for SIGINT, 143 for SIGTERM); 0 when none came. */
int interrupt_exit_code(void);

#endif
