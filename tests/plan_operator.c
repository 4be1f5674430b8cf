/* Exact gradients with respect to every number that the equation of a patch can hold: operators, the remainder,
 * conditions of any order and place, raised orders, spines, joins. */
#include <criterion/criterion.h>

#include "gradient.h"

#define HEAD                                                                                                 \
    "vesica: 1\nquadrature: {u: 16, v: 32}\n"                                                                \
    "variables: {q: [-2, 0.37, 2], w: [0.1, 0.83, 3]}\n"                                                     \
    "curves:\n"                                                                                              \
    "  low: {ellipse: {radii: [1.1, 0.9 + 0.1*w]}}\n"                                                        \
    "  mid: {ellipse: {radii: [1.3, 1.2], centre: [0.1, 0, 1]}}\n"                                           \
    "  high: {bspline: {points: [[1.2 + 0.1*q, 0, 2], [0, 1.1, 2 + 0.1*q], [-1 - 0.1*w, 0, 2], [0, -1.2, "   \
    "2]]}}\n"                                                                                                \
    "  up: {formula: [\"0.1*cos(v)\", \"0.2*sin(v)\", \"1.4\"]}\n"                                           \
    "  in: {formula: [\"-cos(v)\", \"-sin(v)\", \"0.1\"]}\n"                                                 \
    "patches:\n  wall:\n"
#define FOUR                                                                                                 \
    "    conditions: [{u: 0, position: low}, {u: 0, derivative: 1, field: up, scale: 1 + 0.1*q}, {u: 1, "    \
    "position: high}, {u: 1, derivative: 1, field: up}]\n"
#define SIX                                                                                                  \
    "    conditions: [{u: 0, position: low}, {u: 0, derivative: 1, field: up}, {u: 0, derivative: 2, "       \
    "field: "                                                                                                \
    "in, scale: q}, {u: 1, position: high}, {u: 1, derivative: 1, field: up, scale: w}, {u: 1, derivative: " \
    "2, differences: [low, mid, high]}]\n"
#define GOAL                                                                                                 \
    "validity: {jacobian: any}\nminimize: bending + 0.3*area*w - 0.2*mean_curvature + 0.1*gauss_curvature "  \
    "+ willmore*q\n"

static const char *const CASE[] = {
    /* powers 1 to 5, at the ends and inside */
    HEAD "    operator: {power: 1, a: 0.5 + w}\n    conditions: [{u: 0, position: low}, {u: 1, position: "
         "high}]\n" GOAL,
    HEAD "    operator: {power: 2, a: 0.5 + 0.4*w}\n" FOUR GOAL,
    HEAD "    operator: {power: 3, a: 0.5 + 0.4*w}\n" SIX GOAL,
    HEAD "    operator: {power: 3, a: 3 + w}\n" SIX GOAL,
    HEAD
    "    operator: {power: 2, a: 0.3 + 0.2*w}\n    conditions: [{u: 0, position: low}, {u: 0.4, position: "
    "mid}, {u: 0.7, derivative: 1, field: up, scale: w}, {u: 1, position: high}]\n" GOAL,
    HEAD
    "    operator: {power: 5, a: 0.3 + 0.2*w}\n    conditions: [{u: 0, position: low}, {u: 0, derivative: 1, "
    "field: up, scale: w}, {u: 0, derivative: 2, field: in}, {u: 0, derivative: 3, field: up}, {u: 0.5, "
    "position: mid}, {u: 0.5, derivative: 1, field: up}, {u: 1, position: high}, {u: 1, derivative: 1, "
    "field: "
    "up}, {u: 1, derivative: 2, field: in}, {u: 1, derivative: 4, field: in, scale: q}]\n" GOAL,
    /* coefficients: real and distinct, repeated, complex roots; orders 2, 4, 6 */
    HEAD "    operator: {coefficients: [1 + 0.1*q, 0.7 + w]}\n    conditions: [{u: 0, position: low}, {u: 1, "
         "position: high}]\n" GOAL,
    HEAD "    operator: {coefficients: [1 + 0.1*q, 3 + 0.1*w, 0.7 + 0.2*w]}\n" FOUR GOAL,
    HEAD "    operator: {coefficients: [1, 2*0.83*w, w^2]}\n" FOUR GOAL,
    HEAD "    operator: {coefficients: [1, 0.3*w, 0.7 + 0.2*q]}\n" FOUR GOAL,
    HEAD "    operator: {coefficients: [1, 3*w, 3*w^2, w^3 + 0.01*q]}\n" SIX GOAL,
    HEAD "    operator: {coefficients: [20 + q, 60, 60*w, 2000*w]}\n" SIX GOAL,
    HEAD "    operator: {x: [1, 2 + w, 1], y: [1, 2, 1 + 0.1*q], z: [1 + 0.1*w, 0.5, 0.3]}\n" FOUR GOAL,
    /* the remainder */
    HEAD "    operator: {power: 2, a: 0.5 + 0.4*w}\n    remainder: {modes: 2, omega: auto}\n" FOUR GOAL,
    HEAD "    operator: {power: 2, a: 0.5 + 0.4*w}\n    remainder: {modes: 2, omega: 2 + q*w}\n" FOUR GOAL,
    HEAD "    operator: {power: 3, a: 0.5}\n    remainder: {modes: 1, omega: 2 + w}\n" SIX GOAL,
    HEAD "    operator: {x: [1, 2 + w, 1], y: [1, 2, 1 + 0.1*q], z: [1 + 0.1*w, 0.5, 0.3]}\n    remainder: "
         "{modes: "
         "2, omega: auto}\n" FOUR GOAL,
    /* raised orders */
    HEAD "    operator: {power: 2, a: 0.5 + 0.4*w}\n" FOUR
         "    raise: [{u: 0, derivative: 2, field: in, scale: q}, {u: 0.5, field: in, scale: 0.1*w}]\n" GOAL,
    /* spines */
    HEAD "    operator: {power: 2, a: 0.5 + 0.4*w}\n" FOUR
         "    spine: {hermite: [[q, 0.1*w, 2], [0, 0.3*q*w, 1 + w]]}\n" GOAL,
    HEAD "    operator: {power: 2, a: 0.5 + 0.4*w}\n" FOUR
         "    spine: {bspline: [[0.1*q, 0.1*w, 0.5], [0, 0.2*q, 1 + 0.1*w], [0.1, 0, 1.5*w]]}\n" GOAL,
};

Test(plan_operator, gradients_agree_with_differences)
{
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; k++) gradient_check(CASE[k]);
}
