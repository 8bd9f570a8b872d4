"""The real part of components: all real points of a curve, as a graph, and some of larger sets.

Read in this order, bottom-up: `curve` (the data; `shown` for users) and `closure` (the curve in a
product of projective spaces, so that half-angles pass through infinity). A linear form makes it a
covering of the line. Of curves of low degree `fibre_table` has fibres in many digits over all
values of it, from a circle of them, `critical_values` those over which real points may meet, and
`real_fibres` vertices over these and real points between them. Of others paths lead to
`critical_points` and to `tracked_fibres`, which are the same in doubles. Then come `arc_tracing`
(from one to the other), `even_points` (along arcs), `arcs` (what they make up), `real_equations`
(where coefficients are complex, the equations of real points), and `find_curve`, which puts all of
it together and says what was not certain. `real_pieces` (whether a component of any dimension has
real points) and `real_samples` (random ones) are on these; `spherical_chart` has coordinates to
which a half turn is a place like any other. `real_through` says whether a component has real points
of its dimension next to a given one.

Real curves inside complex surfaces, where these are singular or meet their conjugates, are not
looked for.
"""
