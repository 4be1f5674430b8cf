/* Vectors of three numbers, and pi. */
#ifndef VES_BASE_VECTOR_H
#define VES_BASE_VECTOR_H

#define VES_PI     3.14159265358979323846
#define VES_TWO_PI 6.28318530717958647693

static inline double ves_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* out must be neither a nor b. */
static inline void ves_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* (b - a) x (c - a): twice the vector area of a triangle. */
static inline void ves_twice_area(const double a[3], const double b[3], const double c[3], double out[3])
{
    const double p[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                 q[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    ves_cross(p, q, out);
}

#endif
