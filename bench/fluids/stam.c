/* Fluids in the square as in Stam's program for games (2003), in doubles: n x n cells with a ring around, sweeps of Gauss and Seidel.
   Usage: stam N STEPS SWEEPS VISCOSITY DIFFUSIVITY DT. Prints seconds of processor time per step and the kinetic energy. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define IX(i, j) ((i) + (n + 2) * (j))

static int n, sweeps;

static double *field(void) { return calloc((size_t)(n + 2) * (n + 2), sizeof(double)); }

static void set_bnd(int b, double *x) {
    for (int i = 1; i <= n; i++) {
        x[IX(0, i)] = b == 1 ? -x[IX(1, i)] : x[IX(1, i)];
        x[IX(n + 1, i)] = b == 1 ? -x[IX(n, i)] : x[IX(n, i)];
        x[IX(i, 0)] = b == 2 ? -x[IX(i, 1)] : x[IX(i, 1)];
        x[IX(i, n + 1)] = b == 2 ? -x[IX(i, n)] : x[IX(i, n)];
    }
    x[IX(0, 0)] = 0.5 * (x[IX(1, 0)] + x[IX(0, 1)]);
    x[IX(0, n + 1)] = 0.5 * (x[IX(1, n + 1)] + x[IX(0, n)]);
    x[IX(n + 1, 0)] = 0.5 * (x[IX(n, 0)] + x[IX(n + 1, 1)]);
    x[IX(n + 1, n + 1)] = 0.5 * (x[IX(n, n + 1)] + x[IX(n + 1, n)]);
}

static void solve(int b, double *x, const double *x0, double a, double c) {
    for (int k = 0; k < sweeps; k++) {
        for (int j = 1; j <= n; j++)
            for (int i = 1; i <= n; i++)
                x[IX(i, j)] =
                    (x0[IX(i, j)] + a * (x[IX(i - 1, j)] + x[IX(i + 1, j)] + x[IX(i, j - 1)] + x[IX(i, j + 1)])) / c;
        set_bnd(b, x);
    }
}

static void diffuse(int b, double *x, const double *x0, double rate, double dt) {
    double a = dt * rate * n * n;
    solve(b, x, x0, a, 1 + 4 * a);
}

static void advect(int b, double *d, const double *d0, const double *u, const double *v, double dt) {
    double dt0 = dt * n;
    for (int j = 1; j <= n; j++)
        for (int i = 1; i <= n; i++) {
            double x = i - dt0 * u[IX(i, j)], y = j - dt0 * v[IX(i, j)];
            x = x < 0.5 ? 0.5 : x > n + 0.5 ? n + 0.5 : x;
            y = y < 0.5 ? 0.5 : y > n + 0.5 ? n + 0.5 : y;
            int i0 = (int)x, j0 = (int)y;
            double s1 = x - i0, s0 = 1 - s1, t1 = y - j0, t0 = 1 - t1;
            d[IX(i, j)] = s0 * (t0 * d0[IX(i0, j0)] + t1 * d0[IX(i0, j0 + 1)]) +
                          s1 * (t0 * d0[IX(i0 + 1, j0)] + t1 * d0[IX(i0 + 1, j0 + 1)]);
        }
    set_bnd(b, d);
}

static void project(double *u, double *v, double *p, double *div) {
    double h = 1.0 / n;
    for (int j = 1; j <= n; j++)
        for (int i = 1; i <= n; i++) {
            div[IX(i, j)] = -0.5 * h * (u[IX(i + 1, j)] - u[IX(i - 1, j)] + v[IX(i, j + 1)] - v[IX(i, j - 1)]);
            p[IX(i, j)] = 0;
        }
    set_bnd(0, div);
    set_bnd(0, p);
    solve(0, p, div, 1, 4);
    for (int j = 1; j <= n; j++)
        for (int i = 1; i <= n; i++) {
            u[IX(i, j)] -= 0.5 * (p[IX(i + 1, j)] - p[IX(i - 1, j)]) / h;
            v[IX(i, j)] -= 0.5 * (p[IX(i, j + 1)] - p[IX(i, j - 1)]) / h;
        }
    set_bnd(1, u);
    set_bnd(2, v);
}

int main(int count, char **words) {
    if (count != 7) {
        fprintf(stderr, "usage: stam N STEPS SWEEPS VISCOSITY DIFFUSIVITY DT\n");
        return 2;
    }
    n = atoi(words[1]);
    int steps = atoi(words[2]);
    sweeps = atoi(words[3]);
    double viscosity = atof(words[4]), diffusivity = atof(words[5]), dt = atof(words[6]);
    size_t size = sizeof(double) * (n + 2) * (n + 2);
    double *u = field(), *v = field(), *u0 = field(), *v0 = field(), *d = field(), *d0 = field(), *div = field();
    for (int j = 1; j <= n; j++)
        for (int i = 1; i <= n; i++) {
            double x = (i - 0.5) / n, y = (j - 0.5) / n;
            u[IX(i, j)] = 2 * x * (1 - x) * (1 - 2 * y) * 8 * x * (1 - x) * y * (1 - y);
            v[IX(i, j)] = -2 * y * (1 - y) * (1 - 2 * x) * 8 * x * (1 - x) * y * (1 - y);
            d[IX(i, j)] = x * y;
        }
    clock_t start = clock();
    for (int step = 0; step < steps; step++) {
        memcpy(u0, u, size), memcpy(v0, v, size);
        diffuse(1, u, u0, viscosity, dt), diffuse(2, v, v0, viscosity, dt);
        project(u, v, u0, div);
        memcpy(u0, u, size), memcpy(v0, v, size);
        advect(1, u, u0, u0, v0, dt), advect(2, v, v0, u0, v0, dt);
        project(u, v, u0, div);
        memcpy(d0, d, size);
        diffuse(0, d, d0, diffusivity, dt);
        memcpy(d0, d, size);
        advect(0, d, d0, u, v, dt);
    }
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC, energy = 0;
    for (int j = 1; j <= n; j++)
        for (int i = 1; i <= n; i++) energy += u[IX(i, j)] * u[IX(i, j)] + v[IX(i, j)] * v[IX(i, j)];
    printf("{\"seconds_per_step\": %.6f, \"energy\": %.12g}\n", seconds / steps, 0.5 * energy / n / n);
    return 0;
}
