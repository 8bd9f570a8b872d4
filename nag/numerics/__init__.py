"""Numbers of many digits and what they decide: rank, deflation, local rings, proofs.

In order of reading, bottom-up: `linear_algebra_threads` (one); `read_only`, `large_arrays` and
`array_table` (what results hold); `doubles` (their rounding, and what is known to it),
`coincidence` and `scaling`; `natural_coordinates` (origin and units, exact) and `system_facts`
(what exact algebra says of a system); `double_sums` (arrays of two doubles a number) and
`double_newton` (zeros to rounding); `digits`, `ball_polynomials`, `newton` (which decides for all
whether a zero in digits is regular) and `precise_point` (balls), `power_series`; `ball_ranks` and
`double_ranks` (ranks); `exact_system` and `algebraic_point` (exact points, modulo primes);
`implicit_function` (the regular part of equations solved by series); `deflation` (a singular zero
made a regular one) by `descent` and `sharpening`, and `corank` (a zero of so many paths at most);
`dual_space` (the dimension of its local ring), `far_along`, `curves` and `series_zeros` (zeros
beside it); `singular_point` on `local_structure` (all of it together); `zero_values` (what is zero
at the zero that a point stands for); `branch_union` (what the branches of factored equations leave,
joined without repeats); `local_dimension` on `located_zero` and `dimension_bounds` (the dimension
at any point), `tangent_cone`, and `second_order` (whether a real motion can leave a real point).
Proofs: `krawczyk` on `discs` and `ball_boxes` (boxes that hold one zero), `certified_points` with
`deflated_system`, and `rational_relations`; `claims` and `point_claims` (what exports say, against
what is proved).
"""
