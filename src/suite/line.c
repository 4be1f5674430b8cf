#include "suite/line.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "base/arena.h"
#include "base/text.h"

enum { CHUNK = 65536, STEP_MS = 100, LONGEST = 16 * 1024 * 1024 };

/* --- the process --- */

/* The child after the fork: a group of its own, to be ended as a whole, and an end with vesica's. */
static void become(const char *const *word, int theirs, int fault, pid_t parent)
{
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* one that hangs would outlive a vesica that is killed */
#endif
    setpgid(0, 0);
    if (getppid() == parent && dup2(theirs, 0) == 0 && dup2(theirs, 1) == 1)
        execvp(word[0], (char *const *)word);
    int error = errno;
    if (write(fault, &error, sizeof error) < 0) _exit(126);
    _exit(127);
}

/* The socket of faults is closed by a successful exec. */
static int spawn(ves_line *line, const char *const *word, int theirs)
{
    int fault[2], error = 0;
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, fault)) return errno;
    pid_t parent = getpid(), child = fork();
    if (!child) become(word, theirs, fault[1], parent);
    if (child < 0) error = errno;
    close(fault[1]);
    while (child > 0 && recv(fault[0], &error, sizeof error, MSG_WAITALL) < 0 && errno == EINTR) continue;
    close(fault[0]);
    if (child > 0 && error) waitpid(child, NULL, 0);
    if (child > 0 && !error) line->child = child;
    return error;
}

int ves_line_open(ves_line *line, const char *const *word)
{
    int pair[2];
    *line = (ves_line){.socket = -1};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair)) return errno;
    int error = spawn(line, word, pair[1]);
    close(pair[1]);
    if (error)
        close(pair[0]);
    else
        line->socket = pair[0];
    return error;
}

/* Not waited for yet: its number, and that of its group, stay its own until then. */
static bool ended(const ves_line *line)
{
    siginfo_t info = {.si_pid = 0};
    return !waitid(P_PID, (id_t)line->child, &info, WEXITED | WNOHANG | WNOWAIT) && info.si_pid;
}

int ves_line_close(ves_line *line, double seconds)
{
    int status = 0;
    if (line->socket >= 0) shutdown(line->socket, SHUT_WR);
    for (int k = 0; line->child && !ended(line) && k * STEP_MS < 1000 * seconds; k++)
        poll(NULL, 0, k ? STEP_MS : 10);
    if (line->child) {
        kill((pid_t)-line->child, SIGKILL);
        waitpid((pid_t)line->child, &status, 0);
    }
    if (line->socket >= 0) close(line->socket);
    ves_memory_free(line->text);
    *line = (ves_line){.socket = -1};
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

/* --- lines --- */

static bool make_room(ves_line *line)
{
    if (line->room - line->length > CHUNK) return true;
    size_t room = 2 * line->room + 2 * CHUNK;
    char *more = ves_memory_grow(line->text, room);
    if (!more) return false;
    line->text = more;
    line->room = room;
    return true;
}

/* The line handed out last makes place. */
static void drop(ves_line *line)
{
    if (!line->taken) return;
    memmove(line->text, line->text + line->taken, line->length - line->taken);
    line->length -= line->taken;
    line->taken = 0;
}

static bool whole(ves_line *line, size_t from, char **text)
{
    char *end = line->length > from ? memchr(line->text + from, '\n', line->length - from) : NULL;
    if (!end) return false;
    *end = 0;
    line->taken = (size_t)(end - line->text) + 1;
    *text = line->text;
    return true;
}

ves_line_end ves_line_read(ves_line *line, double seconds, bool (*stopped)(void *), void *data, char **text)
{
    drop(line);
    if (whole(line, 0, text)) return VES_LINE_DONE;
    for (long waited = 0; (double)waited < 1000 * seconds;) {
        struct pollfd wait = {.fd = line->socket, .events = POLLIN};
        if (stopped && stopped(data)) return VES_LINE_STOPPED;
        if (poll(&wait, 1, STEP_MS) <= 0) {
            waited += STEP_MS;
            continue;
        }
        if (!make_room(line)) return VES_LINE_MEMORY;
        ssize_t got = recv(line->socket, line->text + line->length, CHUNK, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return VES_LINE_CLOSED;
        size_t from = line->length;
        line->length += (size_t)got;
        if (whole(line, from, text)) return VES_LINE_DONE;
        if (line->length > LONGEST) return VES_LINE_LONG;
    }
    return VES_LINE_LATE;
}

ves_line_end ves_line_write(ves_line *line, double seconds, bool (*stopped)(void *), void *data,
                            const char *text, size_t length)
{
    for (long waited = 0; length && (double)waited < 1000 * seconds;) {
        struct pollfd wait = {.fd = line->socket, .events = POLLOUT};
        if (stopped && stopped(data)) return VES_LINE_STOPPED;
        ssize_t sent = send(line->socket, text, length, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent > 0) {
            text += sent;
            length -= (size_t)sent;
            waited = 0;
        } else if (sent < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
            if (poll(&wait, 1, STEP_MS) <= 0) waited += STEP_MS;
        } else if (!(sent < 0 && errno == EINTR)) {
            return VES_LINE_CLOSED;
        }
    }
    return length ? VES_LINE_LATE : VES_LINE_DONE;
}

/* --- what a line says: JSON [RFC 8259] --- */

enum { DEEP = 64 };

static const char *blank(const char *at)
{
    return at + strspn(at, " \t\r");
}

/* Behind a text in quotes, or NULL. */
static const char *quoted(const char *at)
{
    if (*at++ != '"') return NULL;
    for (; *at && *at != '"'; at++)
        if (*at == '\\' && at[1]) at++;
    return *at ? at + 1 : NULL;
}

static const char *digits(const char *at)
{
    size_t count = strspn(at, "0123456789");
    return count ? at + count : NULL;
}

/* Behind a number as JSON writes it (no .5, no 5., no 05), or NULL. */
static const char *numeral(const char *at)
{
    if (*at == '-') at++;
    at = *at == '0' ? at + 1 : digits(at);
    if (at && *at == '.') at = digits(at + 1);
    if (!at || (*at != 'e' && *at != 'E')) return at;
    return digits(at + 1 + (at[1] == '-' || at[1] == '+'));
}

static const char *number(const char *at, double *out)
{
    char word[64] = "";
    const char *end = numeral(at);
    if (!end || (size_t)(end - at) >= sizeof word) return NULL;
    memcpy(word, at, (size_t)(end - at));
    return ves_text_number(word, out) ? end : NULL;
}

/* Behind one of the words, or NULL. */
static const char *named(const char *at)
{
    static const char *const word[] = {"true", "false", "null"};
    for (int k = 0; k < 3; k++)
        if (!strncmp(at, word[k], strlen(word[k]))) return at + strlen(word[k]);
    return NULL;
}

/* What comes between two members: behind a comma that another follows, or at the end. NULL: neither. */
static const char *next(const char *at, char end)
{
    at = blank(at);
    if (*at == end) return at;
    if (*at != ',') return NULL;
    at = blank(at + 1);
    return *at == end ? NULL : at;
}

/* Behind "key": , or NULL. */
static const char *keyed(const char *at)
{
    at = quoted(at);
    if (at) at = blank(at);
    return at && *at == ':' ? blank(at + 1) : NULL;
}

/* Behind any value, or NULL. */
static const char *value(const char *at, int depth)
{
    char end = *at == '[' ? ']' : '}';
    if (*at == '"') return quoted(at);
    if (*at != '[' && *at != '{') return named(at) ? named(at) : numeral(at);
    if (depth == DEEP) return NULL;
    for (at = blank(at + 1); at && *at != end;) {
        if (end == '}') at = keyed(at);
        if (at) at = value(at, depth + 1);
        if (at) at = next(at, end);
    }
    return at ? at + 1 : NULL;
}

static const char *numbers(const char *at, int n, double *u, int *count)
{
    *count = 0;
    if (*at++ != '[') return NULL;
    for (at = blank(at); at && *at != ']';) {
        double x;
        at = number(at, &x);
        if (!at) return NULL;
        if (*count < n) u[*count] = x;
        ++*count;
        at = next(at, ']');
    }
    return at ? at + 1 : NULL;
}

static const char *flag(const char *at, bool *out)
{
    *out = *at == 't';
    return *at == 't' || *at == 'f' ? named(at) : NULL;
}

/* Done is what a program says with anything but false. */
static const char *done(const char *at, bool *out)
{
    *out = *at != 'f';
    return value(at, 0);
}

static bool is(const char *key, const char *word)
{
    size_t length = strlen(word);
    return !strncmp(key + 1, word, length) && key[1 + length] == '"';
}

bool ves_request_read(const char *text, int n, double *u, ves_request *request)
{
    *request = (ves_request){.count = -1};
    const char *at = blank(text);
    if (*at++ != '{') return false;
    for (at = blank(at); at && *at != '}';) {
        const char *key = at;
        at = keyed(at);
        if (at && is(key, "ask"))
            at = numbers(at, n, u, &request->count);
        else if (at && is(key, "gradient"))
            at = flag(at, &request->gradient);
        else if (at)
            at = is(key, "done") ? done(at, &request->done) : value(at, 0);
        if (at) at = next(at, '}');
    }
    return at && !*blank(at + 1) && (request->done || request->count >= 0);
}
