/* How far a result can be trusted, as the screen and result.json tell it. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "program.h"

/* A can of 150 ml. Free: A = 6 pi r^2, V = 2 pi r^3, dA/dV = 2/r, r = 28.794 mm. r at most 20 mm: A = 2 pi r^2 + 2 V/r,
 * dA/dr = 4 pi r - 2 V/r^2. */
static void can_write(const char *name, const char *most, const char *constraints)
{
    char text[1500];
    snprintf(
        text, sizeof text,
        "vesica: 1\nvariables: {r: [10 mm, 15 mm, %s], h: [10 mm, 40 mm, 200 mm]}\n"
        "curves:\n  floor: {point: [0 mm, 0 mm, 0 mm]}\n  lid: {point: [0 mm, 0 mm, h]}\n"
        "  low: {circle: {radius: r}}\n  high: {like: low, apply: [{translate: [0 mm, 0 mm, h]}]}\n"
        "patches:\n"
        "  base: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: floor}, {u: 1, position: low}]}\n"
        "  wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: high}]}\n"
        "  top: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: high}, {u: 1, position: lid}]}\n"
        "shape: {closed: true}\nminimize: area + 0 cm^2\nconstraints: [%s]\n",
        most, constraints);
    write_file(name, text);
}

static void says(const char *text, const char *const *word)
{
    for (; *word; word++) cr_expect(strstr(text, *word) != NULL, "no \"%s\" in\n%s", *word, text);
}

Test(cli_honest, the_screen_tells_what_limits_cost_and_how_often_the_best_was_found)
{
    root_make();
    can_write("can.yaml", "60 mm", "volume >= 150 ml");
    outcome o = vesica(NULL, "run can.yaml --no-files --jobs 1");
    says(o.out,
         (const char *const[]){"volume >= 150 ml: 1 ml more costs 0.6946 cm^2\n",
                               "of the objective's is left\n", " evaluations; the best by ", "starts ",
                               "verdict    converged; all of ", "of the box leads to unseen ones\n", NULL});
    cr_expect(strstr(o.out, "not unique") == NULL);
    done(&o);
    can_write("slim.yaml", "20 mm", "volume >= 150 ml");
    o = vesica(NULL, "run slim.yaml --no-files --jobs 1");
    says(o.out,
         (const char *const[]){"r stands at its upper bound 20 mm: 1 mm higher gains 4.987 cm^2\n", NULL});
    done(&o);
    can_write("twice.yaml", "60 mm", "volume >= 150 ml, volume >= 0.15 l");
    o = vesica(NULL, "run twice.yaml --no-files --jobs 1");
    says(o.out, (const char *const[]){"these prices are not unique", NULL});
    done(&o);
    o = vesica(NULL, "run can.yaml --no-files --jobs 1 --evaluations 4000");
    cr_expect(strstr(o.out, "starts ") == NULL, "a given budget is spent by the strategies that search:\n%s",
              o.out);
    done(&o);
    root_remove();
}

Test(cli_honest, the_result_holds_the_same_for_programs)
{
    root_make();
    can_write("slim.yaml", "20 mm", "volume >= 150 ml");
    outcome o = vesica(NULL, "run slim.yaml --no-files --jobs 1 --json");
    json j = json_of(o.out);
    const double r = 0.02, V = 150e-6, PI = 3.14159265358979323846;
    const ves_node *kkt = ves_node_find(j.root, "kkt"), *limit = ves_node_find(kkt, "constraints")->item[0],
                   *bound = ves_node_find(kkt, "bounds")->item[0],
                   *strategy = ves_node_find(j.root, "strategies");
    cr_expect(eq(str, (char *)ves_node_find(limit, "text")->text, "volume >= 150 ml"));
    cr_expect(fabs(atof(ves_node_find(limit, "rate")->text) / (2 / r) - 1) < 1e-6); /* dA/dV at fixed r */
    cr_expect(eq(str, (char *)ves_node_find(limit, "unit")->text, "1/m"));
    cr_expect(eq(str, (char *)ves_node_find(bound, "variable")->text, "r"));
    cr_expect(eq(str, (char *)ves_node_find(bound, "side")->text, "upper"));
    cr_expect(fabs(atof(ves_node_find(bound, "rate")->text) / (4 * PI * r - 2 * V / (r * r)) - 1) < 1e-6);
    cr_expect(eq(str, (char *)ves_node_find(kkt, "unique")->text, "true"));
    cr_expect(atof(ves_node_find(kkt, "residual")->text) < 1e-6);
    cr_expect(eq(str, (char *)ves_node_find(ves_node_find(j.root, "evidence"), "verdict")->text, "repeated"));
    cr_expect(number(&j, "evidence", "hits") >= 10 && number(&j, "evidence", "unseen") < 0.01);
    double all = 0;
    for (int k = 0; k < strategy->count; k++)
        all += atof(ves_node_find(strategy->item[k], "evaluations")->text);
    cr_expect(all > 0 && all <= number(&j, "evaluations", NULL), "%g", all);
    json_done(&j);
    done(&o);
    root_remove();
}
