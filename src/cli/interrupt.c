/* Ctrl-C ends long work cleanly the first time and kills the process the second time. */
#include "cli/interrupt.h"

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>

/* A signal handler reaches nothing but objects of static life: state of the command that nobody passes on. */
static atomic_bool interrupted;
static volatile sig_atomic_t caught_signal;

static void on_signal(int number)
{
    caught_signal = number;
    atomic_store(&interrupted, true);
}

static void catch_once(int number)
{
    struct sigaction old;
    if (sigaction(number, NULL, &old) != 0 || old.sa_handler == SIG_IGN)
        return;
    /* SA_RESETHAND: the second one meets the default action. SA_RESTART: reading the scene goes on meanwhile. */
    struct sigaction once = { .sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND | SA_RESTART };
    sigemptyset(&once.sa_mask);
    sigaction(number, &once, NULL);
}

const atomic_bool *interrupt_watch(void)
{
    static bool watching;
    if (!watching) {
        watching = true;
        catch_once(SIGINT);
        catch_once(SIGTERM);
    }
    return &interrupted;
}

int interrupt_exit_code(void)
{
    return caught_signal == 0 ? 0 : 128 + (int)caught_signal;
}
