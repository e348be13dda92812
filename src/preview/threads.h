/* Work that several threads do at once. */
#ifndef PREVIEW_THREADS_H
#define PREVIEW_THREADS_H

#include <stdatomic.h>

enum { THREADS_MOST = 256 };

/* How many share so many pieces out among them; wanted: 0 is one a core. */
int threads_count(int wanted, int pieces);

/* What each of them does, numbered from 0: it takes pieces until there are none left, so that one more or one fewer
 * changes nothing but the time. */
typedef void threads_work(void *user, int thread);

/* Returns when all are done. The calling thread is number 0; one that the system refuses leaves its share to the
 * others. */
void threads_run(int count, threads_work *work, void *user);

/* The same for pieces 0 to count - 1 that any thread may take. */
typedef void threads_piece(void *user, int index);
void threads_each(int wanted, int count, threads_piece *piece, void *user);

#endif
