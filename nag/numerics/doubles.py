"""What doubles hold: their rounding and their range, and how well points in them are known.

The accuracies are relative to the point's size, and those of Newton's last step there. What is
known less well than a decision asks for is worked out in more digits (`nag.numerics.digits`).
"""

# Largest relative error of a number that is rounded to a double, and the distance from 1 to the
# next one.
UNIT = 2.0**-53
EPS = 2 * UNIT
# Absolute values between these are doubles to full precision, as are their products with others
# that are not far from 1, and inverses.
SMALLEST, LARGEST = 1e-290, 1e290
# Decides: Relative error of a point of doubles that a few operations led to.
ROUNDED = 1e-15
# Decides, measured: Newton's steps, values beside their terms and singular values beside the
# largest that are rounding where coefficients have at most six digits; with longer ones, zeros are
# computed to 100 digits.
ARRIVED = 1e-14
# Decides, measured: Newton's last step at a regular end in doubles, 2800 of which lay below
# 1.1e-15; larger ones, as one of 5e-11, get 32 digits.
SHARPEST = 1e-12
# Decides, measured: Newton's last step at a zero in doubles: all below 7e-14.
SHARP = 1e-10
# Decides: The same where the point is badly conditioned, and of zeros of generic systems, which are
# tracked in doubles alone. Ends of loops may have such errors, whatever the tracker thinks: a jump
# to a close point must not join components. Error of a point where none is told.
ROUGH = 1e-8
# Decides, measured: Values at a point where Newton's method arrived: all lay below 2e-16.
VANISHING = 1e-13
# Decides: Error of a singular end, about a root of rounding; estimates of it are themselves
# uncertain.
MULTIPLE = 1e-7
# Decides, measured: What the estimate of an error in doubles may be too small by: what lies further
# is something else, or gets more digits. Ends within it are one, and one of their paths jumped; a
# coordinate beyond it is not zero.
SLACK = 1e3
# Decides: Sum of second differences of a trace over the points' motion that is none of rounding: a
# point is missing, or a path of the trace was lost.
CLEAR = 1e-6
# Newton's method from a point next to a zero must arrive within this many steps.
NEWTON_STEPS = 12
# Doubles hold all whole numbers up to this.
LARGEST_WHOLE = 2**53


def beyond_doubles(what: str) -> str:
    """What to say of solutions or components that were found and that no doubles hold."""
    return (
        f"there are {what} with coordinates beyond the range of doubles, 1.8e308; "
        "write the equations in other units"
    )
