/* vesica eval: one design, measured. */
#include "app/app.h"
#include "study/result.h"

static void json_print(const ves_run *run)
{
    ves_json json = {.out = stdout};
    ves_json_object(&json, NULL);
    ves_result_design(run->problem, &run->best, &json);
    ves_json_end(&json, '}');
}

int app_eval(app *a)
{
    ves_opened opened;
    ves_run *run;
    int code;
    if (!app_open(a, &opened, &code)) return code;
    const ves_run_options options = {.once = true};
    ves_status status = ves_run_create(opened.problem, &options, NULL, &run, a->diag);
    app_say(a);
    code = app_code(status);
    if (run) {
        if (a->options.json)
            json_print(run);
        else
            app_screen_design(run->problem, &run->best, &run->finer, stdout);
        code = run->feasible ? APP_DONE : APP_UNMET;
        ves_run_destroy(run);
    }
    ves_study_close(&opened);
    return code;
}
