/* Threads that take pieces of work off a counter until there are none. */
#include "preview/threads.h"

#include <pthread.h>
#include <unistd.h>

int threads_count(int wanted, int pieces)
{
    long count = wanted > 0 ? wanted : sysconf(_SC_NPROCESSORS_ONLN);
    count = count < THREADS_MOST ? count : THREADS_MOST;
    count = count < pieces ? count : pieces;
    return count > 1 ? (int)count : 1;
}

typedef struct helper {
    threads_work *work;
    void *user;
    int number;
    pthread_t thread;
} helper;

static void *run(void *argument)
{
    const helper *const h = argument;
    h->work(h->user, h->number);
    return NULL;
}

void threads_run(int count, threads_work *work, void *user)
{
    helper helpers[THREADS_MOST];
    int started = 1;
    for (; started < count; ++started) {
        helpers[started] = (helper){ .work = work, .user = user, .number = started };
        if (pthread_create(&helpers[started].thread, NULL, run, &helpers[started]) != 0)
            break;
    }
    work(user, 0);
    for (int i = 1; i < started; ++i)
        pthread_join(helpers[i].thread, NULL);
}

typedef struct pieces {
    threads_piece *piece;
    void *user;
    int count;
    atomic_int next;
} pieces;

static void take_pieces(void *user, int thread)
{
    pieces *const p = user;
    (void)thread;
    for (int i; (i = atomic_fetch_add(&p->next, 1)) < p->count;)
        p->piece(p->user, i);
}

void threads_each(int wanted, int count, threads_piece *piece, void *user)
{
    pieces p = { .piece = piece, .user = user, .count = count };
    atomic_init(&p.next, 0);
    threads_run(threads_count(wanted, count), take_pieces, &p);
}
