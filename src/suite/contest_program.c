/* A program of one's own as a method: JSON lines through its stdin and stdout (docs/benchmark.md). */
#include "suite/contest.h"

ves_status ves_contest_program(ves_contest *contest)
{
    ves_contest_fail(contest, "programs are not run yet");
    return VES_OK;
}
