/* Sphericity: the area of the ball that has the volume of the shape, over the area of the shape. 1 for a
 * ball, less for everything else:
 *
 *     psi = pi^(1/3) (6 V)^(2/3) / A
 *
 * A measure built outside the tree: it includes nothing but <vesica/...>. README.md says how to build it. */
#include <math.h>
#include <vesica/measure.h>

static const double PI = 3.14159265358979323846;

/* V is the flux of X / 3 through patches and caps. A cap is a flat fan about the mean point c of an end
 * curve: its triangles (c, X, X + Xv dv) have the vector area (X - c) x Xv dv / 2. */
typedef struct sums {
    double area, volume;
} sums;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int c = 0; c < 3; c++) out[c] = a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
}

static void mean_point(const ves_samples *cap, double mean[3])
{
    for (int c = 0; c < 3; c++) {
        mean[c] = 0;
        for (int n = 0; n < cap->count; n++) mean[c] += cap->X[c][n] * cap->weight[n] / (2 * PI);
    }
}

/* One spoke of the fan. */
typedef struct spoke {
    double X[3], Xv[3], arm[3], twice[3], length; /* twice: (X - c) x Xv */
} spoke;

static spoke spoke_at(const ves_samples *cap, int n, const double mean[3])
{
    spoke k;
    for (int c = 0; c < 3; c++) k.X[c] = cap->X[c][n], k.Xv[c] = cap->Xv[c][n], k.arm[c] = k.X[c] - mean[c];
    cross(k.arm, k.Xv, k.twice);
    k.length = sqrt(dot(k.twice, k.twice));
    return k;
}

static void add_cap(const ves_samples *cap, sums *sum)
{
    double mean[3];
    mean_point(cap, mean);
    for (int n = 0; n < cap->count; n++) {
        spoke k = spoke_at(cap, n, mean);
        sum->area += cap->weight[n] / 2 * k.length;
        sum->volume += cap->weight[n] / 6 * cap->side * dot(mean, k.twice); /* mean . X x Xv */
    }
}

static void add_patch(const ves_samples *s, sums *sum)
{
    for (int n = 0; n < s->count; n++) {
        double flux =
            s->X[0][n] * s->normal[0][n] + s->X[1][n] * s->normal[1][n] + s->X[2][n] * s->normal[2][n];
        sum->area += s->dA[n];
        sum->volume += flux * s->dA[n] / 3;
    }
}

static sums measure(const ves_measure_input *input)
{
    sums sum = {0, 0};
    for (int i = 0; i < input->samples; i++) {
        if (input->sample[i]->site == VES_SITE_CAP)
            add_cap(input->sample[i], &sum);
        else
            add_patch(input->sample[i], &sum);
    }
    return sum;
}

/* A positive status says that this candidate has no such number; the search goes on. */
static ves_status eval(const ves_measure_input *input, double *value)
{
    sums sum = measure(input);
    if (!(sum.volume > 0)) return VES_INVERTED;
    *value = cbrt(36 * PI * sum.volume * sum.volume) / sum.area;
    return VES_OK;
}

/* Transpose of add_patch: each sum is linear in each of the planes X, normal, dA. */
static void back_patch(const ves_samples *s, sums back, const ves_adjoint *g)
{
    for (int n = 0; n < s->count; n++) {
        g->dA[n] += back.area;
        for (int c = 0; c < 3; c++) {
            g->dA[n] += back.volume / 3 * s->X[c][n] * s->normal[c][n];
            g->X[c][n] += back.volume / 3 * s->normal[c][n] * s->dA[n];
            g->normal[c][n] += back.volume / 3 * s->X[c][n] * s->dA[n];
        }
    }
}

/* Transpose of add_cap. d twice = d arm x Xv + arm x d Xv, so that `twice` hands its adjoint t on as Xv x t
 * to arm and as t x arm to Xv; arm = X - mean, and the mean is a sum over all nodes. */
static void back_cap(const ves_samples *s, sums back, const ves_adjoint *g)
{
    double mean[3], mean_back[3] = {0, 0, 0};
    mean_point(s, mean);
    for (int n = 0; n < s->count; n++) {
        spoke k = spoke_at(s, n, mean);
        double w = s->weight[n], flux = back.volume * w / 6 * s->side, t[3], to_arm[3], to_Xv[3];
        double stretch = k.length > 0 ? back.area * w / 2 / k.length : 0;
        for (int c = 0; c < 3; c++) t[c] = stretch * k.twice[c] + flux * mean[c];
        cross(k.Xv, t, to_arm);
        cross(t, k.arm, to_Xv);
        for (int c = 0; c < 3; c++) {
            g->X[c][n] += to_arm[c];
            g->Xv[c][n] += to_Xv[c];
            mean_back[c] += flux * k.twice[c] - to_arm[c];
        }
    }
    for (int n = 0; n < s->count; n++)
        for (int c = 0; c < 3; c++) g->X[c][n] += mean_back[c] * s->weight[n] / (2 * PI);
}

/* d psi = psi (2/3 dV / V - dA / A), handed to the planes. Adds to them: other measures do so too. */
static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint; /* this measure has no keys */
    sums sum = measure(input);
    double psi = cbrt(36 * PI * sum.volume * sum.volume) / sum.area;
    sums back = {.area = -seed * psi / sum.area, .volume = seed * psi * 2 / (3 * sum.volume)};
    for (int i = 0; i < input->samples; i++) {
        if (!adjoint[i]->X[0]) continue; /* depends on no variable */
        if (input->sample[i]->site == VES_SITE_CAP)
            back_cap(input->sample[i], back, adjoint[i]);
        else
            back_patch(input->sample[i], back, adjoint[i]);
    }
}

static const ves_measure sphericity = {
    .name = "sphericity",
    .about = "area of the ball of the same volume over the area, caps included; 1 for a ball",
    .unit = "1",
    .degree = 0, /* of no size */
    .surface = VES_X | VES_NORMAL | VES_AREA,
    .cap = VES_X | VES_XV,
    .closed = true,
    .eval = eval,
    .gradient = gradient,
};

static const ves_measure *const list[] = {&sphericity, NULL};

/* What vesica looks for in the shared object. */
extern const ves_plugin ves_plugin_entry;
const ves_plugin ves_plugin_entry = {VES_PLUGIN, "sphericity", list};
