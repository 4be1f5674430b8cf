/* The measures of membranes against closed forms, in which what they are made of has no part. */
#include "samples.h"

/* Of some thousand terms. */
static const double ROUNDING = 1e-12;

typedef struct given {
    const char *key;
    double value;
} given;

static double of_body(const char *measure, const body *b, const given *list)
{
    rig r;
    rig_open(&r);
    rig_surface(&r, b, 80, 96);
    rig_measure(&r, measure);
    for (int k = 0; list && list[k].key; k++) rig_number(&r, list[k].key, list[k].value);
    double value = rig_eval(&r);
    rig_close(&r);
    return value;
}

/* E = 8 pi kappa (1 - C0 R / 2)^2 + 4 pi kappa_g. */
Test(measure_membrane, a_sphere)
{
    const double R = 2.385, kappa = 0.7, c0 = 0.31, reduced = 3, kappa_g = -0.4;
    const body ball = body_init(ellipsoid, 1, R, R, R);
    near(of_body("canham", &ball, NULL), 8 * PI, ROUNDING, "c0 = 0");
    near(of_body("canham", &ball, (given[]){{"kappa", kappa}, {"c0", c0}, {"kappa_g", kappa_g}, {NULL, 0}}),
         8 * PI * kappa * pow(1 - c0 * R / 2, 2) + 4 * PI * kappa_g, ROUNDING, "c0");
    near(of_body("canham", &ball, (given[]){{"reduced_c0", reduced}, {NULL, 0}}) / (8 * PI), 0.25, ROUNDING,
         "reduced c0 = 3");
    near(of_body("canham", &ball, (given[]){{"reduced_c0", reduced}, {"c0", c0}, {NULL, 0}}),
         8 * PI * pow(1 - (c0 * R + reduced) / 2, 2), ROUNDING, "both");
    near(of_body("canham", &ball, (given[]){{"c0", 2 / R}, {NULL, 0}}), 0, ROUNDING,
         "the sphere it would be");
    near(of_body("reduced_volume", &ball, NULL), 1, ROUNDING, "reduced volume");
    near(of_body("area_difference", &ball, NULL), 1, ROUNDING, "area difference");
    near(of_body("ade", &ball, (given[]){{"kappa", kappa}, {"alpha", 1.4}, {"m0", 1.2}, {NULL, 0}}) /
             (8 * PI * kappa),
         1 + PI * 1.4 * 0.04, ROUNDING, "area-difference elasticity");
}

/* 2 H = 1 / r, and no Gaussian curvature; inside out H changes its sign. */
Test(measure_membrane, a_tube)
{
    const double r = 0.731, h = 1.713, c0 = 0.31, R0 = sqrt(r * h / 2);
    for (int side = -1; side <= 1; side += 2) {
        const body tube = body_init(frustum, -side, r, r, h);
        near(of_body("canham", &tube, (given[]){{"c0", c0}, {"kappa_g", 5}, {NULL, 0}}),
             PI * h / r * pow(side - c0 * r, 2), ROUNDING, "canham");
        near(of_body("area_difference", &tube, NULL), side * h / (4 * R0), ROUNDING, "area difference");
    }
}

/* Clifford's torus 2 pi^2 kappa [Willmore 1965, Marques and Neves 2014], no matter of kappa_g: genus 1. */
Test(measure_membrane, a_torus)
{
    const double r = 0.731, R = sqrt(2) * r;
    const body ring = body_init(torus, -1, R, r, 0);
    near(of_body("canham", &ring, (given[]){{"kappa_g", 7}, {NULL, 0}}), 4 * PI * PI, ROUNDING, "Clifford");
    near(of_body("reduced_volume", &ring, NULL),
         6 * sqrt(PI) * 2 * PI * PI * R * r * r / pow(4 * PI * PI * R * r, 1.5), ROUNDING, "torus");
}

/* Of an oblate spheroid a, a, c with e^2 = 1 - c^2/a^2: A = 2 pi a^2 (1 + (1 - e^2)/e artanh e), V = 4 pi/3 a^2 c, and
 * integral of H dA = 2 pi (c + a asin(e) / e). */
Test(measure_membrane, a_spheroid)
{
    const double a = 1.3, c = 0.6, e = sqrt(1 - c * c / (a * a));
    const double A = 2 * PI * a * a * (1 + (1 - e * e) / e * atanh(e)), R0 = sqrt(A / (4 * PI));
    const body b = body_init(ellipsoid, 1, a, a, c);
    near(of_body("reduced_volume", &b, NULL), a * a * c / (R0 * R0 * R0), ROUNDING, "reduced volume");
    near(of_body("area_difference", &b, NULL), 2 * PI * (c + a * asin(e) / e) / (4 * PI * R0), ROUNDING,
         "area difference");
}

/* Energies with reduced numbers do not depend on the size. */
Test(measure_membrane, reduced_numbers_have_no_size)
{
    const given numbers[] = {{"kappa", 0.7}, {"reduced_c0", 1.9}, {"kappa_g", 0.2}, {NULL, 0}};
    const body b = body_init(ellipsoid, 1, 1.3, 0.9, 0.6), big = body_init(ellipsoid, 1, 1300, 900, 600);
    near(of_body("canham", &b, numbers), of_body("canham", &big, numbers), ROUNDING, "canham");
    near(of_body("reduced_volume", &b, NULL), of_body("reduced_volume", &big, NULL), ROUNDING, "volume");
    near(of_body("area_difference", &b, NULL), of_body("area_difference", &big, NULL), ROUNDING,
         "difference");
}

/* With alpha = 0 the leaflets slide freely. */
Test(measure_membrane, ade_is_canham_and_a_square)
{
    const body b = body_init(ellipsoid, 1, 1.3, 0.9, 0.6);
    const given free[] = {{"kappa", 0.7}, {"c0", 0.4}, {"alpha", 0}, {"m0", 3}, {NULL, 0}};
    const given stiff[] = {{"kappa", 0.7}, {"c0", 0.4}, {"alpha", 1.4}, {"m0", 3}, {NULL, 0}};
    const double M = of_body("area_difference", &b, NULL);
    const double energy = of_body("canham", &b, (given[]){{"kappa", 0.7}, {"c0", 0.4}, {NULL, 0}});
    near(of_body("ade", &b, free), energy, ROUNDING, "alpha = 0");
    near(of_body("ade", &b, stiff), energy + 8 * PI * PI * 1.4 * 0.7 * pow(M - 3, 2), ROUNDING,
         "alpha = 1.4");
}

static double adhesion(const body *b, double at, double range)
{
    rig r;
    rig_open(&r);
    rig_surface(&r, b, 60, 64);
    rig_measure(&r, "adhesion");
    rig_vector(&r, "at", 5, 7, at);
    rig_vector(&r, "normal", 0, 0, 3);
    rig_number(&r, "w", 0.8);
    rig_number(&r, "range", range);
    double value = rig_eval(&r);
    rig_close(&r);
    return value;
}

/* On a sphere of radius R around 0, dA = 2 pi R dz: with t = exp(at / range) and x = R / range the integral is
 * 2 pi R range (t^2 sinh(2 x) - 4 t sinh(x)). */
Test(measure_membrane, a_sphere_over_a_plane)
{
    const double R = 1.385, w = 0.8;
    const body ball = body_init(ellipsoid, 1, R, R, R);
    for (int k = 0; k < 4; k++) {
        double at = -1.385 - 0.2 * k, range = 0.4 + 0.5 * k, t = exp(at / range), x = R / range;
        near(adhesion(&ball, at, range), w * 2 * PI * R * range * (t * t * sinh(2 * x) - 4 * t * sinh(x)),
             ROUNDING, "Morse");
    }
}

static double line(const body *b, double u, int nodes)
{
    rig r;
    rig_open(&r);
    rig_ring(&r, b, u, nodes, 0);
    rig_measure(&r, "line_tension");
    rig_number(&r, "sigma", 0.6);
    rig_key(&r, "curve")->given = true;
    double value = rig_eval(&r);
    rig_close(&r);
    return value;
}

/* A circle of 3 nodes; the equator of an ellipsoid, of one mode: 4 a E(m), m = 1 - (b/a)^2 = 3/4, E = 1.211056027568459
 * [Abramowitz and Stegun 1972, table 17.1, to more digits]. */
Test(measure_membrane, lines)
{
    const body round = body_init(ellipsoid, 1, 1.3, 1.3, 0.6), flat = body_init(ellipsoid, 1, 2, 1, 1);
    for (int nodes = 3; nodes < 30; nodes += 4) {
        near(line(&round, 0.5, nodes), 0.6 * 2 * PI * 1.3, ROUNDING, "circle");
        near(line(&flat, 0.5, nodes), 0.6 * 4 * 2 * 1.211056027568459, ROUNDING, "ellipse");
    }
}
