/* A word to who waits, when a start design takes long: high orders and many modes may. */
#include <errno.h>
#include <signal.h>
#include <unistd.h>

#include "app/app.h"

/* Seconds. As of the progress of a search, a log gets no line of what is short. */
enum { ON_TERMINAL = 2, IN_LOG = 10 };

static void speak(int signal_number)
{
    static const char text[] = "  still at work on the start design\n";
    int kept = errno;
    (void)signal_number;
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0) errno = kept;
}

void app_patience_begin(void)
{
    struct sigaction action = {.sa_handler = speak, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    if (!sigaction(SIGALRM, &action, NULL)) alarm(isatty(STDERR_FILENO) ? ON_TERMINAL : IN_LOG);
}

void app_patience_end(void)
{
    alarm(0);
}
