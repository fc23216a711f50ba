#!/usr/bin/env python3
"""Digits of the 12-point rule of degree 6 on the triangle (Dunavant 1985, doi 10.1002/nme.1620210612).

Newton's method on the moment equations, from the six digits that identify the rule, in decimal
arithmetic of 60 digits. The rule has full symmetry: orbits (b, b, 1-2b), (c, c, 1-2c) and
(d, e, 1-d-e) with weights u, v, w per point. It is exact for all polynomials of degree 6 iff it is
for the seven invariants e2^i e3^j, 2i + 3j <= 6, of the barycentric coordinates. Prints the values
used in quadrature.cpp; the weights are for area 1.
"""
from decimal import Decimal, getcontext
from fractions import Fraction
from math import factorial

getcontext().prec = 60
INVARIANTS = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (3, 0), (0, 2)]
START = ["0.116786", "0.249287", "0.050845", "0.063089", "0.082851", "0.053145", "0.310352"]


def times(f, g):
    h = {}
    for a, x in f.items():
        for b, y in g.items():
            key = tuple(i + j for i, j in zip(a, b))
            h[key] = h.get(key, 0) + x * y
    return h


def moment(i, j):
    """Mean of e2^i e3^j: the mean of l0^a l1^b l2^c is 2 a! b! c! / (a+b+c+2)!."""
    f = {(0, 0, 0): 1}
    for _ in range(i):
        f = times(f, {(1, 1, 0): 1, (1, 0, 1): 1, (0, 1, 1): 1})
    f = times(f, {(j, j, j): 1})
    return sum(
        x * Fraction(2 * factorial(a) * factorial(b) * factorial(c), factorial(a + b + c + 2))
        for (a, b, c), x in f.items()
    )


MOMENTS = [moment(i, j) for i, j in INVARIANTS]


def residual(x):
    u, b, v, c, w, d, e = x
    result = []
    for (i, j), m in zip(INVARIANTS, MOMENTS):
        total = -Decimal(m.numerator) / Decimal(m.denominator)
        for count, weight, (p, q, r) in (
            (3, u, (b, b, 1 - 2 * b)),
            (3, v, (c, c, 1 - 2 * c)),
            (6, w, (d, e, 1 - d - e)),
        ):
            total += count * weight * (p * q + q * r + r * p) ** i * (p * q * r) ** j
        result.append(total)
    return result


def solve(A, b):
    """Gaussian elimination with row pivoting."""
    n = len(b)
    M = [row[:] + [y] for row, y in zip(A, b)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda r: abs(M[r][k]))
        M[k], M[pivot] = M[pivot], M[k]
        for r in range(k + 1, n):
            factor = M[r][k] / M[k][k]
            M[r] = [y - factor * z for y, z in zip(M[r], M[k])]
    x = [Decimal(0)] * n
    for k in reversed(range(n)):
        x[k] = (M[k][n] - sum(M[k][c] * x[c] for c in range(k + 1, n))) / M[k][k]
    return x


def main():
    x = [Decimal(s) for s in START]
    step_size = Decimal(10) ** -20  # central differences: far below the digits, far above rounding
    for _ in range(12):
        columns = []
        for k in range(7):
            plus, minus = x[:], x[:]
            plus[k] += step_size
            minus[k] -= step_size
            columns.append(
                [(p - m) / (2 * step_size) for p, m in zip(residual(plus), residual(minus))]
            )
        jacobian = [[columns[c][r] for c in range(7)] for r in range(7)]
        step = solve(jacobian, residual(x))
        x = [a - s for a, s in zip(x, step)]
    assert max(abs(r) for r in residual(x)) < Decimal(10) ** -50
    for label, value in zip("u b v c w d e".split(), x):
        print(f"{label} = {value:.22f}")


if __name__ == "__main__":
    main()
