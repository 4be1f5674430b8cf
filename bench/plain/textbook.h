/* The plain baseline: a biharmonic patch as a textbook writes it down, [Ugail 2011, eqs 4.11-4.14], evaluated
 * node by node with calls of cos, sin and exp and no tables. */
#ifndef VES_BENCH_TEXTBOOK_H
#define VES_BENCH_TEXTBOOK_H

enum { TEXTBOOK_MODES = 6 };

/* Coefficients of one patch: of mode n (n >= 1) a_n1 .. a_n4 and b_n1 .. b_n4 for each coordinate; of mode 0
 * the cubic a_00 .. a_03. */
typedef struct textbook {
    double a; /* smoothing parameter */
    double zero[3][4], cosine[TEXTBOOK_MODES][3][4], sine[TEXTBOOK_MODES][3][4];
} textbook;

/* Solves for the coefficients: data[j][c][1 + 2 modes] are the modes of X(0), X_u(0), X(1), X_u(1). */
void textbook_solve(textbook *book, double a, const double *data[4]);

/* Area, flux of X / 3 and integral of k1^2 + k2^2 with Gauss nodes u, weights w, and nv trapezoid nodes. */
void textbook_measure(const textbook *book, int nu, const double *u, const double *w, int nv, double out[3]);

#endif
