"""Files as users of PHCpack and of Bertini have them, with answers known from elsewhere.

Written for this in the ways in which such files are written: PHCpack's lines in scientific
notation, with start solutions and titles behind the system; Bertini's sections, settings,
subfunctions, constants and groups. Where solutions are few they are listed, found by hand.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt


@dataclass(frozen=True)
class ForeignFile:
    """A file and its answer.

    Attributes:
        text: what is in it.
        solutions: all isolated solutions with their multiplicities, in the file's order of
            variables, where they are listed.
        count: how many isolated solutions there are, with multiplicities, where they are not.
        components: dimension and degree of each irreducible component, where some are no points.
    """

    text: str
    solutions: tuple[tuple[tuple[complex, ...], int], ...] = ()
    count: int | None = None
    components: tuple[tuple[int, int], ...] = ()


def _simple(*points: tuple[complex, ...]) -> tuple[tuple[tuple[complex, ...], int], ...]:
    return tuple((point, 1) for point in points)


PHCPACK = {
    "two circles": ForeignFile(
        """2
 x**2 + y**2 - 25;
 (x - 6)**2 + y**2 - 25;
""",
        _simple((3, 4), (3, -4)),
    ),
    "scientific notation": ForeignFile(
        """2
 1.00000000000000E+00*x^2 + 2.00000000000000E+00*y^2 - 9.00000000000000E+00;
 -1.00000000000000E+00*x + 2.50000000000000E-01*y + 5.00000000000000E-01;

TITLE : an ellipse and a line
""",
        # x = y/4 + 1/2, so that 33 y^2 + 4 y - 140 is zero.
        _simple((1, 2), (-1 / 33, -70 / 33)),
    ),
    "complex coefficients": ForeignFile(
        """2 2
 x^2 - (3.0 + 4.0*i);
 y - (1 + i)*x;
""",
        _simple((2 + 1j, 1 + 3j), (-2 - 1j, -1 - 3j)),
    ),
    "coefficients with I": ForeignFile(
        """1
x^2 + I*x + 6;
""",
        _simple((2j,), (-3j,)),
    ),
    "more equations": ForeignFile(
        """3 2
 x^2 + y^2 - 5;
 x*y - 2;
 x - y + 1;
""",
        _simple((1, 2), (-2, -1)),
    ),
    "more equations without a common zero": ForeignFile(
        """3 2
 x^2 + y^2 - 5;
 x*y - 2;
 x - y - 7;
""",
        count=0,
    ),
    "a zero of multiplicity three": ForeignFile(
        """2
 29/16*x^3 - 2*x*y;
 y - x^2;
TITLE : Griewank and Osborne (1983)
""",
        (((0, 0), 3),),
    ),
    "double zeros": ForeignFile(
        """2
 (x - 1)^2*(x + 2);
 y - x;
""",
        (((1, 1), 2), ((-2, -2), 1)),
    ),
    "over several lines": ForeignFile(
        """3
 x
   + y
   + z - 6;
 x*y
   + y*z + z*x
   - 11;
 x*y*z - 6;
""",
        _simple((1, 2, 3), (1, 3, 2), (2, 1, 3), (2, 3, 1), (3, 1, 2), (3, 2, 1)),
    ),
    "cyclic 3-roots": ForeignFile(
        """3
 z0 + z1 + z2;
 z0*z1 + z1*z2 + z2*z0;
 z0*z1*z2 - 1;
""",
        count=6,
    ),
    "cyclic 5-roots": ForeignFile(
        """5
 x1 + x2 + x3 + x4 + x5;
 x1*x2 + x2*x3 + x3*x4 + x4*x5 + x5*x1;
 x1*x2*x3 + x2*x3*x4 + x3*x4*x5 + x4*x5*x1 + x5*x1*x2;
 x1*x2*x3*x4 + x2*x3*x4*x5 + x3*x4*x5*x1 + x4*x5*x1*x2 + x5*x1*x2*x3;
 x1*x2*x3*x4*x5 - 1;

TITLE : Bjorck (1985), 70 roots
""",
        count=70,
    ),
    "three species": ForeignFile(
        """3
 1.0*x1*x2^2 + 1.0*x1*x3^2 - 1.1*x1 + 1.0;
 1.0*x2*x1^2 + 1.0*x2*x3^2 - 1.1*x2 + 1.0;
 1.0*x3*x1^2 + 1.0*x3*x2^2 - 1.1*x3 + 1.0;

TITLE : Noonburg (1989), 21 roots
""",
        count=21,
    ),
    "a magnet": ForeignFile(
        """4
 u0 + 2*u1 + 2*u2 + 2*u3 - 1;
 u0**2 + 2*u1**2 + 2*u2**2 + 2*u3**2 - u0;
 2*u0*u1 + 2*u1*u2 + 2*u2*u3 - u1;
 u1**2 + 2*u0*u2 + 2*u1*u3 - u2;
TITLE : Katsura (1990), 8 roots
""",
        count=8,
    ),
    "with start solutions": ForeignFile(
        """2
 x^2 - 4;
 y^3 - x;

THE SOLUTIONS :
6 2
===========================================================
solution 1 :    start residual :  0.000E+00   #iterations : 1   success
t :  0.00000000000000E+00   0.00000000000000E+00
m : 1
the solution for t :
 x :  1.00000000000000E+00   0.00000000000000E+00
 y :  1.00000000000000E+00   0.00000000000000E+00
== err :  0.000E+00 = rco :  1.000E+00 = res :  0.000E+00 =
""",
        count=6,
    ),
    "a space curve": ForeignFile(
        """2 3
 y - x^2;
 z - x^3;
""",
        components=((1, 3),),
    ),
    "a curve and points": ForeignFile(
        """2
 (x^2 + y^2 - 1)*(x - 2);
 (x^2 + y^2 - 1)*(y - 2);
""",
        components=((1, 2), (0, 1)),
    ),
    "names with underscores": ForeignFile(
        """2
 alpha_1*beta_2 - 12;
 alpha_1 + beta_2 - 7;
""",
        _simple((3, 4), (4, 3)),
    ),
    "an order by differences": ForeignFile(
        """2 2
 y - y + x - x + x^2 - 1;
 y - 3*x;
""",
        _simple((3, 1), (-3, -1)),
    ),
    "eigenvectors": ForeignFile(
        """3
 2*a + b - lambda*a;
 a + 2*b - lambda*b;
 a + 2*b - 1;
TITLE : eigenvalues 3 and 1
""",
        _simple((1 / 3, 1 / 3, 3), (-1, 1, 1)),
    ),
    "Caprasse": ForeignFile(
        """4
 y**2*z + 2*x*y*t - 2*x - z;
 -x**3*z + 4*x*y**2*z + 4*x**2*y*t + 2*y**3*t + 4*x**2 - 10*y**2 + 4*x*z - 10*y*t + 2;
 2*y*z*t + x*t**2 - x - 2*z;
 -x*z**3 + 4*y*z**2*t + 4*x*z*t**2 + 2*y*t**3 + 4*x*z + 4*z**2 - 10*y*t - 10*t**2 + 2;
TITLE : 24 regular roots, 8 of multiplicity 4
""",
        count=56,
    ),
}

BERTINI = {
    "circle and line": ForeignFile(
        """CONFIG
END;
INPUT
variable_group x, y;
function f, g;
f = x^2 + y^2 - 25;
g = x - y - 1;
END;
""",
        _simple((4, 3), (-3, -4)),
    ),
    "settings and comments": ForeignFile(
        """% a file with settings of the tracker
CONFIG
TRACKTYPE: 0;        % isolated solutions
MPTYPE: 2;
FINALTOL: 1e-11;     % as sharp as that
SecurityLevel: 1;
END;
INPUT
% variables
variable_group x;
function f;
f = (x - 1)*(x - 2)*(x - 3)*(x + 4); % four
END;
""",
        _simple((1,), (2,), (3,), (-4,)),
    ),
    "without CONFIG": ForeignFile(
        """INPUT
variable_group x, y;
function p1, p2;
p1 = x*y - 2;
p2 = x + y - 3;
END;
""",
        _simple((1, 2), (2, 1)),
    ),
    "declarations alone": ForeignFile(
        """variable_group x, y;
function f, g;
f = x^2 - 1;
g = y - 2*x;
""",
        _simple((1, 2), (-1, -2)),
    ),
    "constants": ForeignFile(
        """CONFIG
END;
INPUT
variable_group x, y;
constant a, b, c;
function f, g;
a = 3;
b = 1/4;
c = a*b;
f = x^2 - a^2;
g = y - c*x;
END;
""",
        _simple((3, 9 / 4), (-3, -9 / 4)),
    ),
    "complex constants": ForeignFile(
        """CONFIG
END;
INPUT
variable_group z, w;
constant gamma;
gamma = 1 + 2*I;
function f, g;
f = z^2 - gamma^2;
g = w - I*z;
END;
""",
        _simple((1 + 2j, -2 + 1j), (-1 - 2j, 2 - 1j)),
    ),
    "subfunctions": ForeignFile(
        """CONFIG
END;
INPUT
variable_group x, y;
function f, g;
r2 = x^2 + y^2;
d = x - y;
f = r2 - 2;
g = r2*d + d^3;
END;
""",
        # (x - y)(r2 + (x - y)^2): on the circle (x - y)^2 is 0, or -2 where x y is 2.
        _simple(
            (1, 1),
            (-1, -1),
            *(
                ((s + t) / 2, (s - t) / 2)
                for s in (sqrt(6), -sqrt(6))
                for t in (1j * sqrt(2), -1j * sqrt(2))
            ),
        ),
    ),
    "two groups": ForeignFile(
        """CONFIG
END;
INPUT
variable_group x, y;
variable_group lambda;
function f, g, h;
f = 2*x + y - lambda*x;
g = x + 2*y - lambda*y;
h = x + 2*y - 1;
END;
""",
        _simple((1 / 3, 1 / 3, 3), (-1, 1, 1)),
    ),
    "homogeneous variables": ForeignFile(
        """CONFIG
END;
INPUT
hom_variable_group x0, x1, x2;
function f, g;
f = x1^2 - 4*x0^2;
g = x2^2 - 9*x0*x1;
END;
""",
        count=4,
    ),
    "scientific numbers": ForeignFile(
        """CONFIG
END;
INPUT
variable_group x, y;
function f1, f2;
f1 = 1.0e0*x^2 - 2.25E+00;
f2 = y - 2.0e-1*x;
END;
""",
        _simple((1.5, 0.3), (-1.5, -0.3)),
    ),
    "pi": ForeignFile(
        """CONFIG
END;
INPUT
variable_group x, y;
constant t;
t = Pi/6;
function f, g;
f = x^2 - 4*sin(t)^2;
g = y - cos(2*t)*x;
END;
""",
        _simple((1, 0.5), (-1, -0.5)),
    ),
    "more functions than variables": ForeignFile(
        """CONFIG
END;
INPUT
variable_group x, y;
function f, g, h;
f = x^2 - y;
g = y^2 - x;
h = x*y - 1;
END;
""",
        _simple(
            (1, 1),
            (complex(-0.5, sqrt(3) / 2), complex(-0.5, -sqrt(3) / 2)),
            (complex(-0.5, -sqrt(3) / 2), complex(-0.5, sqrt(3) / 2)),
        ),
    ),
    "a surface's singular line": ForeignFile(
        """CONFIG
TrackType: 1;
END;
INPUT
variable_group x, y, z;
function f, g;
f = x*y;
g = x*z;
END;
""",
        components=((2, 1), (1, 1)),
    ),
    "twisted cubic": ForeignFile(
        """CONFIG
TrackType:1;
END;
INPUT
variable_group x,y,z;
function f,g;
f = y-x^2;
g = z-x*y;
END;
""",
        components=((1, 3),),
    ),
    "sphere, curve and points": ForeignFile(
        """% the illustrative example of numerical decomposition
CONFIG
TrackType: 1;
END;
INPUT
variable_group x, y, z;
function f1, f2, f3;
S = x^2 + y^2 + z^2 - 1;
T = y - x^2;
U = z - x^3;
f1 = T*S*(x - 0.5);
f2 = U*S*(y - 0.5);
f3 = T*U*S*(z - 0.5);
END;
""",
        # The sphere, three lines, the twisted cubic, a point.
        components=((2, 2), (1, 1), (1, 1), (1, 1), (1, 3), (0, 1)),
    ),
    "start points behind": ForeignFile(
        """CONFIG
END;
INPUT
variable_group x;
function f;
f = x^3 - 1;
END;
3

1 0;
-0.5 0.8660254037844386;
-0.5 -0.8660254037844386;
""",
        count=3,
    ),
    "definitions over lines": ForeignFile(
        """CONFIG
END;
INPUT
variable_group x,
               y;
function f,
         g;
f = x^2
    + x*y
    - 6;
g = y
    - 1;
END;
""",
        _simple((2, 1), (-3, 1)),
    ),
    "names with brackets": ForeignFile(
        """CONFIG
END;
INPUT
variable_group x[1], x[2];
function f[1], f[2];
f[1] = x[1]*x[2] - 12;
f[2] = x[1] + x[2] - 7;
END;
""",
        _simple((3, 4), (4, 3)),
    ),
    "a parameter with its value": ForeignFile(
        """CONFIG
END;
INPUT
variable_group x;
parameter p, q;
p = 5;
q = 6;
function f;
f = x^2 - p*x + q;
END;
""",
        _simple((2,), (3,)),
    ),
    "double zero": ForeignFile(
        """CONFIG
MPType: 0;
END;
INPUT
variable_group x, y;
function f, g;
f = (x - 2)^2;
g = y*(y - x);
END;
""",
        (((2, 0), 2), ((2, 2), 2)),
    ),
}

FOREIGN = {"phc": PHCPACK, "bertini": BERTINI}
FILES = {format: [f.text for f in files.values()] for format, files in FOREIGN.items()}
