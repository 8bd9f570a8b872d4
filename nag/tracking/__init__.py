"""Homotopy path tracking: predictor, corrector, ends in as many digits as they need.

In order of reading: `compiled` and `homotopy` (what is tracked), `taylor` (values and series of a
path) on `kernel_arrays`, `straight_run` (many paths at once in doubles), `track` (their ends
judged) with `known` (what a start system says of them), `ends` (the doubtful ones, followed in
more digits), `paths` (what is known in the end).

Thresholds that decide something about an end. ``python tests/measure_thresholds.py`` measures how
far what they judge lies from those that are marked with a star. Where a threshold is safe on one
side only, it stands on that side: what does not pass is followed in more digits, not dismissed.

====================  =======  =====================================================================
name                  value    what it decides, and why there
====================  =======  =====================================================================
track.PROOF *         1e5      Smallest singular value over the last Newton step of a regular end in
                               doubles. Kantorovich's theorem asks for a few times the second
                               derivatives; what fails gets 32 digits.
track.RESIDUAL *      1e-29    A homogenising coordinate of a regular end in doubles, residuals in
                               double-double, exceeds zero where it exceeds this over the
                               smallest singular value. Others get 32 digits.
track.ALIKE           1e-9     Leading coefficients of branches that are compared once more, with
                               shorter steps: a jump does not survive those, two branches do.
track.BENT            1e-4     The same of the coefficients that follow, over their sizes together.
track.AT_INFINITY     1e-10    Homogenising coordinates of finite zeros in `track_regular`, whose
                               systems have generic coefficients.
track.NONZERO         1e3      A coordinate over the error of a regular end that is not zero, where
                               the mixed volume says that all zeros are found: others get 32
                               digits.
straight_run          1e-9     Newton corrections in doubles that need not contract any more.
.ROUNDING
straight_run          24       Steps behind the safe point before a path that does not get on goes
.PATIENCE                      to more digits.
ends.follow.KNOWN *   1e3      A coordinate over its rounding error that is not zero.
ends.runs.TAIL        1e-11    Last terms of a path's power series that is taken to converge, for
                               the winding number in question.
ends.follow           14       Digits to which the exact equations' terms of least order must cancel
.LEAST_EVIDENCE *              at a limit, so that coefficients that doubles rounded would show.
                               No gap: a limit that does not pass is looked for further in.
ends.follow           6        Digits of coefficients that ask for no more; each further asks for
.ROUND_NUMBERS                 one more.
ends.follow.GAINED    0.1      Residual of a limit over that of the last one, further out: more is
                               rounding, if it is below 1e-6, and asks for more digits.
ends.follow           58       More cannot be asked of 64 digits.
.MOST_EVIDENCE
ends.limits.WHOLE *   1e-3     How far an order of a coordinate may be from a rational number.
ends.inclusion.WIDER  64       Rounding errors in the radius of the box in which Krawczyk's test
                               proves one zero; it must hold the errors of the values there.
ends.corrector        1e2      Rounding errors in a correction that need not contract any more.
.STAGNANT
ends.end_run.LOSING   1e-3     Rounding error times Newton's constant at which an arithmetic gives
                               up; at 1e-6 (SAFE) a point is kept for the next one to start from.
ends.follow.BEYOND    30       Error of a limit in last terms of its series.
ends.corrector.FLOOR  1e-9     Coordinates that a start in doubles does not know.
ends.linear_algebra   1e-6     What a correction leaves of a coordinate that it takes away: a zero
.GONE                          along the whole path.
.ROUGHEST             1e-6     Coordinate of a point from doubles that may be rounding alone. More
                               would hide corrections that lead away from the path.
solve.ON *            1e-9     Residual of the equations, relative to their terms, at a solution: a
                               zero of some combinations of the equations only is larger.
coincidence.LEAST     1e-11    Least relative error of ends in doubles; those within a hundred times
                               their errors are looked at together: no decision, as what is one and
                               what is several is seen in 150 digits (`nag.numerics`).
missing_zeros.SAFETY  1e3      Errors of a zero that was found in which no other one is looked for.
tropical_zeros.APART  1e-3     Relative distance, beyond those errors, of a zero of extreme size
                               from all that were found: nearer ones are for paths to find.
missing_zeros         2^26     Sizes from which zeros are looked for where they cannot be counted;
.EXTREME                       ends so far out may satisfy the least evidence of infinity.
====================  =======  =====================================================================
"""
