/* Ctrl-C, and what else asks a program to end: SIGTERM, a terminal that is closed. The one mutable static of vesica: a signal handler may write nothing but a volatile sig_atomic_t
 * that it can name. */
#include <signal.h>

#include "app/app.h"

static volatile sig_atomic_t asked;

static void hear(int signal_number)
{
    (void)signal_number;
    asked = 1;
}

/* SA_RESETHAND: the second signal finds the default, which kills. */
void app_interrupt_listen(void)
{
    struct sigaction action = {.sa_handler = hear, .sa_flags = (int)(SA_RESETHAND | SA_RESTART)};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
}

bool app_interrupt_asked(void)
{
    return asked;
}
