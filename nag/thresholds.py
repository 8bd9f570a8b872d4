"""The numbers that decide something, in one table: what is a zero, one point, a rank, an end.

Where a threshold is safe on one side only, it stands on that side: what does not pass is followed
in more digits, or left undecided, not dismissed. ``python tests/measure_thresholds.py`` measures
how far what they judge lies from those with a star, ``--decompose`` for decompositions. What a
caller may choose stands beside its argument, or in `nag.tracking.settings.Settings`.

==========================================  ======  ================================================
name                                        value   what it decides, and why there
==========================================  ======  ================================================
numerics.double_ranks.INDEPENDENT           1e-6    Singular value of gradients of length one that
                                                    surely are independent; else no bound is given.
numerics.double_ranks.DEPENDENT             1e-10   Least singular value, over the largest, or pivot
                                                    of rows that are not solved for: of a slice, of
                                                    linear equations, of rows that are to be made
                                                    orthogonal.
numerics.double_ranks.NOT_ZERO              1e-7    Errors of derivatives beside their terms.
numerics.zero_values.ON *                   1e-9    Values in doubles, beside their terms, at
                                                    sharpened points that may be zero: zeros lie
                                                    below 2.5e-13, others above 2e-6 in all systems
                                                    measured. What depends on it is confirmed.
numerics.zero_values.NONZERO                1e-6    The same at other points that are certainly not
                                                    zero; smaller ones are computed to 100 digits,
                                                    or leave the answer to another way.
numerics.double_ranks.SINGULAR              1e-9    Singular values of a balanced Jacobian at a
                                                    point of a component below which the gap is
                                                    looked for where a rank is read
                                                    (numerics.double_ranks.GAP).
numerics.zero_values.VANISHES *             1e-80   Values, beside their terms, that are zero at
                                                    zeros of 100 digits: all lay below 5e-87.
numerics.precise_point.NEAR                 -9      Decimal logarithm of what Newton's method may
                                                    move a zero in doubles by, relative.
numerics.zero_values.SLACK                  1e3     Errors of a point that its estimate may be too
                                                    small by: a bound for exact tests, no decision.
numerics.coincidence.SAFETY                 100     Estimated errors that two points may be apart
                                                    and be one: what the balls are wider by.
numerics.coincidence.LEAST *                1e-11   Least relative error of a point in doubles. The
                                                    same ones lay within 1e-15, others beyond 0.05,
                                                    where systems are not made to have close ones;
                                                    isolated zeros that it makes meet are told apart
                                                    in 150 digits.
numerics.coincidence.HIT *                  1e-8    Ends of paths that may have led to a known point
                                                    and did: such as had lay within 5e-11.
numerics.coincidence.MISS *                 1e-5    Such as had not: all lay beyond 7e-4. What falls
                                                    between is undecided.
numerics.coincidence.BEYOND                 1e4     The same in errors of the end.
numerics.certified_points.NEAR              1e-6    The same as a distance, if errors are unknown.
numerics.certified_points.EVIDENCE          60      Digits to which equations vanish that a proof
                                                    did not need: said to be evidence, not proof.
numerics.point_claims.SAME                  1e-140  Distance in 150 digits from zeros of coordinates
                                                    that are said to be exact: evidence.
numerics.series_zeros.ALIKE                 1e-5    Starts nearer to each other, beside the
                                                    cluster's size, are followed once; their ends
                                                    are compared in all digits.
numerics.curves.VANISHING                   0.75    Share of the digits that make a value zero.
numerics.digits.SPARE                       20      Digits that computing may take: in so many of a
                                                    hundred two points may differ that are one, and
                                                    coefficients as small are zero.
numerics.far_along.FAR                      5       Scaled distance from a singular point at which
                                                    it is seen whether equations vanish along a set:
                                                    no power of it is small.
numerics.far_along.AT_MOST                  100     The same in variables that the set determines.
numerics.local_dimension.ROUNDED            1e-8    Relative error of a point where none is told.
numerics.local_structure.FURTHEST           -1.3    Decimal logarithm of the largest distance in
                                                    which a zero is looked for.
numerics.local_structure.NOTHING *          -90     The same of entries of the dual space's matrices
                                                    that are zero, of 150 digits: all below -149.
numerics.local_structure.SOMETHING *        -45     The same of such as are not: above -1. What
                                                    falls between is undecided.
numerics.ball_ranks.WELL                    1e-8    Pivots, over the largest, of a block that
                                                    doubles solve for; the rest is for all digits.
numerics.ball_ranks.CLEAR                   0.5     Decimal logarithm of a pivot over its error that
                                                    makes it no zero.
numerics.curves.OFF                         1e3     Zeros of truncated series over their scale,
                                                    beyond which they are none of the system's.
numerics.rational_relations.SHARP           0.4     Share of the digits to which a relation must
                                                    hold to be one; others show in more points.
numerics.series_zeros.SLOW                  1e-2    Newton's last step that has come near to a zero,
                                                    perhaps a multiple one, of truncated series;
                                                    what there is shows in all digits.
numerics.series_zeros.VANISHING             1e-6    Values there, beside the point's square.
numerics.sharpening.ZERO                    -100    Decimal logarithm of what vanishes at a singular
                                                    point, of 150 digits.
numerics.sharpening.ARRIVED                 -125    The same of Newton's last step.
numerics.sharpening.LARGEST_INVERSE         70      The same of an inverse that says that a zero is
                                                    not regular after all.
numerics.zero_values.ALIKE                  1e-6    Relative difference of the coordinates of zeros
                                                    that a point of doubles may stand for, where it
                                                    is near several.
numerics.zero_values.NOTHING                1e-60   Coordinates beside the largest that are none.
numerics.zero_values.WRITTEN                1e-90   Relative error of a zero that is known by its
                                                    written digits, of a hundred.
tracking.projective.SAFETY *                1e3     Errors that two ends of paths may be apart, of
                                                    all errors that Newton's method estimates with
                                                    residuals in double-double, and be one: one of
                                                    the paths jumped.
tracking.straight_run.NOISY                 10      Rounding errors of a correction, as estimated,
                                                    that it may be and need not contract any more:
                                                    such lay below 3.3, others above 30 but for 1 in
                                                    100, and a few between.
tracking.predictor.OVERLONG                 1.25    Steps over what the radius of convergence at
                                                    their ends allows, which is estimated: of 182
                                                    steps to another path 166 lay above 4/3 and 177
                                                    above 1.11; of others 0.3 and 4 in 100.
tracking.straight_run.PATIENCE              48      Steps tried behind the safe point before a path
                                                    that does not get on goes to more digits, where
                                                    its end takes ten times as long. Of chemequ's
                                                    16 zeros 15 or 16 are reached within these, 2 to
                                                    12 within 24.
tracking.track.PROOF *                      1e5     Smallest singular value over the last Newton
                                                    step of a regular end in doubles. Kantorovich's
                                                    theorem asks for a few times the second
                                                    derivatives; what fails gets 32 digits.
tracking.track.RESIDUAL *                   1e-29   A homogenising coordinate of a regular end in
                                                    doubles, residuals in double-double, is known to
                                                    this over the smallest singular value.
tracking.track.SHARE                        1e-14   Part of it that this may be, as points are as
                                                    accurate after division. Others get 32 digits.
tracking.track.STRAYED                      1e3     Errors by which Newton's method may move an end
                                                    in doubles; what moves further gets 32 digits.
tracking.track.SHARP *                      1e-12   Newton's last step at a regular end in doubles,
                                                    2800 of which lay below 1.1e-15; larger ones, as
                                                    one of 5e-11, get 32 digits.
tracking.track.ROUGH                        1e-8    The same at zeros of generic systems, which are
                                                    tracked in doubles alone.
tracking.track.AT_INFINITY                  1e-10   Homogenising coordinates of finite zeros of such
                                                    systems.
tracking.jumps.ALIKE                        1e-9    Leading coefficients of branches that are
                                                    compared once more, with shorter steps: a jump
                                                    does not survive those, two branches do.
tracking.jumps.BENT                         1e-4    The same of the coefficients that follow, over
                                                    their sizes together.
tracking.track.NONZERO                      1e3     A coordinate over the error of a regular end
                                                    that is not zero, where the mixed volume says
                                                    that all zeros are found: others get 32 digits.
tracking.certified_paths.SHORTEST           1e-9    Steps, relative to t, at which a path is left
                                                    without a proof.
tracking.ends.at_infinity.ZERO              -150    Decimal logarithm of coordinates, beside the
                                                    largest, that are zero in 160 digits.
tracking.ends.follow.KNOWN *                1e3     A coordinate, over its error, that is not zero.
tracking.ends.linear_algebra.RESOLVED       1e3     The same in the kernels.
tracking.ends.follow.SHARP                  1e-15   The same part in more digits.
tracking.ends.initial_forms.ZERO            -100    Decimal logarithm of forms that are zero at a
                                                    limit at infinity, of 120 digits.
tracking.ends.initial_forms.GROWN           2       Digits by which others must grow away from it,
                                                    as about a multiple zero: a constant shows that
                                                    the forms have no zero.
tracking.ends.initial_forms.AWAY            1e4     How far away that is, in errors of the limit.
tracking.ends.initial_forms.CLOSE           1e-10   The least that this is.
tracking.ends.initial_forms.RANK            1e-6    Singular values of their Jacobian that are none,
                                                    beside the largest.
tracking.ends.limits.LEAST_EVIDENCE *       14      Digits to which the exact equations' terms of
                                                    least order must cancel at a limit, so that
                                                    coefficients that doubles rounded would show. No
                                                    gap: a limit that does not pass is looked for
                                                    further in.
tracking.ends.limits.ROUND_NUMBERS          6       Digits of coefficients that ask for no more;
                                                    each further asks for one more.
tracking.ends.follow.GAINED                 0.1     Residual of a limit over that of the last one,
                                                    further out: more is rounding, if it is below
                                                    NEARLY, and asks for more digits.
tracking.ends.follow.NEARLY                 1e-6    See there.
tracking.ends.follow.NOISE                  1e-3    Rounding over the wanted residual that asks for
                                                    more digits as well.
tracking.ends.limits.MOST_EVIDENCE          58      More cannot be asked of 64 digits, and 120 are
                                                    for paths that these lose.
tracking.ends.limits.BEYOND                 30      Error of a limit in last terms of its series.
tracking.ends.runs.TAIL                     1e-11   Last terms of a path's power series that is
                                                    taken to converge, for the winding number in
                                                    question.
tracking.ends.limits.FALLEN                 0.5     Last terms of a power series over those that
                                                    were left further out: branches that are not
                                                    one leave more on the way in.
tracking.ends.limits.WHOLE *                1e-3    How far an order of a coordinate may be from a
                                                    rational number.
tracking.ends.inclusion.WIDER               64      Rounding errors in the radius of the box in
                                                    which Krawczyk's test proves one zero; it must
                                                    hold the errors of the values there.
tracking.ends.inclusion.STEPS               16      Newton's steps in that radius, at least: the box
                                                    need not be larger where these are small.
tracking.ends.inclusion.SHRINKS             0.01    Newton's step to a regular zero, in the one
                                                    before, at most, with one Jacobian; to a
                                                    double one it is a fourth of that.
tracking.ends.corrector.STAGNANT            100     Rounding errors in a correction that need not
                                                    contract any more.
tracking.ends.corrector.FLOOR               1e-9    Coordinates not known at a start in doubles.
tracking.ends.end_run.LOSING                1e-3    Rounding error times Newton's constant at which
                                                    an arithmetic gives up.
tracking.ends.kept_points.SAFE              1e-6    The same at which a point is kept for the next
                                                    arithmetic to start from.
tracking.ends.linear_algebra.GONE           1e-6    What a correction leaves of a coordinate that it
                                                    takes away: a zero along the whole path.
tracking.ends.linear_algebra.ROUGHEST       1e-6    Coordinate of a point from doubles that may be
                                                    rounding alone. More would hide corrections that
                                                    lead away from the path.
solving.path_ends.INFINITE                  2e-12   Homogenising coordinates of ends at infinity,
                                                    beside what is proved of them.
solving.path_ends.ROUGHLY_INFINITE          1e-7    The same of ends in few digits.
solving.path_ends.NEARLY                    1e-5    Values, beside their terms, of ends that are no
                                                    zeros, however badly they are known.
solving.isolated_zero.REAL *                1e-10   Imaginary parts, beside a point's size, of zeros
                                                    in doubles that are real unless another zero is
                                                    their conjugate; beyond that, or their errors in
                                                    more digits, they are not. `nag certify` proves
                                                    it.
solving.missing_zeros.EXTREME               26      Binary logarithm of sizes from which zeros are
                                                    looked for where they cannot be counted; ends so
                                                    far out may satisfy the least evidence of
                                                    infinity.
solving.tropical_zeros.APART                1e-3    Relative distance, beyond those errors, of a
                                                    zero of extreme size from all that were found:
                                                    nearer ones are for paths to find.
solving.branch_solutions.NEAR               1e-7    Relative distance of solutions, in two branches,
                                                    that are compared in more digits.
solving.kantorovich.NEARBY                  1.5     Second derivatives in a ball over those at its
                                                    centre: a bound that holds for radii below a
                                                    percent and degrees below 30.
solving.kantorovich.SHORT                   1e-3    Newton's step, beside the coordinates, at a
                                                    proved zero: its ball is within that percent.
solving.solution_classes.CLEAR              1e-3    Errors of a class's invariants from which on it
                                                    is not told from others: its path is lost.
solving.solve_classes.FEW                   0.1     Part of the classes that chance may lose; more,
                                                    and the parameters are special.
solving.start.family_monodromy.VANISHING    1e-13   Values at a first solution.
solving.start.mixed_cells.SHARE             1e-8    Distance from 0 and 1 of fractions with volumes
                                                    of cells below: less is rounding.
solving.start.mixed_cells.ZERO              1e-9    The same of pivots, and of rates from 0.
solving.start.monodromy.CLEAR               1e-6    Sum of second differences over the points'
                                                    motion that is none of rounding.
solving.start.monodromy.FINE_ROUNDING       1e-50   What of it is rounding in 64 digits.
solving.start.monodromy.ROUNDING            1e-12   Sum of second differences over the points'
                                                    motion that is rounding.
solving.start.monodromy.VISIBLE             10      Own second difference of each point, in those,
                                                    without which its absence could not show.
witness.close_to_sets.CLOSE                 1e-9    Ends of regular paths nearer than this to a zero
                                                    are compared with it in digits.
witness.close_to_sets.REACH                 10      Errors of an end within which others are taken
                                                    to stand for the same zeros, which are looked at
                                                    once.
witness.close_to_sets.SAME                  -80     Decimal logarithm of the distance of points that
                                                    are one, of 100 digits.
witness.cutting_in_digits.ZERO              -80     Decimal logarithm of a pivot that is none, at
                                                    zeros of 100 digits.
witness.cutting_in_digits.LONG              12      Digits of coefficients from which on multiple
                                                    zeros are told in digits from the first.
witness.cutting_in_digits.PROBED            1e-6    Part of its size that a point is off where
                                                    doubles tell Newton's constant there: other
                                                    zeros are not close where it is below 1e4, which
                                                    at conditions up to 1e8 rounding is.
witness.close_points.CLOSE                  1e-4    Relative distance of points that are tracked in
                                                    more digits: corrections that need not contract
                                                    any more may be as large as a hundredth of it.
witness.close_points.CLOSE_AFAR             1e-9    The same far from the origin that suits the
                                                    equations, where nothing is tracked: of doubles
                                                    about that one so many digits are left.
witness.close_points.BASIN                  0.1     Part of the distance to the next point that
                                                    Newton's method may move one by.
witness.confirm.CERTAIN *                   1e-14   Values that are rounding where coefficients have
                                                    at most six digits; with longer ones, zeros are
                                                    computed to 100 digits.
witness.confirm.REGULAR                     1e-5    Singular value above which a zero of as many
                                                    equations as unknowns needs no confirmation.
numerics.double_ranks.GAP *                 1e3     Quotient of neighbouring singular values at
                                                    which a rank is read: others lay below 130,
                                                    ranks above 1e13.
numerics.double_ranks.NEARLY_SINGULAR        1e-5    Singular values at a point that is known to be
                                                    singular, perhaps not well, below which the gap
                                                    is looked for.
witness.cutting.NEAR                        1e-7    Distance, relative to its size, of a zero from
                                                    an end of a path that is this zero; estimates of
                                                    the error of a singular end are themselves
                                                    uncertain.
witness.cutting.CHANGED                     0.1     Part of the smallest singular value by which it
                                                    may change as far from a zero as rounding errors
                                                    of the values say: more may be a double zero's,
                                                    which is looked for in more digits.
witness.cutting.VANISHING *                 1e-11   Values at a point where Newton's method arrived:
                                                    all lay below 2e-16.
witness.cutting.SHARP *                     1e-10   Newton's last step there: all below 7e-14.
witness.cutting.ROUGH                       1e-8    The same where the point is badly conditioned.
witness.exact_points.RESIDUAL               1e-31   Error of residuals in double-double: a bound.
witness.exact_points.ARRIVED                1e-6    Newton's last step in doubles; after a larger
                                                    one points are found in balls.
witness.gauss_newton.ZERO                   1e-13   Values at a zero found from a random point.
witness.gauss_newton.SHARP                  1e-10   Its last step.
witness.gauss_newton.SMALL                  1e-3    Singular values, over the largest, that may
                                                    belong to the kernel; the gap decides.
witness.membership.SPREAD                   10      Distances, in what rounding may do to a point,
                                                    within which the next zero makes it undecided.
witness.multiplicity.ACCURACY               1e-11   Error of points that a badly conditioned
                                                    deflation sharpened in doubles.
witness.multiplicity.MULTIPLE               1e-7    Relative error of singular ends, about a root of
                                                    rounding.
witness.projection.SHARP                    1e-8    Newton's last step at points that are counted.
witness.sampling.SHARP                      1e-10   Newton's last step at a sample; others are none.
witness.real_points.STATIONARY              1e-10   Part of the distance that can still be gained,
                                                    at a nearest point.
witness.real_points.ALMOST                  1e-5    The same at a point that may be a nearest one,
                                                    and is said to be almost.
witness.slices.UNEVEN                       1e-5    Terms of a slice at points, over those of one
                                                    that these move to, below which the latter is
                                                    scaled: else paths begin nearer to 1 than their
                                                    parameter is told from it.
witness.membership.ROUNDED                  1e-9    Values, beside their terms, at points that are
                                                    rounded ones of the set.
decomposition.monodromy.ROUGH               1e-8    Errors that ends of loops may have, whatever the
                                                    tracker thinks: a jump to a close point must not
                                                    join components.
decomposition.monodromy.NEARER *            1e-3    Distance of an end from its point over that from
                                                    the next: below 1e-14, or above 0.01. What is
                                                    not nearer says nothing.
decomposition.monodromy.LEAST_SIZE          1e-8    Coordinates of a point, over its largest, that
                                                    slices of its sizes take for larger ones.
decomposition.trace.EVIDENCE *              18      Digits to which a trace must be linear beside
                                                    the points' motion: such as were had 9 more,
                                                    others 15 less.
decomposition.trace.ROUND_NUMBERS           6       Digits of coefficients that ask for no more;
                                                    each further asks for one more: what is nearly
                                                    reducible has long ones. Points get 28 to 240
                                                    digits for it.
decomposition.trace.BENT                    1e-6    Second differences, beside the motion, of points
                                                    that power sums take for a component, by which
                                                    a path of the trace was lost.
decomposition.power_sums.CERTAIN            100     Singular values of equations that are no errors,
                                                    in units of these: 1e6 to 1e13 in systems
                                                    measured, 800 far from the origin; errors
                                                    themselves gave 0.01 to 13.
decomposition.power_sums.UNCLEAR            0.1     How far from 0 and 1 indicators may be.
decomposition.splitting.MOST_LOOPS *        100     Loops before points are left undecided; 23 were
                                                    the most needed.
decomposition.ends.ASTRAY                   1e-6    Where a failed path seems to lead, relative to
                                                    the point: zeros are looked for there in digits.
decomposition.superset.IN_PASSING           0.02    Part of the usual work after which a multiple
                                                    zero that lies on a larger set as far as doubles
                                                    can tell passes for a point of it; simple ones
                                                    are told in any case.
decomposition.singular_points.SURELY        10      Errors of a point that it may be off a linear
                                                    equation, and be a point of the component.
decomposition.ends.FORBIDDEN                1e-8    Values, beside their terms, of polynomials that
                                                    must not vanish and may: looked at more closely.
decomposition.branch_points.NOTHING         -90     Decimal logarithm of a pivot of the Loewner
                                                    matrix that is zero, of 200 digits.
interpolation.point_cloud.SMALL             1e-5    Singular values of tangents, over the largest,
                                                    of directions that the projection loses.
real.fibre_table.VANISHING                  0.6     Share of the digits to which coefficients beyond
                                                    the degree vanish; else the fibres are not those
                                                    of a curve.
real.critical_values.NOTHING                0.6     The same of coefficients of products over fibres
                                                    that are zero.
real.critical_values.SOMETHING              0.4     The same of leading ones that are not; between
                                                    them more digits are taken.
real.critical_values.CERTAIN                1e3     Values round a cluster of zeros, over rounding
                                                    errors and what parts multiple zeros, from which
                                                    on these stay inside.
real.critical_values.ALONE                  1e-2    Size of a cluster of zeros beside the distance
                                                    of the next.
real.critical_values.REAL                   0.15    Share of the digits to which imaginary parts of
                                                    middles of clusters vanish that are real; others
                                                    need more digits.
real.real_fibres.BESIDE                     0.25    Share of the digits beside a critical value at
                                                    which its fibre is looked at.
real.real_fibres.TOGETHER                   0.05    The same of distances there of points that come
                                                    together, up to five of them; what is a hundred
                                                    times as far does not, and between them more
                                                    digits are taken.
real.real_fibres.BETWEEN                    1e2     The hundred times.
real.real_fibres.REAL                       0.5     Share of the digits to which imaginary parts
                                                    vanish of points over real values that are real.
real.real_fibres.COMPLEX                    0.35    The same of those that are not; between them
                                                    more digits are taken.
real.real_fibres.ROUNDING                   1e-12   Imaginary parts of vertices, in doubles, that
                                                    are real.
real.real_fibres.NOT_REAL                   1e-6    And of those that are not; between them more
                                                    digits are taken.
real.real_fibres.FAR_TOGETHER               0.24    Share of the order of a large value to which
                                                    points there come together at infinity.
real.real_fibres.FAR_BETWEEN                10      Times that distance from which on they do not;
                                                    between them more digits are taken.
real.real_fibres.FAR_REAL                   0.75    The same share of imaginary parts of real ones.
real.real_fibres.FAR_COMPLEX                0.35    And of others; between them likewise.
real.closure.AT_INFINITY                    1e-9    Homogeneous coordinates of length one that are
                                                    zero at vertices known to more digits.
real.closure.NEGATIVE                       1e-12   Eigenvalues of quadratic forms, beside the
                                                    largest, that rounding makes negative.
real.closure.NO_NORM                        1e-7    The same of norms of displacements.
real.arcs.NEARER                            0.3     Distance from the vertex that an arc goes to,
                                                    beside that from the next one; else it is looked
                                                    nearer to the end.
real.arcs.SAME                              1e-2    The same of an arc's end from a point that is
                                                    known in digits; else arcs were mixed up.
real.arcs.SINGULAR                          1e-11   Least singular value at a vertex that is
                                                    singular: these are known to rounding.
real.arcs.REGULAR                           1e-9    And at one that is regular; what falls between
                                                    is undecided.
real.arc_tracing.SHRINK                     0.05    Newton's second correction beside the first,
                                                    where another branch is as many times as far as
                                                    the point is off.
real.find_curve.SAME                        1e-12   Difference of critical values of two methods.
mechanism.assembly.REAL                     1e-8    Imaginary parts of real assemblies, relative.
mechanism.real_assemblies.NONZERO           1e-8    Values at an assembly that must not vanish.
mechanism.inverse_kinematics.REACHED        1e-10   Relative residual of a pose that a leg reaches;
                                                    what it does not reach is said, not dismissed.
mechanism.inverse_kinematics.DISPLACEMENT   1e-6    Norm of a factor, beside the squares that it is
                                                    the sum of, from which it is a displacement.
mechanism.pose_model.REAL                   1e-12   Imaginary parts of Study coordinates of a pose,
                                                    relative, that is lifted to real joints.
mechanism.operation_modes.NOT_ZERO          1e-6    Value of a form, beside its largest term, at a
                                                    pose that is certainly not on its zeros.
mechanism.motions.NO_PITCH                  1e-7    Pitches, moments and entries of unit axes that
                                                    are zero in what is said of a motion in words.
mechanism.bonds.UNCLEAR                     0.03    How far orders of bonds may be from fractions.
mechanism.moving_parts.ZERO                 1e-9    Rates and singular values of joints' motions
                                                    that are zero, where lengths are of size one.
mechanism.moving_parts.NOT_ZERO             1e-5    Those that are not; between the two nothing is
                                                    said.
mechanism.nearly_mobile.ROUNDING            1e-11   Gaps of a loop, over its size, that rounding
                                                    leaves.
mechanism.nearly_mobile.WIDEST_GAP          0.03    Gaps beyond which a motion is not followed, and
                                                    the largest tolerance.
mechanism.nearly_mobile.PARALLEL            9e-4    Squared sines of angles between lines that count
                                                    as parallel, where a centre is looked for.
mechanism.nearly_mobile.HINT                1e-6    Smallest singular value, beside the next, at
                                                    which a rigid mechanism may be meant to move.
mechanism.overconstrained.CLOSE             1e-9    Lengths and sines of angles that are the same,
                                                    of lines that were fitted in doubles.
kinematics.path.KERNEL                      1e-8    Singular values of equations along a curve, over
                                                    the largest, that are zero: Newton's steps that
                                                    bring samples onto it leave them out.
kinematics.motion.SAME                      1e-6    Distance in radians and sizes at which two
                                                    configurations are one: vertices are known to
                                                    half the digits, others that are special lay
                                                    beyond 1e-3.
kinematics.motion.BESIDE                    0.1     Steps of samples by which two circuits, or the
                                                    halves of one in Euler parameters, may be apart
                                                    and be one motion.
kinematics.motion.FAR                       1e6     Coordinates of vertices near infinity: what else
                                                    passes through them is not said.
kinematics.path.SINGULAR                    1e-5    Second least singular value of the equations,
                                                    over its median along a circuit, at which other
                                                    motions meet it: it is brought to 1e-8 there.
kinematics.turning_points.STILL             1e-9    By how much a joint moves that never does: 1e-14
                                                    was seen; others moved by 1e-3 and more.
check.four_way.RESIDUAL                     1e-8    Values at witness points of exact components.
files.robots.given_rotation.NEAR            1e-9    Radians, or parts of the largest entry, by
                                                    which doubles miss what they stand for.
files.robots.given_rotation.NOTHING         1e-12   Lengths that are zero.
files.robots.robot.APART                    1e-6    How far a loop's ends may be apart in rounded
                                                    numbers; it is said by how much.
==========================================  ======  ================================================

Other values of these give the same answers, sooner or later: sizes of steps and work, bounds of
rounding, digits that are taken, where random numbers come from.

algebra.evaluation: HUGE; algebra.number: LARGEST_ANGLE; numerics.certified_points: EPS, FLAT,
LEAST; numerics.ball_boxes: EXPANDING; numerics.curves: CLOSER, PATIENCE;
numerics.deflated_system: MOST_DIGITS; numerics.deflation: MOST_WORK, MOST_WORK_ROUGHLY, TURNS_BACK;
numerics.digits: LOG10_2, SMALLEST, LARGEST, ROUNDING; numerics.double_ranks: NOTHING;
numerics.far_along: APART, SMALL, SMALL_ROUGHLY, CONTRACTION, ROUNDING, FIRST, LEAST, GOOD;
numerics.discs: UNIT, PRODUCT, UP, LEAST;
numerics.krawczyk: WIDER, LEAST_SIDE, GROWTH; numerics.local_structure: ERROR,
REACHES, ROUNDED;
numerics.natural_coordinates: FAR, SEVERAL_SIZES;
numerics.newton: GAIN, FAST, LEFT, RESTS; numerics.precise_point: LEAST_ERROR, LARGEST_ERROR;
numerics.scaling: INERTIA, NEARLY_ORTHOGONAL;
numerics.sharpening: ROUNDING, NEARLY, GAIN, FURTHEST_STEP;
numerics.zero_values: LEAST; numerics.series_zeros: RANK, ASTRAY, ARRIVED; tracking.certified_paths:
ERROR, ALONG, ACROSS, LEAST_FACTOR, MOST_FACTOR, FIRST_STEP, FIRST_SIDE, ENDGAME, FLATTEST;
tracking.close_paths: STEEP; tracking.ends.at_infinity: DOUBLE_DOUBLE; tracking.ends.branch:
LONGEST, TINY; tracking.ends.corrector: DOUBLES, NOISY; tracking.ends.inclusion: TINY;
tracking.ends.initial_forms: GAIN; tracking.ends.kept_points: RESIDUAL, SECOND;
tracking.ends.records: IDLE, STEP, FINISH; tracking.ends.limits: LOG_2;
tracking.ends.linear_algebra: LEAST, LARGEST; tracking.ends.runs: ACCURACY, CONTRACTION;
tracking.linear_algebra: PHASE; tracking.taylor: EPSILON; tracking.numbers.complex_numbers:
HALVED, SMALL_SQUARE, LARGER;
tracking.predictor: PREDICT, CORRECT, TINY, FAR; tracking.projective: ROUNDING; tracking.track:
LEAST, BASIN, FINEST; tracking.ends.end_run: TRIAL, SMALLER, SHORTEST, LAST_T;
tracking.ends.follow: FURTHER, FURTHEST; tracking.jumps: NEIGHBOURS; tracking.settings: TIGHTER,
SHARPER; tracking.straight_run: LEAST, SHORTEST, OVERFLOW, ROUNDING, FARTHEST;
solving.certified_paths: FURTHER; solving.kantorovich: EPS, SMALL, PROMISING, WIDEST, TINY;
solving.isolated_zero: ROUNDING; solving.branch_solutions: ROUGH; solving.missing_zeros: NEAR;
solving.solution_classes: STEP; solving.start.choice: WORK; solving.start.family_monodromy: SHARP,
ARRIVED; solving.start.multihomogeneous: EXACT; solving.start.polyhedral: WIDTH, LENGTH;
solving.start.target: HALF_UNIT; solving.tropical_zeros: ARRIVED, NEAR; witness.membership: EXACT,
INEXACT; witness.close_points: STEEPEST; witness.close_to_sets: ROUNDED; witness.cutting: FLAT,
ROUNDED, ROUNDING, LOSS; witness.exact_points: ENOUGH, ESTIMATE, CORRECTION, STEP,
BITS_PER_DIGIT, SPLITTER; witness.fibres: STEEPER; witness.frame: EPS; witness.gauss_newton: CLOSE,
FIRST_DAMPING, LEAST_DAMPING, MOST_DAMPING, GAIN, ARRIVED, NEARLY; witness.real_points: SPREAD,
SHORTEST, STILL; decomposition.curve_genus: NEAR, OUTSIDE,
SHRINK, LEAST_RADIUS; decomposition.discovery: ROUNDED, DEEP, MULTIPLE; decomposition.given_points:
ROUGH; decomposition.hypersurface: NEARER, ROUNDED; decomposition.rank_drop: ROUNDED;
decomposition.ends: ROUNDED; decomposition.growth: PATH, FACTOR, ENTRY, STEP;
decomposition.superset: REGULAR; decomposition.power_sums:
EQUATIONS, ROUNDING, EVEN; decomposition.zero_sums: SPARE;
interpolation.precise_samples: ROUNDED; real.arc_tracing: ARRIVED, CHORD, CORRECTION, EASY, FIRST,
LARGEST, LEAST, MOVED, REACHED, ROUNDED, TURN; real.arcs: NEAR_END; real.critical_values: ASIDE,
PARTED; real.even_points: CHORD, HALF_ANGLE, KEPT, TURN; real.fibre_table: SAME; real.find_curve:
LEAST_RADIUS; real.real_pieces: SIZES; real.real_samples: SPREAD; mechanism.bonds: NEAR, NEARER,
LEAST_SIZE;
mechanism.framework_decomposition: ROUNDED; mechanism.inverse_kinematics: TINY, LEAST_DAMPING,
LEAST_SHARE; mechanism.mobility_at: LEAST_SECONDS;
mechanism.moving_parts: LENGTH, ARRIVED; mechanism.nearly_mobile: STEP,
SHORTEST_STEP, STRAIGHT, BEND, LONGEST_SLIDE, WEIGHTS, COMPLEX_STEP, NO_STEP, TINY, SMALL;
mechanism.operation_modes: NEARER; kinematics.path: ARRIVED, PROMISING;
kinematics.turning_points: NARROWER; files.export: ROUNDED; files.json_values: AGREES;
files.robots.given_rotation: ROUNDED;
check.four_way: ROUNDING; decomposition.shown: NOTHING; cli.bench: PATIENCE; cli.bench_decompose:
PATIENCE; cli.running: INTERVAL.
"""
