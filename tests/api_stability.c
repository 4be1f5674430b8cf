/* Stability by the installed headers alone. */
#include <criterion/criterion.h>
#include <math.h>
#include <string.h>

#include <vesica/vesica.h>

Test(api_stability, a_sphere_whose_membrane_would_rather_be_curved_more)
{
    static const char file[] = "vesica: 1\nparameters: {c: 7}\n"
                               "patches:\n  ball: {surface: {formula: [\"sin(u)*cos(v)\", \"sin(u)*sin(v)\", "
                               "\"cos(u)\"]}, domain: {u: [0, pi]}}\n"
                               "shape: {closed: true}\nquadrature: {u: 16, v: 8}\nmeasures: {E: {canham: "
                               "{reduced_c0: c}}}\nminimize: E\n"
                               "scale: {equation: area == 4*pi}\n";
    ves_problem *problem;
    ves_stability found;
    ves_diag *diag = ves_diag_create();
    cr_assert_eq(ves_problem_read_text("f.yaml", file, strlen(file), NULL, &problem, diag), VES_OK);
    static ves_stability_profile at;
    ves_stability_options options = {.counted = true, .modes = 2, .functions = 24, .profile = &at};
    cr_assert_eq(ves_stability_find(problem, &options, &found, diag), VES_OK);
    cr_expect(found.modes == 3 && found.functions == 24 && found.values == 0);
    cr_expect(found.held == 1 && strcmp(found.holds[0], "area") == 0);
    cr_expect(fabs(found.mode[2].value[0] - (6 - 7) * 4) < 1e-5, "%g", found.mode[2].value[0]);
    cr_expect_str_eq(ves_firmness_text(found.firmness), "unstable");
    cr_assert_gt(at.points, 10);
    const double scale = hypot(at.wr[2][at.points / 2], at.wz[2][at.points / 2]); /* sin^2, of l = n = 2 */
    for (int k = 0; k < at.points; k++) {
        cr_expect(fabs(hypot(at.r[k], at.z[k]) - 1) < 1e-9);
        cr_expect(fabs(hypot(at.wr[2][k], at.wz[2][k]) / scale - at.r[k] * at.r[k]) < 1e-2);
    }
    options.modes = VES_STABILITY_MODES + 1;
    cr_expect_eq(ves_stability_find(problem, &options, &found, diag), VES_RANGE);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}
