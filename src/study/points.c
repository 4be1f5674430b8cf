#include "study/points.h"

#include <errno.h>
#include <string.h>

#include "base/arena.h"
#include "base/diag.h"
#include "base/text.h"

enum { LINE = 256, FIRST = 1024 };

static bool keep(ves_points *p, double u, double v)
{
    if (p->count == p->room) {
        int room = p->room ? 2 * p->room : FIRST;
        double *pu = ves_memory_grow(p->u, sizeof *pu * (size_t)room);
        if (pu) p->u = pu;
        double *pv = ves_memory_grow(p->v, sizeof *pv * (size_t)room);
        if (pv) p->v = pv;
        if (!pu || !pv) return false;
        p->room = room;
    }
    p->u[p->count] = u;
    p->v[p->count++] = v;
    return true;
}

static char *trimmed(char *text)
{
    size_t length = strlen(text);
    while (length && strchr(" \t\r\n", text[length - 1])) text[--length] = 0;
    return text + strspn(text, " \t");
}

/* The next line without its end. whole: false where it has more bytes than fit, or one that is 0: what is
 * read of such a line is not what stands there. */
static bool line_read(FILE *in, char line[LINE], bool *whole)
{
    int c, length = 0;
    *whole = true;
    while ((c = getc(in)) != EOF && c != '\n')
        if (c && length < LINE - 1)
            line[length++] = (char)c;
        else
            *whole = false;
    line[length] = 0;
    return c != EOF || length || !*whole;
}

/* "u, v": two numbers. */
static bool pair(char *line, double *u, double *v)
{
    char *comma = strchr(line, ',');
    if (!comma) return false;
    *comma = 0;
    return ves_text_number(trimmed(line), u) && ves_text_number(trimmed(comma + 1), v);
}

/* The one heading that says what the columns are: u,v in this order. */
static bool is_heading(const char *line)
{
    static const char mark[] = "\xEF\xBB\xBF"; /* of UTF-8, which spreadsheets put first */
    char word[4] = "";
    if (!strncmp(line, mark, 3)) line += 3;
    size_t count = 0;
    for (; *line; line++)
        if (!strchr(" \t\"", *line)) {
            if (count == 3) return false;
            word[count++] = *line;
        }
    return strlen(word) == 3 && strchr("uU", word[0]) && word[1] == ',' && strchr("vV", word[2]);
}

ves_status ves_points_read(FILE *in, const char *name, ves_points *p, ves_diag *diag)
{
    char line[LINE], shown[LINE];
    bool whole;
    const ves_mark nowhere = {0};
    *p = (ves_points){0};
    for (int number = 1; line_read(in, line, &whole); number++) {
        double u, v;
        char *text = trimmed(line);
        memcpy(shown, text, strlen(text) + 1);
        if (!whole)
            return ves_diag_add(
                diag, VES_ERROR, VES_SYNTAX, nowhere,
                "%s:%d: two numbers u,v are needed, found a line of %d bytes or more, or no text", name,
                number, LINE);
        if (!*text) continue;
        bool good = pair(text, &u, &v);
        if (number == 1 && is_heading(shown)) continue;
        if (!good)
            return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, nowhere,
                                "%s:%d: two numbers u,v are needed, found \"%s\"", name, number, shown);
        if (!(u >= 0 && u <= 1))
            return ves_diag_add(
                diag, VES_ERROR, VES_RANGE, nowhere,
                "%s:%d: u = %g lies outside the patch (0 to 1); these u and v are not those of a domain",
                name, number, u);
        if (!keep(p, u, v)) return ves_diag_fail(diag, VES_MEMORY);
    }
    if (ferror(in))
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, nowhere, "cannot read \"%s\": %s", name,
                            strerror(errno));
    if (!p->count)
        return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, nowhere,
                            "\"%s\" has no points: one u,v a line is needed", name);
    return VES_OK;
}

void ves_points_free(ves_points *p)
{
    ves_memory_free(p->u);
    ves_memory_free(p->v);
}
