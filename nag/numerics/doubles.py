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
# Doubles are no more accurate than this: a few operations led to them.
ROUNDED = 1e-15
# Newton's steps that are rounding errors, as are values beside their terms, and singular values
# beside the largest.
ARRIVED = 1e-14
# Newton's last step at a regular end of a path, at a point that is known, and at one that is badly
# conditioned; values beside their terms there.
SHARPEST = 1e-12
SHARP = 1e-10
ROUGH = 1e-8
VANISHING = 1e-11
# A multiple zero of multiplicity m is known to about the m-th root of rounding.
MULTIPLE = 1e-7
# Estimated errors may be too small by this factor: a bound, no decision.
SLACK = 1e3
# A coordinate that exceeds its error so many times is not zero.
RESOLVED = 1e3
# Newton's method from a point next to a zero must arrive within this many steps.
NEWTON_STEPS = 12
# Doubles hold all whole numbers up to this.
LARGEST_WHOLE = 2**53
