/* What a program may say. */
#include <criterion/criterion.h>

#include "suite/line.h"

Test(suite_line, requests)
{
    static const struct {
        const char *text;
        bool good, done, gradient;
        int count;
    } list[] = {
        {"{\"ask\": [0.5, 1e-3]}", true, false, false, 2},
        {"{\"ask\":[0.5,0.25],\"gradient\":true}", true, false, true, 2},
        {" { \"gradient\" : false , \"ask\" : [ 0.5 , 1 ] } \r", true, false, false, 2},
        {"{\"note\": {\"a\": [1, \"]}\"], \"b\": null}, \"ask\": [0, 1], \"x\": -1.5e3}", true, false, false,
         2},
        {"{\"ask\": []}", true, false, false, 0},
        {"{\"ask\": [1, 2, 3]}", true, false, false, 3},
        {"{\"done\": true}", true, true, false, -1},
        {"{\"done\": {\"why\": \"a \\\"quoted\\\" word\"}}", true, true, false, -1},
        {"", false, false, false, 0},
        {"{}", false, false, false, 0},
        {"hello", false, false, false, 0},
        {"{\"ask\": [0.5, nan]}", false, false, false, 0},
        {"{\"ask\": [0.5, null]}", false, false, false, 0},
        {"{\"ask\": [0.5, 0.5}", false, false, false, 0},
        {"{\"ask\": [0.5, 0.5]", false, false, false, 0},
        {"{\"ask\": 3}", false, false, false, 0},
        {"{\"ask\": [0.5], \"gradient\": 1}", false, false, false, 0},
        {"{\"ask\": [0.5]} {\"ask\": [0.5]}", false, false, false, 0},
        {"{\"done", false, false, false, 0},
        {"{\"done\": [1", false, false, false, 0},
        {"{\"done\": ]}", false, false, false, 0},
        {"{\"ask\": [0.5, 0.25], \"done\": false}", true, false, false, 2},
        {"{\"done\": true, \"ask\": [0.5, 0.25]}", true, true, false, 2},
        {"{\"ask\": [-0.5e-2, 0, 1E+0]}", true, false, false, 3},
        {"{\"done\": false}", false, false, false, 0},
        {"{\"ask\": [0.5 0.5]}", false, false, false, 0},
        {"{\"ask\": [0.5, 0.5,]}", false, false, false, 0},
        {"{\"ask\": [.5, 0.5]}", false, false, false, 0},
        {"{\"ask\": [5., 0.5]}", false, false, false, 0},
        {"{\"ask\": [05, 0.5]}", false, false, false, 0},
        {"{\"ask\": [+1, 0.5]}", false, false, false, 0},
        {"{\"ask\": [0.5], }", false, false, false, 0},
        {"{\"ask\": [0.5] \"a\": 1}", false, false, false, 0},
        {"{\"a\": [1 2], \"ask\": [0.5]}", false, false, false, 0},
        {"{\"a\": word, \"ask\": [0.5]}", false, false, false, 0},
        {"[1]", false, false, false, 0},
    };
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        double u[2] = {-1, -1};
        ves_request r;
        bool good = ves_request_read(list[k].text, 2, u, &r);
        cr_expect(good == list[k].good, "%s: got %d", list[k].text, good);
        if (!good || !list[k].good) continue;
        cr_expect(r.done == list[k].done && r.gradient == list[k].gradient && r.count == list[k].count,
                  "%s: done %d, gradient %d, %d numbers", list[k].text, r.done, r.gradient, r.count);
    }
}
