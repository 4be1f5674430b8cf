#include "search/schedule/schedule.h"

/* The book's schedule  c_m = c_0 e^{(s-1) m},  0 < s < 1  [Ugail 2011, eq 7.3], once. */

static bool begin(ves_cooling *cooling)
{
    if (cooling->leg) return false;
    ves_cooling_begin(cooling, cooling->c0, cooling->left);
    return true;
}

static bool next(ves_cooling *cooling, const ves_temperature *seen)
{
    (void)seen;
    return ves_cooling_next(cooling);
}

const ves_schedule ves_schedule_book = {
    .name = "book",
    .about = "c_m = c0 e^((s-1) m), once: the book's",
    .begin = begin,
    .next = next,
};
