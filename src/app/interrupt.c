/* Ctrl-C, and what else asks a program to end: SIGTERM, a terminal that is closed. The one mutable static of
 * vesica: a signal handler may write nothing but a volatile sig_atomic_t that it can name. */
#include <signal.h>

#include "app/app.h"

static volatile sig_atomic_t asked;

static void hear(int signal_number)
{
    (void)signal_number;
    asked = 1;
}

/* SA_RESETHAND: the second signal finds the default, which kills. What the caller ignores (nohup, a script's
 * &) stays ignored. */
void app_interrupt_listen(void)
{
    struct sigaction action = {.sa_handler = hear, .sa_flags = (int)(SA_RESETHAND | SA_RESTART)};
    static const int end[] = {SIGINT, SIGTERM, SIGHUP};
    sigemptyset(&action.sa_mask);
    for (int k = 0; k < 3; k++) {
        struct sigaction old;
        if (!sigaction(end[k], NULL, &old) && old.sa_handler != SIG_IGN) sigaction(end[k], &action, NULL);
    }
}

bool app_interrupt_asked(void)
{
    return asked;
}
