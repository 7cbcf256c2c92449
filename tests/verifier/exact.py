"""Signs of determinants and nothing else, in whole numbers: no rounding anywhere."""

from math import gcd


def whole(rows):
    """The rows, all times one power of two, as whole numbers: every finite float is one then."""
    ratios = [[float(number).as_integer_ratio() for number in row] for row in rows]
    most = max((below for row in ratios for _, below in row), default=1)
    return [tuple(above * (most // below) for above, below in row) for row in ratios]


def reduced(ray):
    """The same direction in the smallest whole numbers."""
    common = gcd(*ray)
    return tuple(number // common for number in ray) if common else ray


def determinant(a, b, c):
    return (a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0]))


def turn(a, b, c):
    """Positive where three points of the plane run counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
