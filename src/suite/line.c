#include "suite/line.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/text.h"

extern char **environ;

enum { CHUNK = 65536, STEP_MS = 100, LONGEST = 16 * 1024 * 1024 };

/* --- the process --- */

static int spawn(ves_line *line, const char *const *word, int theirs)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    pid_t child;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, theirs, 0);
    posix_spawn_file_actions_adddup2(&files, theirs, 1);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP); /* its own group, to be ended as a whole */
    posix_spawnattr_setpgroup(&attributes, 0);
    int error = posix_spawnp(&child, word[0], &files, &attributes, (char *const *)word, environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    if (!error) line->child = child;
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
    if (whole(line, 0, text)) return VES_LINE_READ;
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
        if (whole(line, from, text)) return VES_LINE_READ;
        if (line->length > LONGEST) return VES_LINE_LONG;
    }
    return VES_LINE_LATE;
}

bool ves_line_write(ves_line *line, const char *text, size_t length)
{
    while (length) {
        ssize_t sent = send(line->socket, text, length, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        text += sent;
        length -= (size_t)sent;
    }
    return true;
}

/* --- what a line says --- */

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

/* Behind any value, or NULL: brackets are counted, not checked. */
static const char *value(const char *at)
{
    int depth = 0;
    do {
        at = blank(at);
        if (*at == '"') {
            at = quoted(at);
            if (!at) return NULL;
            continue;
        }
        if (*at == '[' || *at == '{') depth++;
        if (*at == ']' || *at == '}') depth--;
        if (!*at || depth < 0) return NULL;
        if (strchr("[]{},:", *at))
            at++;
        else
            at += strcspn(at, "[]{},:\" \t\r");
    } while (depth > 0);
    return at;
}

static const char *number(const char *at, double *out)
{
    char word[64] = "";
    size_t length = strcspn(at, ",] \t\r");
    if (length >= sizeof word) return NULL;
    memcpy(word, at, length);
    return ves_text_number(word, out) ? at + length : NULL;
}

static const char *numbers(const char *at, int n, double *u, int *count)
{
    *count = 0;
    if (*at++ != '[') return NULL;
    for (at = blank(at); *at && *at != ']'; at = blank(at)) {
        double x;
        at = number(at, &x);
        if (!at) return NULL;
        if (*count < n) u[*count] = x;
        ++*count;
        at = blank(at);
        if (*at == ',') at++;
    }
    return *at ? at + 1 : NULL;
}

static const char *flag(const char *at, bool *out)
{
    *out = !strncmp(at, "true", 4);
    return *out ? at + 4 : !strncmp(at, "false", 5) ? at + 5 : NULL;
}

static bool is(const char *key, const char *end, const char *word)
{
    return (size_t)(end - key) == strlen(word) + 2 && !strncmp(key + 1, word, strlen(word));
}

bool ves_request_read(const char *text, int n, double *u, ves_request *request)
{
    *request = (ves_request){.count = -1};
    const char *at = blank(text);
    if (*at++ != '{') return false;
    for (at = blank(at); *at && *at != '}'; at = blank(at)) {
        const char *key = at;
        const char *end = quoted(at);
        at = end ? blank(end) : "";
        if (*at != ':') return false;
        at = blank(at + 1);
        if (is(key, end, "ask"))
            at = numbers(at, n, u, &request->count);
        else if (is(key, end, "gradient"))
            at = flag(at, &request->gradient);
        else
            at = value(at);
        if (is(key, end, "done")) request->done = true;
        if (!at) return false;
        at = blank(at);
        if (*at == ',') at++;
    }
    return *at == '}' && !*blank(at + 1) && (request->done || request->count >= 0);
}
